#include "analysis/dynamics/lattice/ranks/lattice_share.hpp"

#include <span>
#include <utility>

namespace perilink {
namespace {

/// Slots from the first to the last one of some rows, those between rows included.
RowRange slots_of(const LatticeRows& lattice, RowRange rows) {
  if (rows.size() == 0) return {};
  const LatticeRow& last = lattice.rows[rows.end - 1];
  return {lattice.rows[rows.begin].first, last.first + last.size};
}

/// Visits the part of each of some fields that lies at these slots, where the body has that field.
/// Fields have the shape (any, stride).
template <class Visit, class... Field>
void visit_slots(Index stride, RowRange slots, const Visit& visit, Field&... fields) {
  const auto visit_field = [&](auto& field) {
    for (std::size_t at = 0; at < field.size(); at += static_cast<std::size_t>(stride)) {
      visit(std::span(field).subspan(at + slots.begin, slots.size()));
    }
  };
  (visit_field(fields), ...);
}

/// Visits what a step leaves of some rows to the next, in one order for sender and receiver: motion
/// always, the rest where it has changed.
template <class State, class Visit>
void visit_rows(const LatticeRows& lattice, State& state, RowRange rows, const Visit& visit) {
  visit_slots(lattice.slots, slots_of(lattice, rows), visit, state.displacement, state.velocity);
  if (state.next_damage.empty()) return;  // nothing can change
  auto& flow = state.flow;
  const auto count = static_cast<Index>(lattice.rows.size());
  visit_slots(count, rows, visit, state.slack, state.path, state.bond_changes, state.row_changes,
              state.near_changes, flow.change);
  for (Index r = rows.begin; r < rows.end; ++r) {
    const auto visit_row = [&](auto&... fields) {
      visit_slots(lattice.slots, slots_of(lattice, {r, r + 1}), visit, fields...);
    };
    if ((state.row_changes[r] & RowChanges::scanned) != 0) {
      visit_row(state.crack_at, state.grow_at, state.quiet_until, state.crack_band, flow.yield,
                flow.look_at);
    }
    if (state.near_changes[r] == 0) continue;
    visit_row(state.damage, state.next_damage, state.in_tension, state.in_compression,
              state.root_tension, state.root_compression, state.share_tension,
              state.share_compression, flow.stretch, flow.mean, flow.half, flow.sum, flow.normal,
              flow.strain, flow.equivalent, flow.crushed);
    visit_slots(count, {r, r + 1}, visit, flow.locked);
  }
}

/// Visits what observers of the first rank look at, while `now` is complete.
template <class State, class Visit>
void visit_fields(const ExplicitModel& model, State& state, RowRange rows, const Visit& visit) {
  const LatticeRows& lattice = model.lattice;
  const auto visit_all = [&](auto&... fields) {
    visit_slots(lattice.slots, slots_of(lattice, rows), visit, fields...);
  };
  visit_all(state.displacement, state.velocity, state.holding);
  if (model.material.breakable) {
    visit_all(state.damage, state.cracked_in);
  } else {  // stresses
    visit_all(state.now.effective, state.now.stretch, state.now.sum, state.flow.half,
              state.flow.normal);
  }
  visit_all(state.flow.equivalent);
  if (model.rules != LatticeRules::consistent) visit_all(state.flow.stretch);
}

}  // namespace

LatticeShare::LatticeShare(Ranks& ranks, const RowPart& part, const ExplicitModel& model,
                           std::vector<RowRange> own_of)
    : model_(model),
      part_(part),
      meetings_(ranks, static_cast<int>(own_of.size())),
      own_of_(std::move(own_of)) {
  for (Index r = part.own.begin; r < part.own.end; ++r) {
    if (!model.prescribed[r].empty()) held_rows_.push_back(r);
  }
  const auto add = [&](int rank, RowRange out, RowRange in) {
    if (in.size() == 0) return;
    borders_.push_back({out, in});
    messages_.emplace_back().rank = rank;
  };
  add(ranks.own() - 1, part.to_before, part.from_before);
  add(ranks.own() + 1, part.to_after, part.from_after);
}

void LatticeShare::update_rows(ExplicitState& state) {
  for (std::size_t k = 0; k < borders_.size(); ++k) {
    Parcel& out = messages_[k].out;
    out.clear();
    visit_rows(model_.lattice, std::as_const(state), borders_[k].out,
               [&](auto values) { out.put_values(values); });
  }
  meetings_.ranks().exchange(messages_);
  for (std::size_t k = 0; k < borders_.size(); ++k) {
    visit_rows(model_.lattice, state, borders_[k].in,
               [&](auto values) { messages_[k].in.get_values(values); });
  }
}

std::vector<double> LatticeShare::collect(ExplicitState& state) {
  return meetings_.collect([&](int rank, Parcel& parcel) {
    const RowRange rows = own_of_[rank];
    parcel.get_values(std::span(state.sums).subspan(rows.begin, rows.size()));
    parcel.get_values(std::span(state.reactions).subspan(rows.begin, rows.size()));
  });
}

void LatticeShare::report(const ExplicitState& state) {
  meetings_.report([&](Parcel& parcel) {
    parcel.put_values(std::span(state.sums).subspan(part_.own.begin, part_.own.size()));
    parcel.put_values(std::span(state.reactions).subspan(part_.own.begin, part_.own.size()));
  });
}

void LatticeShare::collect_fields(ExplicitState& state) {
  meetings_.ask(Wish::fields, [&](int rank, Parcel& parcel) {
    visit_fields(model_, state, own_of_[rank], [&](auto values) { parcel.get_values(values); });
  });
}

bool LatticeShare::meet(const ExplicitState& state) {
  report(state);
  return meetings_.obey([&](Wish, Parcel& parcel) {
    visit_fields(model_, state, part_.own, [&](auto values) { parcel.put_values(values); });
  });
}

}  // namespace perilink

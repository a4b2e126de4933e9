#include "analysis/dynamics/lattice/ranks/row_partition.hpp"

#include <algorithm>
#include <cstdint>

namespace perilink {
namespace {

/// First rows of parts with equal shares of the slots, and an end.
std::vector<Index> equal_parts(const LatticeRows& lattice, int ranks) {
  std::int64_t all = 0, so_far = 0;
  for (const LatticeRow& row : lattice.rows) all += row.size;
  std::vector<Index> first{0};
  for (std::size_t r = 0; r < lattice.rows.size(); ++r) {
    so_far += lattice.rows[r].size;
    if (so_far * ranks < all * static_cast<std::int64_t>(first.size())) continue;
    first.push_back(static_cast<Index>(r) + 1);
  }
  return first;
}

/// Slots to which rows and their bonds lead.
RowRange slots_around(const LatticeRows& lattice, RowRange rows) {
  RowRange slots{lattice.slots, 0};
  const Index own = lattice.own_bonds();
  for (Index r = rows.begin; r < rows.end; ++r) {
    const LatticeRow& row = lattice.rows[r];
    for (Index at = r * own; at < (r + 1) * own; ++at) {
      for (const Index shift : {Index{0}, lattice.shift_out[at], -lattice.shift_in[at]}) {
        slots.begin = std::min(slots.begin, row.first + shift);
        slots.end = std::max(slots.end, row.first + row.size + shift);
      }
    }
  }
  return slots;
}

/// The part of an array of shape (any, stride) at `slots`.
template <class T>
std::vector<T> slice(const std::vector<T>& all, Index stride, RowRange slots) {
  std::vector<T> part;
  for (std::size_t at = 0; at < all.size(); at += static_cast<std::size_t>(stride)) {
    const auto from = all.begin() + static_cast<std::ptrdiff_t>(at);
    part.insert(part.end(), from + slots.begin, from + slots.end);
  }
  return part;
}

/// The part of an array of shape (rows, width).
template <class T>
std::vector<T> slice_rows(const std::vector<T>& all, std::size_t width, RowRange rows) {
  if (all.empty()) return {};
  const auto at = [&](Index row) { return all.begin() + static_cast<Index>(row * width); };
  return {at(rows.begin), at(rows.end)};
}

/// Rows that the part does not have become no_index.
std::vector<Index> renumber(std::vector<Index> others, RowRange rows) {
  for (Index& row : others) {
    row = row != no_index && row >= rows.begin && row < rows.end ? row - rows.begin : no_index;
  }
  return others;
}

LatticeRows cut_lattice(const LatticeRows& lattice, RowRange rows, RowRange slots) {
  const std::size_t own = lattice.bonds.size();
  LatticeRows part;
  part.dim = lattice.dim;
  part.spacing = lattice.spacing;
  part.cell_volume = lattice.cell_volume;
  part.bonds = lattice.bonds;
  part.rows = slice_rows(lattice.rows, 1, rows);
  for (LatticeRow& row : part.rows) row.first -= slots.begin;
  part.shift_out = slice_rows(lattice.shift_out, own, rows);
  part.shift_in = slice_rows(lattice.shift_in, own, rows);
  part.row_out = renumber(slice_rows(lattice.row_out, own, rows), rows);
  part.row_in = renumber(slice_rows(lattice.row_in, own, rows), rows);
  part.reach = lattice.reach;
  part.slots = slots.size();
  part.present = slice(lattice.present, lattice.slots, slots);
  part.bond_count = slice(lattice.bond_count, lattice.slots, slots);
  const LatticeRow &first = lattice.rows[rows.begin], &last = lattice.rows[rows.end - 1];
  for (const Index slot : lattice.particle_slot) {
    if (slot < first.first || slot >= last.first + last.size) continue;
    part.particle_slot.push_back(slot - slots.begin);
  }
  return part;
}

template <class Condition>
std::vector<std::vector<Condition>> cut_conditions(const std::vector<std::vector<Condition>>& all,
                                                   RowRange rows, Index first_slot) {
  std::vector<std::vector<Condition>> part = slice_rows(all, 1, rows);
  for (auto& row : part) {
    for (Condition& each : row) each.slot -= first_slot;
  }
  return part;
}

/// Visits all members, in one order for sender and receiver.
template <class Model, class Visit>
void for_each_member(Model& model, Visit visit) {
  auto& lattice = model.lattice;
  visit(model.problem);
  visit(model.rules);
  visit(model.material);
  visit(model.thickness);
  visit(model.moduli);
  visit(model.mass);
  visit(model.inverse_mass);
  visit(model.volume);
  visit(model.load_component);
  visit(model.bond_damping);
  visit(model.mass_damping);
  visit(lattice.dim);
  visit(lattice.spacing);
  visit(lattice.cell_volume);
  visit(lattice.bonds);
  visit(lattice.rows);
  visit(lattice.shift_out);
  visit(lattice.shift_in);
  visit(lattice.row_out);
  visit(lattice.row_in);
  visit(lattice.reach);
  visit(lattice.slots);
  visit(lattice.present);
  visit(lattice.bond_count);
  visit(lattice.particle_slot);
}

}  // namespace

RowPartition::RowPartition(const LatticeRows& lattice, const SweepReach& reach, int ranks)
    : rows_(static_cast<Index>(lattice.rows.size())),
      before_(reach.behind),
      after_(reach.ahead),
      partners_(lattice.reach) {
  const Index fewest = before_ + after_ + partners_;
  const auto is_enough = [&] {
    for (int rank = 0; rank < count(); ++rank) {
      if (own(rank).size() < fewest) return false;
    }
    return true;
  };
  do first_ = equal_parts(lattice, ranks--);
  while (ranks > 0 && !is_enough());
}

RowRange RowPartition::known(int rank) const {
  const RowRange rows = own(rank);
  return {std::max<Index>(0, rows.begin - before_), std::min(rows_, rows.end + after_ + partners_)};
}

RowPart RowPartition::part(int rank) const {
  const Index first = known(rank).begin;
  const auto in_part = [&](Index begin, Index end) { return RowRange{begin - first, end - first}; };
  const RowRange rows = own(rank);
  RowPart part;
  part.own = rows.moved(-first);
  part.swept = {0, std::min(rows_, rows.end + after_) - first, rank > 0, rank + 1 < count()};
  if (rank > 0) {
    part.to_before = in_part(rows.begin, known(rank - 1).end);
    part.from_before = in_part(first, rows.begin);
  }
  if (rank + 1 < count()) {
    part.to_after = in_part(known(rank + 1).begin, rows.end);
    part.from_after = in_part(rows.end, known(rank).end);
  }
  return part;
}

ExplicitModel cut_rows(const ExplicitModel& model, RowRange rows) {
  const LatticeRows& lattice = model.lattice;
  const RowRange slots = slots_around(lattice, rows);
  ExplicitModel part;
  part.problem = model.problem;
  part.rules = model.rules;
  part.material = model.material;
  part.thickness = model.thickness;
  part.moduli = model.moduli;
  part.load_component = model.load_component;
  part.bond_damping = model.bond_damping;
  part.mass_damping = model.mass_damping;
  part.lattice = cut_lattice(lattice, rows, slots);
  part.mass = slice(model.mass, lattice.slots, slots);
  part.inverse_mass = slice(model.inverse_mass, lattice.slots, slots);
  part.volume = slice(model.volume, lattice.slots, slots);
  part.prescribed = cut_conditions(model.prescribed, rows, slots.begin);
  part.applied = cut_conditions(model.applied, rows, slots.begin);
  return part;
}

std::vector<double> cut_field(const std::vector<double>& field, const LatticeRows& lattice,
                              RowRange rows) {
  return slice(field, lattice.slots, slots_around(lattice, rows));
}

void pack(const ExplicitModel& model, Parcel& parcel) {
  for_each_member(model, [&](const auto& member) { parcel.put(member); });
  for (const auto& row : model.prescribed) parcel.put(row);
  parcel.put(model.applied.empty());
  for (const auto& row : model.applied) parcel.put(row);
}

ExplicitModel unpack_model(Parcel& parcel) {
  ExplicitModel model;
  for_each_member(model, [&](auto& member) { parcel.get(member); });
  model.prescribed.resize(model.lattice.rows.size());
  for (auto& row : model.prescribed) parcel.get(row);
  if (parcel.get<bool>()) return model;
  model.applied.resize(model.lattice.rows.size());
  for (auto& row : model.applied) parcel.get(row);
  return model;
}

}  // namespace perilink

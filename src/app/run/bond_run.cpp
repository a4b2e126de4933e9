#include "app/run/bond_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "app/model/body/particle_model.hpp"
#include "app/model/gauges.hpp"
#include "app/process/signals.hpp"
#include "base/error.hpp"
#include "discretization/bonds.hpp"

namespace perilink {
namespace {

constexpr double most_steps = 2e9;  ///< steps have 32-bit numbers

std::vector<double> densities(const CaseFile& input) {
  std::vector<double> density;
  for (const MaterialSection& material : input.materials) density.push_back(*material.density);
  return density;
}

void choose_steps(const CaseFile& input, BondRunCase& built) {
  const AnalysisSection& analysis = input.analysis;
  const double critical = built.inertia.critical_time_step();
  const double step = analysis.time_step.value_or(analysis.safety * critical);
  if (step > critical) {
    throw InputError(
        input.where("analysis.time_step"),
        fmt::format("is {:.6g}, larger than the critical time step {:.6g}", step, critical),
        "take less, or leave it out: `safety` takes a part of the critical one");
  }
  const double steps = std::ceil(analysis.duration / step);
  if (!(steps <= most_steps)) {
    throw InputError(input.where("analysis.duration"),
                     fmt::format("takes {:.1e} steps of {:.4g}", steps, step),
                     fmt::format("at most {:.0e} are possible", most_steps));
  }
  built.steps = static_cast<Index>(steps);
  built.options.duration = analysis.duration;
  built.options.ramp = analysis.ramp_time;
  built.options.time_step = step;
  built.options.rows = analysis.rows;
}

/// Parts of the body, of a hundredth of its particles or more, that have no elastic supports and in
/// which no displacement is prescribed.
Index count_loose_pieces(const Model& model, const BondRunState& state) {
  const Bonds& bonds = model.network.bonds;
  const Index count = model.network.particles.size();
  std::vector<Index> piece(static_cast<std::size_t>(count));
  std::iota(piece.begin(), piece.end(), 0);
  const auto root = [&](Index i) {
    while (piece[i] != i) i = piece[i] = piece[piece[i]];
    return i;
  };
  const std::vector<double> secants = state.bonds.secants();
  for (Index e = 0; e < bonds.size(); ++e) {
    if (secants[e] != 0.0) piece[root(bonds.first[e])] = root(bonds.second[e]);
  }
  std::vector<Index> size(piece.size(), 0);
  std::vector<std::uint8_t> is_held(piece.size(), 0);
  for (std::size_t slot = 0; slot < model.unknowns.number.size(); ++slot) {
    const Index own = root(static_cast<Index>(slot / model.unknowns.width));
    if (slot % model.unknowns.width == 0) ++size[own];
    const bool on_spring =
        !model.network.support_stiffness.empty() && model.network.support_stiffness[slot] > 0.0;
    if (on_spring || model.unknowns.number[slot] == no_index) is_held[own] = 1;
  }
  Index loose = 0;
  for (Index i = 0; i < count; ++i) {
    loose += is_held[i] == 0 && size[i] >= std::max(1.0, 0.01 * count);
  }
  return loose;
}

}  // namespace

std::string cracks_text(const Model& model, const ExplicitRecord& record) {
  return model.network.has_states() ? fmt::format("{} cracked particles", record.cracked_particles)
                                    : fmt::format("{} broken bonds", record.broken_bonds);
}

Strain strain_of(const AnalysisSection& analysis) {
  return analysis.strain == "green" ? Strain::green : Strain::small;
}

BondRunCase build_bond_run(const CaseFile& input, const Model& model) {
  BondRunCase built;
  const bool uniform = input.analysis.masses == "uniform";
  built.rules.damping_rate = input.analysis.damping_rate;
  built.rules.strain = strain_of(input.analysis);
  built.rules.constant_velocity = !input.velocities.empty();
  if (model.network.has_states()) {
    built.rules.states = state_body_of(input);
    refuse_wide_bands(input, model.network.particles, built.rules.states);
  }
  built.inertia =
      lumped_inertia(model.network, densities(input),
                     uniform ? MassScaling::uniform : MassScaling::none, built.rules.strain);
  choose_steps(input, built);
  return built;
}

BondObserver::BondObserver(const CaseFile& input, const Model& model, Index steps,
                           std::filesystem::path directory, bool quiet)
    : RunFiles(input, std::move(directory), quiet),
      model_(model),
      steps_(steps),
      families_(bonds_of_particles(model.network.bonds, model.network.particles.size())) {}

void BondObserver::write_state(const ExplicitRecord& record, const BondRunState& state) {
  write_fields(record.step, record.time, [&] {
    FieldMoment moment = moment_of(record, input_, model_);
    moment.time = record.time;
    const bool bonds_break = !model_.network.has_states();
    VtuGrid grid =
        make_field_grid(model_.network, state.bonds.secants(), state.motion.displacement, moment,
                        bonds_break ? state.broken : std::vector<Index>{}, families_);
    if (bonds_break) return grid;
    number_cracks(grid, state.broken);
    for (VtuArray& field : grid.point_data) {
      if (field.name == "damage") field.values = state.bonds.damage();
    }
    return grid;
  });
}

void BondObserver::on_row(const ExplicitRecord& record, const BondRunState& state) {
  add_row(record, gauge_values(model_, state.motion.displacement, 1.0));
  if (fields_are_due(record.time)) write_state(record, state);
  show_steps(record, steps_, cracks_text(model_, record));
}

void BondObserver::on_end(const ExplicitRecord& last, const BondRunState& state) {
  write_state(last, state);
  if (!model_.network.has_states()) loose_pieces_ = count_loose_pieces(model_, state);
}

void BondObserver::on_iteration(Index load_step, Index iteration, double residual) {
  if (!bar_.is_due()) return;
  bar_.draw(fmt::format("load step {} of {}, iteration {}, residual {:.1e}", load_step, steps_,
                        iteration, residual),
            static_cast<double>(load_step - 1) / steps_);
}

bool BondObserver::stop_requested() { return stop_signal_received(); }

BondRun::BondRun(const CaseFile& input, int threads, bool quiet)
    : ExplicitRun(input, threads),
      model_(build_model_visibly(input, quiet)),
      built_(build_bond_run(input, model_)) {
  built_.options.threads = threads;
  take_notes(model_);
  plan_steps(size_text(model_), built_.steps, built_.options.time_step,
             built_.inertia.critical_time_step());
}

std::string BondRun::rate() const {
  return rate_text(1.0 * model_.network.num_elements() * result_.steps, seconds.analysis,
                   "bond-steps");
}

void BondRun::tell_cracks(Summary& summary) const {
  if (model_.particle_fit) {
    summary.add("cracked_particles", result_.last.cracked_particles);
    tell_constants(summary, model_);
  } else {
    summary.add("broken_bonds", result_.last.broken_bonds);
  }
}

RunFacts BondRun::facts() const {
  const Particles& particles = model_.network.particles;
  const double length = longest_side(particles.dim, particles.size(), [&](Index i, int axis) {
    return particles.position(i)[axis];
  });
  RunFacts facts = run_facts(input_, length, observer_->peaks().highest().load);
  facts.loose_pieces = observer_->loose_pieces();
  return facts;
}

}  // namespace perilink

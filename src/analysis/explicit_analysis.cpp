#include "analysis/explicit_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>
#include <stdexcept>

#include "analysis/explicit_damage.hpp"
#include "analysis/explicit_kernels.hpp"
#include "analysis/explicit_loop.hpp"

namespace perilink {
namespace {

constexpr Index particles_per_thread = 4000;

class ExplicitRun {
 public:
  ExplicitRun(const ExplicitModel& model, ExplicitState& state, const ExplicitOptions& options,
              ExplicitObserver& observer)
      : model_(model),
        state_(state),
        options_(options),
        observer_(observer),
        damage_(model),
        loop_(options, critical_time_step(model)) {}

  ExplicitResult run() {
    // Eight barriers per step: a thread pays only with enough particles of its own.
    const Index useful = std::max<Index>(1, model_.lattice.particles() / particles_per_thread);
    return loop_.run(std::min<Index>(options_.threads, useful),
                     [this](Index step) { one_step(step); });
  }

 private:
  /// Run by every thread; loops end in barriers.
  void one_step(Index step) {
    const auto rows = static_cast<Index>(model_.lattice.rows.size());
    const double dt = loop_.time_step();
    const double increment = loop_.load_factor(step + 1) - loop_.load_factor(step);
#pragma omp for schedule(static)
    for (Index r = 0; r < rows; ++r) measure_bonds(model_, state_, r, dt);
#pragma omp for schedule(static)
    for (Index r = 0; r < rows; ++r) {
      state_.sums[r].stored_before = state_.sums[r].stored;
      sum_stretches(model_, state_, r);
    }
#pragma omp single
    look(step);
    if (model_.material.breakable) damage_.grow(state_, dt);
#pragma omp for schedule(static)
    for (Index r = 0; r < rows; ++r) bond_forces(model_, state_, r);
#pragma omp for schedule(static)
    for (Index r = 0; r < rows; ++r) advance(model_, state_, r, dt, increment);
#pragma omp single
    note_reactions(step);
  }

  void note_reactions(Index step) {
    double driven = 0.0, supports = 0.0;
    for (const RowReactions& row : state_.reactions) {
      driven += row.driven;
      supports += row.supports;
    }
    record_.load = driven / options_.reference;
    record_.support_reaction = supports;
    loop_.note_reaction(supports, loop_.load_factor(step) * options_.reference);
  }

  void look(Index step) {
    if (!loop_.is_looked_at(step)) return;
    record_.energy = energy_balance(model_, state_);
    loop_.look(step, record_, observer_, state_, [this](ExplicitRecord& record) {
      record.displacement = record.load_factor * options_.reference;
      record.cracked_particles = static_cast<Index>(std::count_if(
          state_.damage.begin(), state_.damage.end(), [](double damage) { return damage > 0.0; }));
    });
  }

  const ExplicitModel& model_;
  ExplicitState& state_;
  const ExplicitOptions& options_;
  ExplicitObserver& observer_;
  LatticeDamage damage_;
  ExplicitLoop loop_;
  ExplicitRecord record_;
};

}  // namespace

double ramped_load_factor(double time, double ramp) {
  return time < ramp ? 0.5 * (1.0 - std::cos(std::numbers::pi * time / ramp)) : 1.0;
}

EnergyBalance energy_balance(const ExplicitModel& model, const ExplicitState& state) {
  EnergyBalance energy;
  for (const RowSums& row : state.sums) {
    // Velocities are half a step behind the displacements.
    energy.stored += 0.5 * (row.stored_before + row.stored);
    energy.internal_damping += row.internal_damping;
    energy.external_damping += row.external_damping;
    energy.fractured += row.fractured;
    energy.external_work += row.external_work;
  }
  for (const Index slot : model.lattice.particle_slot) {
    for (int c = 0; c < model.lattice.dim; ++c) {
      const double v = state.velocity[model.lattice.at(c, slot)];
      energy.kinetic += 0.5 * model.mass[slot] * v * v;
    }
  }
  return energy;
}

ExplicitResult run_explicit_analysis(const ExplicitModel& model, ExplicitState& state,
                                     const ExplicitOptions& options, ExplicitObserver& observer) {
  return ExplicitRun(model, state, options, observer).run();
}

}  // namespace perilink

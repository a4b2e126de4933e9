#include "analysis/explicit_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>
#include <stdexcept>

#include "analysis/explicit_damage.hpp"
#include "analysis/explicit_kernels.hpp"

namespace perilink {
namespace {

constexpr Index steps_between_checks = 200;
constexpr Index particles_per_thread = 4000;

class ExplicitRun {
 public:
  ExplicitRun(const ExplicitModel& model, ExplicitState& state, const ExplicitOptions& options,
              ExplicitObserver& observer)
      : model_(model), state_(state), options_(options), observer_(observer), damage_(model) {
    if (options.duration <= 0.0) throw std::invalid_argument("the duration must be positive");
    result_.critical_time_step = critical_time_step(model);
    dt_ = options.time_step > 0.0 ? options.time_step : options.safety * result_.critical_time_step;
    if (dt_ > result_.critical_time_step && options.refuse_unstable) {
      throw std::invalid_argument(
          fmt::format("the time step {:.4g} is larger than the critical one, {:.4g}; take less",
                      dt_, result_.critical_time_step));
    }
    result_.time_step = dt_;
    steps_ = static_cast<Index>(std::ceil(options.duration / dt_));
    between_rows_ = std::max<Index>(1, steps_ / std::max(1, options.rows));
  }

  ExplicitResult run() {
    result_.ending = Ending::completed;
    result_.reason = "the whole duration";
    // Eight barriers per step: a thread pays only with enough particles of its own.
    const Index useful = std::max<Index>(1, model_.lattice.particles() / particles_per_thread);
    const int threads = std::min<Index>(options_.threads, useful);
#pragma omp parallel num_threads(threads)
    for (Index step = 0; step <= steps_ && !done_; ++step) {
      one_step(step);
    }
    if (failure_) std::rethrow_exception(failure_);
    return result_;
  }

 private:
  double load_factor(Index step) const { return ramped_load_factor(step * dt_, options_.ramp); }

  /// Run by every thread; loops end in barriers.
  void one_step(Index step) {
    const auto rows = static_cast<Index>(model_.lattice.rows.size());
    const double increment = load_factor(step + 1) - load_factor(step);
#pragma omp for schedule(static)
    for (Index r = 0; r < rows; ++r) measure_bonds(model_, state_, r, dt_);
#pragma omp for schedule(static)
    for (Index r = 0; r < rows; ++r) {
      state_.sums[r].stored_before = state_.sums[r].stored;
      sum_stretches(model_, state_, r);
    }
#pragma omp single
    look(step);
    if (model_.material.breakable) damage_.grow(state_, dt_);
#pragma omp for schedule(static)
    for (Index r = 0; r < rows; ++r) bond_forces(model_, state_, r);
#pragma omp for schedule(static)
    for (Index r = 0; r < rows; ++r) advance(model_, state_, r, dt_, increment);
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
    if (std::abs(supports) > std::abs(result_.peak_load)) {
      result_.peak_load = supports;
      result_.peak_displacement = load_factor(step) * options_.reference;
    }
  }

  void look(Index step) {
    const bool row = step % between_rows_ == 0 || step == steps_;
    if (!row && step % steps_between_checks != 0) return;
    record_.energy = energy_balance(model_, state_);
    check_growth(step);
    guarded([&] { stop_on_request(); });
    if (!row && !done_) return;
    record_.step = step;
    record_.time = step * dt_;
    record_.load_factor = load_factor(step);
    record_.displacement = record_.load_factor * options_.reference;
    record_.cracked_particles = static_cast<Index>(std::count_if(
        state_.damage.begin(), state_.damage.end(), [](double damage) { return damage > 0.0; }));
    result_.steps = step;
    result_.last = record_;
    largest_surplus_ = std::max(largest_surplus_, std::abs(record_.energy.surplus()));
    result_.largest_surplus = largest_surplus_ / std::max(supplied_, smallest_);
    const bool last = done_ || step == steps_;
    guarded([&] {
      observer_.on_row(record_, state_);
      if (last) observer_.on_end(record_, state_);
    });
  }

  void stop_on_request() {
    if (done_ || !observer_.stop_requested()) return;
    result_.ending = Ending::interrupted;
    result_.reason = "interrupted";
    done_ = true;
  }

  /// Exceptions must not leave a parallel region: the run ends and run() throws them again.
  template <class Action>
  void guarded(const Action& action) {
    try {
      action();
    } catch (...) {
      failure_ = std::current_exception();
      done_ = true;
    }
  }

  /// Only work from outside can raise kinetic and stored energy.
  void check_growth(Index step) {
    const EnergyBalance& energy = record_.energy;
    const double held = energy.kinetic + energy.stored;
    if (step == 0) initial_ = held;
    supplied_ = std::max(supplied_, initial_ + std::abs(energy.external_work));
    if (held <= 2.0 * supplied_ + smallest_) return;  // false for NaN
    result_.ending = Ending::failed;
    result_.reason = fmt::format(
        "the motion grew out of nothing at step {} (energy {:.3g}, supplied {:.3g}): the time step "
        "{:.4g} is too large; the critical one of the intact body is {:.4g}",
        step, held, supplied_, dt_, result_.critical_time_step);
    done_ = true;
  }

  static constexpr double smallest_ = 1e-290;  ///< keeps bodies at rest from dividing by zero

  const ExplicitModel& model_;
  ExplicitState& state_;
  const ExplicitOptions& options_;
  ExplicitObserver& observer_;
  LatticeDamage damage_;
  ExplicitResult result_;
  ExplicitRecord record_;
  double dt_ = 0.0, initial_ = 0.0, supplied_ = 0.0, largest_surplus_ = 0.0;
  Index steps_ = 0, between_rows_ = 1;
  bool done_ = false;
  std::exception_ptr failure_;
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

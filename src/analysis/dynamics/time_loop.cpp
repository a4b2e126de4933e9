#include "analysis/dynamics/time_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <stdexcept>

namespace perilink {
namespace {

constexpr double smallest = 1e-290;  // prevents division by zero for bodies without motion

}  // namespace

double ramped_load_factor(double time, double ramp) {
  return time < ramp ? 0.5 * (1.0 - std::cos(std::numbers::pi * time / ramp)) : 1.0;
}

ExplicitLoop::ExplicitLoop(const ExplicitOptions& options, double critical_time_step)
    : ramp_(options.ramp) {
  if (options.duration <= 0.0) throw std::invalid_argument("the duration must be positive");
  const double step =
      options.time_step > 0.0 ? options.time_step : options.safety * critical_time_step;
  if (step > critical_time_step && options.refuse_unstable) {
    throw std::invalid_argument(fmt::format(
        "the time step {:.4g} exceeds the critical time step {:.4g}; choose a smaller one", step,
        critical_time_step));
  }
  steps_ = static_cast<Index>(std::ceil(options.duration / step));
  between_rows_ = std::max<Index>(1, steps_ / std::max(1, options.rows));
  state_.result.time_step = step;
  state_.result.critical_time_step = critical_time_step;
  state_.result.termination = Termination::completed;
  state_.result.reason = "the whole duration";
}

void ExplicitLoop::restore(const LoopState& saved) {
  if (saved.result.time_step != time_step() || saved.step > steps_) {
    throw std::invalid_argument(fmt::format(
        "the saved state is that of another run: it goes on with step {} of {:.17g}, and this run "
        "has {} steps of {:.17g}",
        saved.step, saved.result.time_step, steps_, time_step()));
  }
  state_ = saved;
}

double ExplicitLoop::load_factor(Index step) const {
  return ramped_load_factor(step * time_step(), ramp_);
}

void ExplicitLoop::end(Termination termination, const std::string& reason) {
  state_.result.termination = termination;
  state_.result.reason = reason;
  done_ = true;
}

std::string ExplicitLoop::why() const {
  const double critical = state_.result.critical_time_step;
  if (time_step() > critical) {
    return fmt::format("is too large; the critical one of the intact body is {:.4g}", critical);
  }
  return fmt::format(
      "is below the critical one of the intact body, {:.4g}: rules of breaking or flow that are "
      "not conservative can add energy, and smaller steps may not prevent it",
      critical);
}

/// Ends the run where kinetic and stored energy exceed the external work.
void ExplicitLoop::check_growth(Index step, const EnergyBalance& energy) {
  const double held = energy.kinetic + energy.stored;
  if (step == 0) state_.initial = held;
  state_.supplied = std::max(state_.supplied, state_.initial + std::abs(energy.external_work));
  // Stored energy between two steps can be negative, and an unstable linear motion keeps the sum of
  // both energies. So kinetic energy has its own limit. In a stable motion it is at most 1 / (1 -
  // (omega dt / 2)^2) of the sum, fifty at 0.99 of the critical step. Both comparisons are false
  // for NaN.
  constexpr double most_kinetic = 100.0;
  const double most = 2.0 * state_.supplied + smallest;
  if (std::abs(held) <= most && energy.kinetic <= most_kinetic * state_.supplied + smallest) {
    return;
  }
  state_.result.steps = step;
  overflowed_ = !std::isfinite(energy.kinetic + energy.stored + energy.external_work);
  end(Termination::failed,
      fmt::format(
          "the energy grew without external work at step {} (energy {:.3g}, supplied {:.3g}): the "
          "time step {:.4g} {}",
          step, std::max(std::abs(held), energy.kinetic), state_.supplied, time_step(), why()));
}

void ExplicitLoop::note_row(const ExplicitRecord& record) {
  state_.result.steps = record.step;
  state_.result.last = record;
  state_.largest_surplus = std::max(state_.largest_surplus, std::abs(record.energy.surplus()));
  state_.result.largest_surplus = state_.largest_surplus / std::max(state_.supplied, smallest);
}

}  // namespace perilink

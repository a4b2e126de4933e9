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
  result_.time_step = step;
  result_.critical_time_step = critical_time_step;
  result_.termination = Termination::completed;
  result_.reason = "the whole duration";
}

double ExplicitLoop::load_factor(Index step) const {
  return ramped_load_factor(step * time_step(), ramp_);
}

void ExplicitLoop::end(Termination termination, const std::string& reason) {
  result_.termination = termination;
  result_.reason = reason;
  done_ = true;
}

std::string ExplicitLoop::why() const {
  const double critical = result_.critical_time_step;
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
  if (step == 0) initial_ = held;
  supplied_ = std::max(supplied_, initial_ + std::abs(energy.external_work));
  // Stored energy between two steps can be negative, and an unstable linear motion keeps the sum of
  // both energies. So kinetic energy has its own limit. In a stable motion it is at most 1 / (1 -
  // (omega dt / 2)^2) of the sum, fifty at 0.99 of the critical step. Both comparisons are false
  // for NaN.
  constexpr double most_kinetic = 100.0;
  const double most = 2.0 * supplied_ + smallest;
  if (std::abs(held) <= most && energy.kinetic <= most_kinetic * supplied_ + smallest) {
    return;
  }
  result_.steps = step;
  overflowed_ = !std::isfinite(energy.kinetic + energy.stored + energy.external_work);
  end(Termination::failed,
      fmt::format(
          "the energy grew without external work at step {} (energy {:.3g}, supplied {:.3g}): the "
          "time step {:.4g} {}",
          step, std::max(std::abs(held), energy.kinetic), supplied_, time_step(), why()));
}

void ExplicitLoop::note_row(const ExplicitRecord& record) {
  result_.steps = record.step;
  result_.last = record;
  largest_surplus_ = std::max(largest_surplus_, std::abs(record.energy.surplus()));
  result_.largest_surplus = largest_surplus_ / std::max(supplied_, smallest);
}

}  // namespace perilink

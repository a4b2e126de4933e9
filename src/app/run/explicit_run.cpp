#include "app/run/explicit_run.hpp"

namespace perilink {

void ExplicitRun::plan_steps(const std::string& size, Index steps, double time_step,
                             double critical) {
  plan = fmt::format("{}, {} steps of {:.4g} (critical {:.4g})", size, steps, time_step, critical);
}

std::vector<std::string> ExplicitRun::doubts() const { return doubts_about(result_, facts()); }

std::string ExplicitRun::outcome() const {
  return fmt::format("{} steps, {}, energy to {:.2e} of the work", result_.steps, cracks(),
                     result_.largest_surplus);
}

void ExplicitRun::tell(Summary& summary) const {
  const EnergyBalance& energy = result_.last.energy;
  tell_peaks(summary, input_, files().peaks(), result_.peak_load);
  summary.add("steps", result_.steps);
  summary.add("rows", files().rows());
  summary.add("time_step", result_.time_step);
  summary.add("critical_time_step", result_.critical_time_step);
  summary.line("steps", "{} of {:.4g} (critical {:.4g}), {} rows", result_.steps, result_.time_step,
               result_.critical_time_step, files().rows());
  if (fundamental_period_ > 0.0) summary.add("fundamental_period", fundamental_period_);
  summary.add("time", result_.last.time);
  tell_cracks(summary);
  tell_energies(summary, energy);
  const std::string flow = tell_flow(summary);
  summary.add("energy_error", result_.largest_surplus);
  summary.line("energy",
               "{:.6g} work, {:.6g} kinetic at the end, {:.6g} dissipated by {}{}, balance to "
               "{:.1e}",
               energy.external_work, energy.kinetic, energy.fractured, cracks(), flow,
               result_.largest_surplus);
  tell_sizes(summary);
}

}  // namespace perilink

#include "app/run/motion.hpp"

#include "app/run/run_notes.hpp"
#include "io/case/sections/case_kinds.hpp"

namespace perilink {

void tell_motion(Summary& summary, const CaseFile& input, const RunFiles& files,
                 const ExplicitResult& result, const MotionExtras& extras) {
  const ExplicitRecord& last = result.last;
  const std::string cracks = cracks_text(input, last);
  tell_peaks(summary, input, files.peaks(), result.peak_load);
  summary.add_note(note_of_peaks(files.peaks()));
  summary.add("steps", result.steps);
  summary.add("rows", files.rows());
  summary.add("time_step", result.time_step);
  summary.add("critical_time_step", result.critical_time_step);
  summary.line("steps", "{} of {:.4g} (critical {:.4g}), {} rows", result.steps, result.time_step,
               result.critical_time_step, files.rows());
  if (extras.fundamental_period > 0.0) {
    summary.add("fundamental_period", extras.fundamental_period);
  }
  summary.add("time", last.time);
  if (has_state_based_particles(input.body)) {
    summary.add("cracked_particles", last.cracked_particles);
  } else {
    summary.add("broken_bonds", last.broken_bonds);
  }
  if (!extras.constants.is_null()) summary.add("constants", extras.constants);
  tell_energies(summary, last.energy);
  std::string flow;
  if (extras.yields) {
    summary.add("yielded_particles", last.yielded_particles);
    summary.add("plastic_energy", last.energy.plastic);
    flow = fmt::format(", {:.6g} by {} yielded ones", last.energy.plastic, last.yielded_particles);
  }
  summary.add("energy_error", result.largest_surplus);
  summary.line("energy",
               "{:.6g} work, {:.6g} kinetic at the end, {:.6g} dissipated by {}{}, balance to "
               "{:.1e}",
               last.energy.external_work, last.energy.kinetic, last.energy.fractured, cracks, flow,
               result.largest_surplus);
  summary.outcome = fmt::format("{} steps, {}, energy to {:.2e} of the work", result.steps, cracks,
                                result.largest_surplus);
}

}  // namespace perilink

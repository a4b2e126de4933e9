#include "app/run/lattice_summary.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/results/summary_file.hpp"
#include "base/build_info.hpp"

namespace perilink {

double ExplicitSummary::particle_steps_per_second() const {
  if (!(seconds.analysis > 0.0)) return 0.0;
  return static_cast<double>(built.model.lattice.particles()) * result.steps / seconds.analysis;
}

void write_summary(const std::filesystem::path& directory, const ExplicitSummary& summary) {
  const ExplicitResult& result = summary.result;
  const EnergyBalance& energy = result.last.energy;
  nlohmann::ordered_json json;
  json["title"] = summary.input.title;
  json["units"] = summary.input.units;
  json["status"] = to_string(result.ending);
  json["reason"] = result.reason;
  const PeakWatch& peaks = summary.observer.peaks();
  json["peak_load"] = peaks.highest().load;
  json["peak_displacement"] = peaks.highest().displacement;
  json["first_peak_load"] = peaks.first().load;
  json["first_peak_displacement"] = peaks.first().displacement;
  json["peak_reaction"] = result.peak_load;
  json["steps"] = result.steps;
  json["rows"] = summary.observer.rows();
  json["time_step"] = result.time_step;
  json["critical_time_step"] = result.critical_time_step;
  if (summary.built.fundamental_period > 0.0) {
    json["fundamental_period"] = summary.built.fundamental_period;
  }
  json["time"] = result.last.time;
  json["cracked_particles"] = result.last.cracked_particles;
  json["external_work"] = energy.external_work;
  json["kinetic_energy"] = energy.kinetic;
  json["strain_energy"] = energy.stored;
  json["damped_energy"] = energy.internal_damping + energy.external_damping;
  json["dissipated_energy"] = energy.fractured + energy.plastic;
  if (summary.built.model.material.yields) {
    json["yielded_particles"] = result.last.yielded_particles;
    json["plastic_energy"] = energy.plastic;
  }
  json["energy_error"] = result.largest_surplus;
  json["particles"] = summary.built.model.lattice.particles();
  json["bonds"] = summary.built.bonds;
  json["spacing"] = summary.built.model.lattice.spacing;
  json["particle_steps_per_second"] = summary.particle_steps_per_second();
  json["notes"] = summary.built.notes;
  json["doubts"] = summary.observer.doubts(result);
  json["seconds"] = {{"set_up", summary.seconds.set_up},
                     {"analysis", summary.seconds.analysis},
                     {"output", summary.seconds.output}};
  json["peak_memory_bytes"] = peak_memory_bytes();
  json["threads"] = summary.threads;
  json["version"] = program_version();
  json["commit"] = program_commit();

  write_summary_file(directory, json);
}

void print_summary(const std::filesystem::path& directory, const ExplicitSummary& summary) {
  const ExplicitResult& result = summary.result;
  const EnergyBalance& energy = result.last.energy;
  const CaseFile& input = summary.input;
  fmt::print("{}\n", input.title.empty() ? input.path : input.title);
  fmt::print("  {:<14} {} ({})\n", "ended", to_string(result.ending), result.reason);
  fmt::print("  {:<14} {:.6g} at displacement {:.6g}{}{}\n", "peak load",
             summary.observer.peaks().highest().load,
             summary.observer.peaks().highest().displacement, reaction_text(result.peak_load),
             input.units.empty() ? "" : "  [" + input.units + "]");
  fmt::print("  {:<14} {} of {:.4g} (critical {:.4g}), {} rows\n", "steps", result.steps,
             result.time_step, result.critical_time_step, summary.observer.rows());
  const std::string flow =
      fmt::format(", {:.6g} by {} yielded ones", energy.plastic, result.last.yielded_particles);
  fmt::print(
      "  {:<14} {:.6g} work, {:.6g} kinetic at the end, {:.6g} dissipated by {} cracked "
      "particles{}, balance to {:.1e}\n",
      "energy", energy.external_work, energy.kinetic, energy.fractured,
      result.last.cracked_particles, summary.built.model.material.yields ? flow : "",
      result.largest_surplus);
  fmt::print("  {:<14} {} particles, {} bonds\n", "size", summary.built.model.lattice.particles(),
             summary.built.bonds);
  fmt::print(
      "  {:<14} set-up {:.2f} s, analysis {:.2f} s ({:.3g} M particle-steps/s), "
      "output {:.2f} s\n",
      "time", summary.seconds.set_up, summary.seconds.analysis,
      summary.particle_steps_per_second() / 1e6, summary.seconds.output);
  for (const std::string& note : summary.built.notes) fmt::print("  {:<14} {}\n", "note", note);
  for (const std::string& doubt : summary.observer.doubts(result)) {
    fmt::print("  {:<14} {}\n", "doubt", doubt);
  }
  fmt::print("  {:<14} {}\n", "results", directory.string());
}

}  // namespace perilink

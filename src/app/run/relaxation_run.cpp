#include "app/run/relaxation_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "analysis/dynamics/fundamental_period.hpp"
#include "app/results/summary_file.hpp"
#include "base/build_info.hpp"

namespace perilink {

RelaxationOptions relaxation_options(const CaseFile& input, int threads) {
  RelaxationOptions options;
  options.load_factors = input.analysis.load_factors;
  options.tolerance = input.analysis.tolerance;
  options.most_iterations = input.analysis.iterations;
  options.strain = input.analysis.strain;
  options.threads = threads;
  return options;
}

double expected_iterations(const Model& model, const RelaxationOptions& options) {
  const Inertia inertia = fictitious_inertia(model.network, options.strain);
  const double period = fundamental_period(model.network, model.unknowns, inertia);
  const double step = options.safety * inertia.critical_time_step();
  return -std::log(options.tolerance) * period / (2.0 * std::numbers::pi * step);
}

void write_summary(const std::filesystem::path& directory, const CaseFile& input,
                   const Model& model, const RelaxationResult& result, const BondRunFiles& files,
                   const PhaseSeconds& seconds, int threads) {
  const EnergyBalance& energy = result.last.energy;
  nlohmann::ordered_json json;
  json["title"] = input.title;
  json["units"] = input.units;
  json["status"] = to_string(result.ending);
  json["reason"] = result.reason;
  json["peak_load"] = files.peaks().highest().load;
  json["peak_displacement"] = files.peaks().highest().displacement;
  json["first_peak_load"] = files.peaks().first().load;
  json["first_peak_displacement"] = files.peaks().first().displacement;
  json["peak_reaction"] = result.peak_load;
  json["iterations"] = result.iterations;
  json["residual"] = result.residual;
  json["displacement_error"] = result.error;
  json["rows"] = files.rows();
  json["broken_bonds"] = result.last.broken_bonds;
  json["external_work"] = energy.external_work;
  json["strain_energy"] = energy.stored;
  json["damped_energy"] = energy.external_damping;
  json["dissipated_energy"] = energy.fractured;
  json["particles"] = model.network.particles.size();
  json["bonds"] = model.network.first_segment;
  json["spacing"] = model.lattice.spacing;
  json["horizon"] = model.horizon;
  json["notes"] = model.notes;
  json["seconds"] = {
      {"set_up", seconds.set_up}, {"analysis", seconds.analysis}, {"output", seconds.output}};
  json["peak_memory_bytes"] = peak_memory_bytes();
  json["threads"] = threads;
  json["version"] = program_version();
  json["commit"] = program_commit();
  write_summary_file(directory, json);
}

void print_summary(const std::filesystem::path& directory, const CaseFile& input,
                   const Model& model, const RelaxationResult& result, const BondRunFiles& files,
                   const PhaseSeconds& seconds) {
  const EnergyBalance& energy = result.last.energy;
  const double rate = seconds.analysis > 0.0 ? 1.0 * model.network.num_elements() *
                                                   result.iterations / seconds.analysis
                                             : 0.0;
  fmt::print("{}\n", input.title.empty() ? input.path : input.title);
  fmt::print("  {:<14} {} ({})\n", "ended", to_string(result.ending), result.reason);
  fmt::print("  {:<14} {:.6g} at displacement {:.6g}{}{}\n", "peak load",
             files.peaks().highest().load, files.peaks().highest().displacement,
             reaction_text(result.peak_load), input.units.empty() ? "" : "  [" + input.units + "]");
  fmt::print("  {:<14} {}, residual {:.1e}, displacements to {:.1e}\n", "iterations",
             result.iterations, result.residual, result.error);
  fmt::print("  {:<14} {:.6g} work, {:.6g} dissipated by {} broken bonds, {:.6g} damped\n",
             "energy", energy.external_work, energy.fractured, result.last.broken_bonds,
             energy.external_damping);
  fmt::print("  {:<14} {} particles, {}\n", "size", model.network.particles.size(),
             elements_text(model));
  fmt::print(
      "  {:<14} set-up {:.2f} s, analysis {:.2f} s ({:.3g} M bond-steps/s), output {:.2f} s\n",
      "time", seconds.set_up, seconds.analysis, rate / 1e6, seconds.output);
  for (const std::string& note : model.notes) fmt::print("  {:<14} {}\n", "note", note);
  fmt::print("  {:<14} {}\n", "results", directory.string());
}

}  // namespace perilink

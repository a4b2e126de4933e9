#include "app/run/summary.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/model/body/particle_model.hpp"
#include "app/process/progress.hpp"
#include "app/results/calibration_text.hpp"
#include "app/results/summary_file.hpp"
#include "app/run/run_warnings.hpp"
#include "base/build_info.hpp"

namespace perilink {
namespace {

void add_peaks(nlohmann::ordered_json& json, const DamageResult& result) {
  json["peak_load"] = result.peak_load;
  json["peak_displacement"] = result.peak_displacement;
  json["first_peak_load"] = result.peaks.first().load;
  json["first_peak_displacement"] = result.peaks.first().displacement;
  if (result.smoothed_peak_load) json["smoothed_peak_load"] = *result.smoothed_peak_load;
  if (!result.places.empty()) {
    json["places"] = nlohmann::ordered_json::array();
    for (const PlaceForce& place : result.places) {
      json["places"].push_back({{"name", place.name}, {"force", place.force}});
    }
  }
}

}  // namespace

std::string elements_text(const Model& model) {
  return model.elements ? fmt::format("{} linear elements", model.elements->cells.size())
                        : fmt::format("{} bonds", model.network.first_segment);
}

std::size_t count_at_grips(const Model& model, std::span<const Index> elements) {
  const Bonds& bonds = model.network.bonds;
  return std::count_if(elements.begin(), elements.end(), [&](Index e) {
    return model.gripped[bonds.first[e]] != 0 || model.gripped[bonds.second[e]] != 0;
  });
}

std::optional<std::string> note_of_grips(const Model& model, std::span<const Index> broken) {
  const std::size_t at_grip = count_at_grips(model, broken);
  if (at_grip == 0) return std::nullopt;
  return fmt::format(
      "{} of {} broken bonds end at particles of [[supports]] or [[displacements]]; where the body "
      "should not break there, give it a material with fracture_energy = \"infinite\"; hold planes "
      "of symmetry by [[symmetry]], which this note leaves out",
      at_grip, broken.size());
}

double peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);  // Linux counts kilobytes
}

std::string reaction_text(double reaction) {
  return reaction == 0.0 ? "" : fmt::format(", reaction of supports {:.6g}", reaction);
}

void write_summary(const std::filesystem::path& directory, const CaseFile& input,
                   const Model& model, const DamageResult& result, const PhaseSeconds& seconds,
                   int threads) {
  nlohmann::ordered_json json;
  json["title"] = input.title;
  json["units"] = input.units;
  json["status"] = to_string(result.ending);
  json["reason"] = result.reason;
  add_peaks(json, result);
  json["initial_stiffness"] = result.initial_stiffness;
  json["steps"] = result.last.step;
  json["broken_bonds"] = result.broken_bonds;
  json["yield_events"] = result.last.yield_events;
  json["external_work"] = result.last.external_work;
  json["strain_energy"] = result.last.strain_energy;
  json["dissipated_energy"] = result.last.dissipated_energy;
  json["energy_error"] = result.energy_error;
  json["largest_residual"] = result.largest_residual;
  json["doubts"] = doubts_about(result);
  json["particles"] = model.network.particles.size();
  json["bonds"] = model.elements ? 0 : model.network.first_segment;
  if (model.elements) json["cells"] = model.elements->cells.size();
  json["unknowns"] = model.unknowns.count;
  if (model.particle_fit) json["constants"] = fit_json(*model.particle_fit);
  if (model.network.calibration) json["calibration"] = calibration_json(*model.network.calibration);
  json["spacing"] = model.lattice.spacing;
  json["horizon"] = model.horizon;
  json["notes"] = model.notes;
  json["factorizations"] = result.factor.factorizations;
  json["factor_bytes"] = result.factor.bytes;
  json["seconds"] = {
      {"set_up", seconds.set_up}, {"analysis", seconds.analysis}, {"output", seconds.output}};
  if (model.network.calibration) {
    json["seconds"]["calibration"] = model.network.calibration->seconds;  // part of set_up
  }
  if (seconds.elastic) {
    json["seconds"]["assembly"] = seconds.elastic->assembly;
    json["seconds"]["factorization"] = seconds.elastic->factorization;
    json["seconds"]["solve"] = seconds.elastic->solve;
  }
  json["peak_memory_bytes"] = peak_memory_bytes();
  json["threads"] = threads;
  json["version"] = program_version();
  json["commit"] = program_commit();

  write_summary_file(directory, json);
}

void print_summary(const CaseFile& input, const Model& model, const DamageResult& result,
                   const PhaseSeconds& seconds, const std::filesystem::path& directory) {
  const double per_event =
      result.last.step > 1 ? seconds.analysis / static_cast<double>(result.last.step) * 1e3 : 0.0;
  fmt::print("{}\n", input.title.empty() ? input.path : input.title);
  fmt::print("  {:<14} {} ({})\n", "ended", to_string(result.ending), result.reason);
  fmt::print("  {:<14} {:.6g} at displacement {:.6g}{}\n", "peak load", result.peak_load,
             result.peak_displacement, input.units.empty() ? "" : "  [" + input.units + "]");
  if (result.smoothed_peak_load) {
    fmt::print("  {:<14} {:.6g} of the smooth curve through the events\n", "",
               *result.smoothed_peak_load);
  }
  for (const PlaceForce& place : result.places) {
    fmt::print("  {:<14} ({:.6g}) by {}\n", "", fmt::join(place.force, ", "), place.name);
  }
  fmt::print("  {:<14} {} broken bonds, {} yield events, {} rows\n", "events", result.broken_bonds,
             result.last.yield_events, result.last.step);
  fmt::print("  {:<14} {:.6g} dissipated, balance to {:.1e}\n", "energy",
             result.last.dissipated_energy, result.energy_error);
  fmt::print("  {:<14} {} particles, {}, {} unknowns\n", "size", model.network.particles.size(),
             elements_text(model), model.unknowns.count);
  fmt::print("  {:<14} {} factorisations, largest residual {:.1e}\n", "solver",
             result.factor.factorizations, result.largest_residual);
  fmt::print("  {:<14} set-up {:.2f} s, analysis {:.2f} s ({:.3g} ms per row), output {:.2f} s\n",
             "time", seconds.set_up, seconds.analysis, per_event, seconds.output);
  for (const std::string& note : model.notes) fmt::print("  {:<14} {}\n", "note", note);
  for (const std::string& doubt : doubts_about(result)) {
    fmt::print("  {:<14} {}\n", "doubt", doubt);
  }
  fmt::print("  {:<14} {}\n", "results", directory.string());
}

}  // namespace perilink

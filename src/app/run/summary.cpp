#include "app/run/summary.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cstdint>

#include "app/run/run_notes.hpp"
#include "base/plain_text.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "model/body/particle_model.hpp"
#include "results/calibration_text.hpp"

namespace perilink {

/// Most cracks in a summary.
constexpr std::size_t most_cracks = 10;

void tell_peaks(Summary& summary, const CaseFile& input, const PeakWatch& peaks,
                std::optional<double> reaction) {
  const CurvePoint &largest = peaks.highest(), &first = peaks.first();
  const CurvePoint& peak = input.rebar.empty() ? first : largest;
  summary.add("peak_load", peak.load);
  summary.add("peak_displacement", peak.displacement);
  summary.add("first_peak_load", first.load);
  summary.add("first_peak_displacement", first.displacement);
  summary.add("largest_load", largest.load);
  summary.add("largest_load_displacement", largest.displacement);
  if (reaction) summary.add("peak_reaction", *reaction);
  const bool bears = reaction.value_or(0.0) != 0.0;
  const bool breaks = input.analysis.type != AnalysisType::elastic;
  summary.line(breaks ? "peak load" : "load", "{:.6g} at displacement {:.6g}{}{}", peak.load,
               peak.displacement,
               bears ? fmt::format(", reaction of supports {:.6g}", *reaction) : "",
               input.units.empty() ? "" : "  [" + input.units + "]");
  if (largest.load != peak.load) {
    summary.line("", "{:.6g} at {:.6g} is the largest load, after failure", largest.load,
                 largest.displacement);
  }
}

void tell_residual_strength(Summary& summary, const CaseFile& input, const PeakWatch& peaks) {
  const bool bars = !input.rebar.empty();
  if (const auto text = text_of_peaks(peaks, bars)) {
    (bars ? summary.notes : summary.warnings).push_back(*text);
  }
}

void tell_energies(Summary& summary, const EnergyBalance& energy) {
  summary.add("external_work", energy.external_work);
  summary.add("kinetic_energy", energy.kinetic);
  summary.add("strain_energy", energy.stored);
  summary.add("damped_energy", energy.internal_damping + energy.external_damping);
  summary.add("dissipated_energy", energy.fractured + energy.plastic);
}

void tell_motion(Summary& summary, const CaseFile& input, const RunFiles& files,
                 const ExplicitResult& result, const MotionExtras& extras) {
  const ExplicitRecord& last = result.last;
  const std::string cracks = cracks_text(input, last);
  tell_peaks(summary, input, files.peaks(), result.peak_load);
  tell_residual_strength(summary, input, files.peaks());
  summary.add("steps", result.steps);
  summary.add("rows", files.rows());
  summary.add("time_step", result.time_step);
  summary.add("critical_time_step", result.critical_time_step);
  if (result.ranks > 1) summary.add("ranks", result.ranks);
  summary.line("steps", "{} of {:.4g} (critical {:.4g}), {}{}", result.steps, result.time_step,
               result.critical_time_step, counted(files.rows(), "row"),
               result.ranks > 1 ? fmt::format(" by {} ranks", result.ranks) : "");
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
    flow = fmt::format(", {:.6g} by {}", last.energy.plastic,
                       counted(last.yielded_particles, "yielded one"));
  }
  summary.add("energy_error", result.largest_surplus);
  summary.line("energy",
               "{:.6g} work, {:.6g} kinetic at the end, {:.6g} dissipated by {}{}, balance "
               "error {:.1e}",
               last.energy.external_work, last.energy.kinetic, last.energy.fractured, cracks, flow,
               result.largest_surplus);
  summary.outcome = fmt::format("{}, {}, energy error {:.2e} of the work",
                                counted(result.steps, "step"), cracks, result.largest_surplus);
}

namespace {

std::int64_t bonds_and_slip_springs(const Model& model) {
  const Network& network = model.network;
  return network.num_bonds() + network.first_bar_element - network.first_slip_spring;
}

std::string cells_text(const Network& network) {
  if (!network.cells) return "";
  return ", " + counted(network.cells->cells.size(), "linear element") + " tied to them";
}

}  // namespace

void tell_cracks(Summary& summary, std::span<const GrownCrack> cracks) {
  for (const GrownCrack& crack : cracks.first(std::min(most_cracks, cracks.size()))) {
    nlohmann::ordered_json& told = summary.json["cracks"].emplace_back();
    told = {{"bonds", crack.bonds},
            {"middle", crack.middle},
            {"length", crack.length},
            {"normal", crack.normal},
            {"mean_opening", crack.mean_opening},
            {"largest_opening", crack.largest_opening},
            {"widest_at", crack.widest_at}};
    if (crack.face_opening) told["face_opening"] = *crack.face_opening;
    if (crack.bar) told["bar"] = *crack.bar + 1;
    if (crack.bar) told["bar_opening"] = crack.bar_opening;
  }
  if (cracks.empty()) return;
  const GrownCrack& widest = cracks.front();
  summary.line(
      "cracks", "{}; the widest is {:.4g} long, its opening {:.4g} at ({}){}{}", cracks.size(),
      widest.length, widest.largest_opening, joined(widest.widest_at),
      widest.face_opening ? fmt::format(", {:.4g} at the face", *widest.face_opening) : "",
      widest.bar ? fmt::format(", {:.4g} at bar {}", widest.bar_opening, *widest.bar + 1) : "");
}

void tell_body(Summary& summary, const Model& model, const std::string& more) {
  const Network& network = model.network;
  summary.add("particles", network.num_particles());
  summary.add("bonds", model.elements ? std::int64_t{0} : bonds_and_slip_springs(model));
  if (model.elements) summary.add("cells", model.elements->cells.size());
  if (network.cells) summary.add("cells", network.cells->cells.size());
  summary.add("unknowns", model.unknowns.count);
  if (model.particle_fit) summary.add("constants", fit_json(*model.particle_fit));
  if (network.report.calibration)
    summary.add("calibration", calibration_json(*network.report.calibration));
  summary.add("spacing", model.lattice.spacing);
  summary.add("horizon", model.horizon);
  summary.line("size", "{}{}", size_text(model), more);
}

std::string size_text(const Model& model) {
  const Index particles = model.network.num_particles();
  return counted(particles, "particle") + ", " +
         (model.elements
              ? counted(model.elements->cells.size(), "linear element")
              : counted(bonds_and_slip_springs(model), "bond") + cells_text(model.network));
}

double peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);  // Linux reports kilobytes
}

}  // namespace perilink

#include "app/run/summary.hpp"

#include <sys/resource.h>

#include "app/model/body/particle_model.hpp"
#include "app/results/calibration_text.hpp"

namespace perilink {

void tell_peaks(Summary& summary, const CaseFile& input, const PeakWatch& peaks,
                std::optional<double> reaction) {
  const CurvePoint &highest = peaks.highest(), &first = peaks.first();
  summary.add("peak_load", highest.load);
  summary.add("peak_displacement", highest.displacement);
  summary.add("first_peak_load", first.load);
  summary.add("first_peak_displacement", first.displacement);
  if (reaction) summary.add("peak_reaction", *reaction);
  const bool bears = reaction.value_or(0.0) != 0.0;
  summary.line("peak load", "{:.6g} at displacement {:.6g}{}{}", highest.load, highest.displacement,
               bears ? fmt::format(", reaction of supports {:.6g}", *reaction) : "",
               input.units.empty() ? "" : "  [" + input.units + "]");
}

void tell_energies(Summary& summary, const EnergyBalance& energy) {
  summary.add("external_work", energy.external_work);
  summary.add("kinetic_energy", energy.kinetic);
  summary.add("strain_energy", energy.stored);
  summary.add("damped_energy", energy.internal_damping + energy.external_damping);
  summary.add("dissipated_energy", energy.fractured + energy.plastic);
}

void tell_body(Summary& summary, const Model& model, const std::string& more) {
  const Network& network = model.network;
  summary.add("particles", network.particles.size());
  summary.add("bonds", model.elements ? 0 : network.first_segment);
  if (model.elements) summary.add("cells", model.elements->cells.size());
  summary.add("unknowns", model.unknowns.count);
  if (model.particle_fit) summary.add("constants", fit_json(*model.particle_fit));
  if (network.calibration) summary.add("calibration", calibration_json(*network.calibration));
  summary.add("spacing", model.lattice.spacing);
  summary.add("horizon", model.horizon);
  summary.line("size", "{}{}", size_text(model), more);
}

std::string size_text(const Model& model) {
  const Index particles = model.network.particles.size();
  return model.elements
             ? fmt::format("{} particles, {} linear elements", particles,
                           model.elements->cells.size())
             : fmt::format("{} particles, {} bonds", particles, model.network.first_segment);
}

double peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);  // Linux counts kilobytes
}

}  // namespace perilink

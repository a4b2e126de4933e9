#include "model/body/particle_model.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/plain_text.hpp"
#include "discretization/lattices/triangulate.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "model/body/lattice_model.hpp"

namespace perilink {

void build_particles(const CaseFile& input, Body& body, Model& model) {
  const double thickness = body.particles.dim == 2 ? input.body.thickness : 1.0;
  std::vector<IsotropicMaterial> materials;
  for (const MaterialSection& material : input.materials) {
    materials.push_back({material.youngs_modulus, *material.poissons_ratio});
  }
  // Neighbours are found with the triangles of the cells. Tractions on the rectangles of a lattice
  // are symmetric, on triangles they are not.
  Facets loaded = body.facets;
  if (!has_cells(input.body)) {
    body.facets = facets_of(body.cells, body.particles.positions, thickness);
  }
  ParticleNetwork built = make_particle_network(body, model.problem, materials, thickness);
  body.facets = std::move(loaded);
  model.network = std::move(built.network);
  model.particle_fit = built.report;
  model.notes.push_back(fit_text(built.report, model.network.particles));
}

StateBody state_body_of(const CaseFile& input) {
  StateBody body;
  body.problem = input.body.problem;
  body.thickness = input.body.thickness;
  for (const MaterialSection& section : input.materials) {
    StateMaterial material;
    material.youngs_modulus = section.youngs_modulus;
    material.poissons_ratio = *section.poissons_ratio;
    material.breakable = section.lattice->tensile_strength.has_value();
    material.softening = softening_of(section);
    material.compressive_threshold = section.lattice->compression_threshold;
    body.materials.push_back(material);
  }
  return body;
}

void refuse_wide_bands(const CaseFile& input, const Particles& particles, const StateBody& body) {
  try {
    check_bands(particles, body.materials, body.thickness);
  } catch (const std::invalid_argument& error) {
    const char* key = input.body.mesh      ? "body.mesh"
                      : input.body.spacing ? "body.spacing"
                                           : "body.columns";
    throw InputError(input.where(key), error.what(), "");
  }
}

std::string fit_text(const ParticleFitReport& report, const Particles& particles) {
  std::string text = fmt::format(
      "constants of {} particles by least squares: exact for {}, mean "
      "relative stress error under uniform strain {:.2g}",
      particles.size(), report.exact, report.mean_residual);
  if (report.largest_residual > 0.0 && report.worst != no_index) {
    text += fmt::format(", {:.2g} at most, at ({})", report.largest_residual,
                        joined(particles.position(report.worst)));
  }
  if (report.enlarged > 0) {
    text += fmt::format("; {} needed a larger neighbourhood", report.enlarged);
  }
  const Index ill_posed = report.many + report.indefinite + report.singular;
  if (ill_posed == 0) return text;
  return text + fmt::format(
                    "; ILL-POSED for {}: {} with several solutions, {} of negative energy, "
                    "{} with neighbours that leave a strain undetermined; the latter two "
                    "have bonds without states",
                    ill_posed, report.many, report.indefinite, report.singular);
}

nlohmann::ordered_json fit_json(const ParticleFitReport& report) {
  return {{"exact", report.exact},
          {"least_squares", report.least},
          {"several_solutions", report.many},
          {"negative_energy", report.indefinite},
          {"free_strain", report.singular},
          {"enlarged", report.enlarged},
          {"mean_residual", report.mean_residual},
          {"largest_residual", report.largest_residual}};
}

}  // namespace perilink

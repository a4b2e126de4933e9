#include "model/from_case/configure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "discretization/lattices/beam_body.hpp"
#include "discretization/lattices/make_body.hpp"
#include "discretization/lattices/triangulate.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/case/sections/case_unused.hpp"
#include "model/body/element_model.hpp"
#include "model/body/horizon_limits.hpp"
#include "model/body/host_model.hpp"
#include "model/body/lattice_model.hpp"
#include "model/body/mesh_input.hpp"
#include "model/body/particle_model.hpp"
#include "model/body/solid_boxes.hpp"
#include "model/conditions/boundary_conditions.hpp"
#include "model/from_case/case_bonds.hpp"
#include "model/from_case/property_fields.hpp"
#include "model/from_case/unstructured_body.hpp"
#include "model/gauges.hpp"
#include "model/surface_of_case.hpp"
#include "model/symmetry_damage.hpp"
#include "model/unbreakable_path.hpp"
#include "network/builder/graded_stiffness.hpp"

namespace perilink {
namespace {

/// Most particles; more would overflow the 32-bit bond numbers at usual horizons.
constexpr double most_particles = 3e7;

/// Returns the spacing of the case, given or from the number of particles across the body. These
/// lie in cells (ghost surface) or on both ends (conforming lattice). In the face-centred pattern
/// the particles of a row are one cube edge apart.
double wanted_spacing(const BodySection& body, double width) {
  if (body.spacing) return *body.spacing;
  if (body.surface == Surface::ghost) return width / *body.columns;
  const double apart = width / (*body.columns - 1);
  return body.pattern == Pattern::face_centred ? apart * std::sqrt(0.5) : apart;
}

double horizon_of(const BodySection& body, double spacing) {
  if (body.horizon) return *body.horizon;
  if (body.horizon_ratio) return *body.horizon_ratio * spacing;
  return horizon_of_level(body.pattern, *body.horizon_level) * spacing;
}

/// Returns the horizon on a lattice that is stretched to end on the boundary. A horizon given in
/// spacings grows with the largest stretch of the rows, so that it includes the neighbours of the
/// unstretched lattice.
double horizon_on_lattice(const BodySection& body, const Lattice& lattice) {
  if (body.horizon) return *body.horizon;
  Vector3 ideal{lattice.spacing, lattice.spacing, lattice.spacing};
  if (lattice.pattern == Pattern::hexagonal) ideal[1] *= std::sqrt(0.75);
  if (lattice.pattern == Pattern::face_centred) {
    for (double& step : ideal) step *= std::sqrt(0.5);
  }
  double stretch = 1.0;
  for (int a = 0; a < lattice.dim; ++a) stretch = std::max(stretch, lattice.step[a] / ideal[a]);
  return horizon_of(body, lattice.spacing) * stretch;
}

void refuse_impossible_spacing(const CaseFile& input, const Box& box, double spacing, int dim) {
  double count = 1.0, longest = 0.0;
  for (int a = 0; a < dim; ++a) {
    const double side = box.upper[a] - box.lower[a];
    count *= std::max(1.0, side / spacing);
    longest = std::max(longest, side);
  }
  const SourceLocation where = input.where(input.body.spacing ? "body.spacing" : "body.columns");
  if (spacing > 2.0 * longest) {
    throw InputError(where,
                     fmt::format("is {:g}, but the body is only {:g} long", spacing, longest),
                     "give all lengths in one unit; every side of the body needs several "
                     "particles");
  }
  if (count <= most_particles) return;
  throw InputError(
      where, fmt::format("gives about {:.1e} particles", count),
      fmt::format("at most {:.0e} are possible: choose a coarser spacing", most_particles));
}

bool has_horizon(const BodySection& body) {
  return body.method == BodyMethod::bonds && !is_particles(body);
}

Body build_beam_body(const CaseFile& input, const LatticeInput& lattice, double& horizon) {
  horizon = horizon_of(input.body, lattice.spacing);
  try {
    Body body = make_beam_body(lattice);
    refuse_impossible_horizon(input, reach_of(body.particles, horizon, body.lattice.spacing));
    return body;
  } catch (const std::invalid_argument& error) {
    throw InputError(input.where("body.problem"), error.what(), "");
  }
}

Body build_lattice_body(const CaseFile& input, int dim, double& horizon) {
  LatticeInput lattice;
  lattice.pattern = input.body.pattern;
  lattice.surface = input.body.surface;
  lattice.thickness = dim == 2 ? input.body.thickness : 1.0;
  for (std::size_t m = 0; m < input.materials.size(); ++m) {
    for (const Box& box : boxes_of(input, m)) {
      lattice.solid.push_back(box);
      lattice.material.push_back(static_cast<Index>(m));
    }
  }
  lattice.unlike_materials = have_unlike_constants(input);
  const Box box = bounding_box(lattice.solid);
  lattice.spacing = wanted_spacing(input.body, box.upper[0] - box.lower[0]);
  refuse_impossible_spacing(input, box, lattice.spacing, dim);
  const bool bonds = has_horizon(input.body);
  if (is_beam(input.body)) return build_beam_body(input, lattice, horizon);
  if (bonds) {
    lattice.horizon = horizon_of(input.body, lattice.spacing);
    refuse_impossible_horizon(input, reach_of(box, dim, lattice.horizon, lattice.spacing));
  } else {
    lattice.surface = Surface::calibrated;  // places the same particles
  }
  try {
    Body body = make_body(lattice);
    if (bonds) {
      horizon = horizon_on_lattice(input.body, body.lattice);
      refuse_shearing_lattice(input, body.lattice, horizon);
    } else {
      body.cells = triangulate(lattice, body);
    }
    return body;
  } catch (const std::invalid_argument& error) {
    throw InputError(input.where(input.body.spacing ? "body.spacing" : "body.columns"),
                     error.what(), "");
  }
}

Body build_unstructured_body(const CaseFile& input, int dim) {
  const Box box = box_of_materials(input);
  const double spacing = wanted_spacing(input.body, box.upper[0] - box.lower[0]);
  refuse_impossible_spacing(input, box, spacing, dim);
  return make_unstructured_body(input, dim, spacing);
}

Body build_body(const CaseFile& input, int dim, double& horizon, std::vector<std::string>& notes) {
  if (!has_cells(input.body)) return build_lattice_body(input, dim, horizon);
  Body body =
      input.body.mesh ? read_mesh_body(input, dim, notes) : build_unstructured_body(input, dim);
  if (!has_horizon(input.body)) return body;
  body.lattice.surface = input.body.surface;
  horizon = horizon_of(input.body, body.lattice.spacing);
  refuse_impossible_horizon(input, reach_of(body.particles, horizon, body.lattice.spacing));
  return body;
}

void refuse_materials_without_particles(const CaseFile& input, const Body& body) {
  std::vector<Index> count(input.materials.size(), 0);
  for (const Index material : body.particles.material) {
    if (material != no_index) ++count[material];
  }
  for (std::size_t m = 0; m < count.size(); ++m) {
    if (count[m] > 0) continue;
    throw InputError(input.where(item_key("materials", m)),
                     fmt::format("no particle is made of \"{}\"", input.materials[m].name),
                     fmt::format("later materials cover its regions, or these are smaller than the "
                                 "spacing {:.6g}",
                                 body.lattice.spacing));
  }
}

/// Builds particles and bonds or elements of every body except lattices of state-based particles.
Model build_bodies_model(const CaseFile& input, const BondOptions& options) {
  Model model;
  model.problem =
      is_shell(input.body) || is_beam(input.body) ? Problem::plane_stress : input.body.problem;
  const int dim = dimension_of(model.problem);
  Body body = build_body(input, dim, model.horizon, model.notes);
  model.lattice = body.lattice;
  refuse_materials_without_particles(input, body);
  const std::vector<PropertyField> fields = property_fields(input, body.particles, model.notes);
  if (has_horizon(input.body)) {
    build_bonds(input, options, fields, body, model);
  } else if (is_particles(input.body)) {
    build_particles(input, body, model);
  } else {
    build_elements(input, body, model);
    scale_stiffness(fields, body.particles.positions, *model.elements);
  }
  model.facets = std::move(body.facets);
  model.cells = std::move(body.cells);
  model.groups = std::move(body.groups);
  model.modulus = modulus_of_particles(input, fields, model.network);
  return model;
}

Model build_model_with(const CaseFile& input, const BondOptions& options) {
  Model model =
      is_lattice(input.body) ? build_lattice_model(input) : build_bodies_model(input, options);
  if (const auto note = note_of_unused(input)) model.notes.push_back(*note);
  apply_boundary_conditions(input, model);
  for (const auto& note : {ligament_note(input, model), unbreakable_path_note(input, model)}) {
    if (note) model.notes.push_back(*note);
  }
  model.gauges = build_gauges(input, model, model.notes);
  for (const MaterialSection& material : input.materials) {
    model.hooke.push_back(
        hooke_constants(model.problem, material.youngs_modulus,
                        material.poissons_ratio.value_or(bond_poissons_ratio(model.problem))));
  }
  model.surface_conditions = surface_of_case(input, model);
  if (is_quasistatic(input.analysis.type)) carry_particles(input, model);
  return model;
}

}  // namespace

Model build_model(const CaseFile& input, const CalibrationCalls& calibration) {
  return build_model_with(input, {false, calibration});
}

Model draft_model(const CaseFile& input) { return build_model_with(input, {true, {}}); }

}  // namespace perilink

#include "app/model/from_case/configure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/model/body/bar_layout.hpp"
#include "app/model/body/carrier_model.hpp"
#include "app/model/body/element_model.hpp"
#include "app/model/body/fracture_rule.hpp"
#include "app/model/body/horizon_limits.hpp"
#include "app/model/body/lattice_model.hpp"
#include "app/model/body/mesh_input.hpp"
#include "app/model/body/particle_model.hpp"
#include "app/model/body/shell_rules.hpp"
#include "app/model/body/solid_boxes.hpp"
#include "app/model/body/strength_notes.hpp"
#include "app/model/body/weak_faces.hpp"
#include "app/model/conditions/boundary_conditions.hpp"
#include "app/model/gauges.hpp"
#include "app/results/calibration_text.hpp"
#include "base/error.hpp"
#include "discretization/lattices/beam_body.hpp"
#include "discretization/lattices/make_body.hpp"
#include "discretization/lattices/triangulate.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/case/sections/case_unused.hpp"
#include "io/case/sections/laws/case_softening.hpp"
#include "network/bond_softening.hpp"
#include "network/builder/network_builder.hpp"

namespace perilink {
namespace {

/// More particles than this would overflow the 32-bit numbers of bonds at the usual horizons.
constexpr double most_particles = 3e7;

/// Spacing that the case asks for: given, or from the number of particles across the body, which
/// stand in cells (ghost surface) or on both ends (conforming lattice). The particles of a row of
/// the face-centred pattern are one edge of its cubes apart.
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

/// A lattice that ends on the boundary is stretched a little along its rows or across them. A
/// horizon given in spacings means the neighbours of the unstretched lattice, so it grows with the
/// longest stretch; otherwise a whole shell of neighbours would drop out.
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
                     "give lengths in one unit: particles lie several to each side of the body");
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

bool have_unlike_constants(const std::vector<MaterialSection>& materials) {
  return std::any_of(materials.begin(), materials.end(), [&](const MaterialSection& m) {
    return m.youngs_modulus != materials.front().youngs_modulus ||
           m.poissons_ratio != materials.front().poissons_ratio;
  });
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
  lattice.unlike_materials = have_unlike_constants(input.materials);
  const Box box = bounding_box(lattice.solid);
  lattice.spacing = wanted_spacing(input.body, box.upper[0] - box.lower[0]);
  refuse_impossible_spacing(input, box, lattice.spacing, dim);
  const bool bonds = has_horizon(input.body);
  if (is_beam(input.body)) return build_beam_body(input, lattice, horizon);
  if (bonds) {
    lattice.horizon = horizon_of(input.body, lattice.spacing);
    refuse_impossible_horizon(input, reach_of(box, dim, lattice.horizon, lattice.spacing));
  } else {
    lattice.surface = Surface::calibrated;  // the same particles
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

Body build_body(const CaseFile& input, int dim, double& horizon, std::vector<std::string>& notes) {
  if (!input.body.mesh) return build_lattice_body(input, dim, horizon);
  Body body = read_mesh_body(input, dim, notes);
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

/// A lattice of few neighbours reaches smaller Poisson's ratios than the infinite body.
void refuse_poissons_ratios(const CaseFile& input, const Body& body, const NetworkInput& network) {
  if (network.model != BondModel::micropolar) return;
  for (std::size_t m = 0; m < input.materials.size(); ++m) {
    try {
      moduli_of(body, network, network.materials[m]);
    } catch (const std::invalid_argument& error) {
      throw InputError(input.where(item_key("materials", m, "poissons_ratio")),
                       fmt::format("is {}: {}", network.materials[m].poissons_ratio, error.what()),
                       "the bonds of this lattice alone have that ratio: enlarge the horizon, use "
                       "another pattern, or set body.micromodulus = \"continuum\"");
    }
  }
}

std::string crack_key(std::size_t crack, int dim) {
  return item_key("cracks", crack, dim == 2 ? "points" : "corners");
}

void refuse_impossible_cracks(const CaseFile& input, int dim) {
  for (std::size_t k = 0; k < input.cracks.size(); ++k) {
    try {
      check_crack({input.cracks[k].points}, dim);
    } catch (const std::invalid_argument& error) {
      throw InputError(input.where(crack_key(k, dim)), error.what(), "");
    }
  }
}

void refuse_cracks_without_bonds(const CaseFile& input, const Network& network) {
  refuse_interfaces_without_bonds(input, network);
  for (std::size_t k = 0; k < network.cut_by_crack.size(); ++k) {
    if (network.cut_by_crack[k] > 0) continue;
    throw InputError(input.where(crack_key(k, dimension_of(input.body))),
                     "crosses no bond of the body", "move the crack into the body, or delete it");
  }
}

NetworkInput network_input(const CaseFile& input, Problem problem, double horizon,
                           const LaidBars& bars) {
  NetworkInput network;
  network.problem = problem;
  if (input.body.model == BodyModel::micropolar) network.model = BondModel::micropolar;
  network.torsion = input.body.torsion;
  network.horizon = horizon;
  network.thickness = input.body.thickness;
  network.shell = is_shell(input.body);
  network.radius = input.body.radius.value_or(0.0);
  network.micromodulus = input.body.micromodulus;
  const CriticalStretch rule = input.body.critical_stretch;
  const bool on_lattice =
      rule == CriticalStretch::lattice || (rule == CriticalStretch::dissipated && !input.body.mesh);
  network.critical_stretch = on_lattice ? Constants::lattice : Constants::continuum;
  for (std::size_t m = 0; m < input.materials.size() && !input.body.mesh; ++m) {
    const std::vector<Box> boxes = boxes_of(input, m);
    network.solid.insert(network.solid.end(), boxes.begin(), boxes.end());
  }
  for (const MaterialSection& material : input.materials) {
    // Stretches need no energy: any will do, and the network says what they take.
    const double energy = has_stretches(material.softening) ? 1.0 : material.fracture_energy;
    const bool elastic = input.analysis.type == AnalysisType::elastic;
    network.materials.push_back({material.youngs_modulus, energy,
                                 material.poissons_ratio.value_or(0.0),
                                 elastic ? SofteningMaterial{} : material.softening});
  }
  for (const CrackSection& crack : input.cracks) network.cracks.push_back({crack.points});
  network.bars = bars.lines;
  network.bar_materials = bars.materials;
  return network;
}

void refuse_unbreakable_bodies(const CaseFile& input, const Network& network) {
  if (input.analysis.type != AnalysisType::damage) return;
  auto finite = [](double value) { return std::isfinite(value); };
  if (std::any_of(network.critical_stretch.begin(), network.critical_stretch.end(), finite)) return;
  throw InputError(input.where("materials[1].fracture_energy"),
                   "is infinite in every material: nothing can break in a damage analysis",
                   "give a material a finite fracture energy, or set analysis.type = \"elastic\"");
}

/// Next to the ratio of bonds that do not bend, nothing is left for bending.
void refuse_unbending_materials(const CaseFile& input, const NetworkInput& network) {
  if (network.model != BondModel::micropolar) return;
  const double largest = bond_poissons_ratio(network.problem);
  for (std::size_t m = 0; m < input.materials.size(); ++m) {
    const double ratio = network.materials[m].poissons_ratio;
    if (ratio <= 0.999 * largest) continue;
    throw InputError(
        input.where(item_key("materials", m, "poissons_ratio")),
        fmt::format("is {}, next to {:.6g}, which bonds have that do not bend: no stiffnesses of "
                    "bonds that bend are found for it",
                    ratio, largest),
        fmt::format(
            "set model = \"bond_based\" in [body] and delete the key, or give at most {:.4f}",
            0.999 * largest));
  }
}

Network build_case_network(const CaseFile& input, const Body& body, const NetworkInput& network) {
  try {
    return build_network(body, network);
  } catch (const TooStrong& error) {
    refuse_strong_interface(input, network, error);
    const double strength = network.materials[error.material].softening.tensile_strength;
    throw InputError(
        input.where(item_key("materials", error.material, "tensile_strength")),
        fmt::format("is {:.6g}, but with a horizon of {:.6g} a bond would hold {:.3g} times the "
                    "energy at this stress that fracture_energy lets it dissipate",
                    strength, network.horizon, 1.0 / error.share),
        fmt::format("take a horizon below {:.4g}, a strength below {:.4g} or a larger "
                    "fracture_energy; brittle bonds have no strength of their own",
                    network.horizon * error.share, strength * std::sqrt(error.share)));
  } catch (const std::invalid_argument& error) {
    refuse_unbending_materials(input, network);
    throw InputError(input.where(horizon_key(input.body)), error.what(),
                     "use two to four spacings, or set surface = \"none\"");
  }
}

/// The calibration of clouds, of bodies in space and of micropolar bonds can take minutes. What it
/// does not change (regions, loads, whether the body is held, gauges) is looked at before. Trusses
/// on lattices in the plane are calibrated in less time than their matrix is factorised.
void refuse_before_calibration(const CaseFile& input, const Body& body, NetworkInput network,
                               const Model& model) {
  if (body.lattice.surface != Surface::calibrated || !body.spans.empty()) return;
  const bool lattice = body.lattice.pattern != Pattern::irregular;
  if (lattice && body.particles.dim == 2 && network.model == BondModel::bond_based) return;
  network.draft = true;
  Model draft = model;
  draft.network = build_case_network(input, body, network);
  draft.facets = draft.network.shell ? draft.network.facets : body.facets;
  draft.cells = body.cells;
  draft.groups = body.groups;
  refuse_cracks_without_bonds(input, draft.network);
  refuse_unbreakable_bodies(input, draft.network);
  apply_boundary_conditions(input, draft);
  build_gauges(input, draft);
}

/// How the bonds of a model are calibrated.
struct BondOptions {
  bool draft = false;  ///< not at all
  CalibrationObserver on_search;
};

void build_bonds(const CaseFile& input, const BondOptions& options, Body& body, Model& model) {
  const LaidBars bars = lay_bars(input, body);
  refuse_bars_outside(input, body, bars);
  model.entry_of_bar = bars.sections;
  NetworkInput network = network_input(input, model.problem, model.horizon, bars);
  network.on_search = options.on_search;
  network.interfaces = weak_interfaces(input, body);
  network.draft = options.draft;
  if (body.spans.empty()) refuse_poissons_ratios(input, body, network);
  if (network.shell) refuse_impossible_shell(input, body, network);
  refuse_impossible_cracks(input, body.particles.dim);
  model.crack_cost = count_on_the_path(input, body, network);
  if (!options.draft) refuse_before_calibration(input, body, network, model);
  model.network = build_case_network(input, body, network);
  refuse_cracks_without_bonds(input, model.network);
  refuse_unbreakable_bodies(input, model.network);
  if (input.analysis.type == AnalysisType::elastic) model.network.strengths.clear();
  for (const auto& text : {short_horizon_note(input, model), unmeasured_cost_note(input, model),
                           calibration_shortfall(model.network)}) {
    if (text) model.notes.push_back(*text);
  }
  for (const std::string& text : strength_notes(input, model)) model.notes.push_back(text);
  for (const std::string& text : bar_notes(input)) model.notes.push_back(text);
  body.facets = std::move(model.network.facets);  // with the shares that the bonds balance
}

/// Particles, and bonds or elements, of every body but lattices of state-based particles.
Model build_bodies_model(const CaseFile& input, const BondOptions& options) {
  Model model;
  model.problem =
      is_shell(input.body) || is_beam(input.body) ? Problem::plane_stress : input.body.problem;
  const int dim = dimension_of(model.problem);
  Body body = build_body(input, dim, model.horizon, model.notes);
  model.lattice = body.lattice;
  refuse_materials_without_particles(input, body);
  if (has_horizon(input.body)) {
    build_bonds(input, options, body, model);
  } else if (is_particles(input.body)) {
    build_particles(input, body, model);
  } else {
    build_elements(input, body, model);
  }
  model.facets = std::move(body.facets);
  model.cells = std::move(body.cells);
  model.groups = std::move(body.groups);
  return model;
}

Model build_model_with(const CaseFile& input, const BondOptions& options) {
  Model model =
      is_lattice(input.body) ? build_lattice_model(input) : build_bodies_model(input, options);
  if (const auto note = note_of_unused(input)) model.notes.push_back(*note);
  apply_boundary_conditions(input, model);
  model.gauges = build_gauges(input, model);
  for (const MaterialSection& material : input.materials) {
    model.hooke.push_back(
        hooke_constants(model.problem, material.youngs_modulus,
                        material.poissons_ratio.value_or(bond_poissons_ratio(model.problem))));
  }
  if (is_quasistatic(input.analysis.type)) carry_particles(input, model);
  return model;
}

}  // namespace

Model build_model(const CaseFile& input, const CalibrationObserver& on_search) {
  return build_model_with(input, {false, on_search});
}

Model draft_model(const CaseFile& input) { return build_model_with(input, {true, {}}); }

}  // namespace perilink

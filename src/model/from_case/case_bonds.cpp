#include "model/from_case/case_bonds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/error.hpp"
#include "discretization/mesh_faces.hpp"
#include "discretization/meshes/mesh_conformity.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/case/sections/laws/case_softening.hpp"
#include "model/body/bar_layout.hpp"
#include "model/body/fracture_rule.hpp"
#include "model/body/groups/drawn_groups.hpp"
#include "model/body/horizon_limits.hpp"
#include "model/body/mesh_input.hpp"
#include "model/body/shell_rules.hpp"
#include "model/body/solid_boxes.hpp"
#include "model/body/strength_notes.hpp"
#include "model/body/weak_faces.hpp"
#include "model/conditions/boundary_conditions.hpp"
#include "model/gauges.hpp"
#include "network/bond_softening.hpp"
#include "network/builder/network_builder.hpp"
#include "network/builder/repeated_box.hpp"
#include "results/calibration_text.hpp"

namespace perilink {
namespace {

/// Refuses unattainable Poisson's ratios. A lattice with few neighbours attains smaller ratios than
/// the infinite body.
void refuse_poissons_ratios(const CaseFile& input, const Body& body, const NetworkInput& network) {
  if (network.model != BondModel::micropolar) return;
  for (std::size_t m = 0; m < input.materials.size(); ++m) {
    try {
      moduli_of(body, network, network.materials[m]);
    } catch (const std::invalid_argument& error) {
      throw InputError(input.where(item_key("materials", m, "poissons_ratio")),
                       fmt::format("is {}: {}", network.materials[m].poissons_ratio, error.what()),
                       "bonds of this lattice without bending have that ratio: enlarge the "
                       "horizon, use another pattern, or set body.micromodulus = \"continuum\"");
    }
  }
}

void refuse_cracks_without_bonds(const CaseFile& input, const Model& model) {
  refuse_interfaces_without_bonds(input, model.network);
  std::vector<Index> cut(input.cracks.size(), 0);  // bonds, by entry of [[cracks]]
  for (std::size_t c = 0; c < model.cracks.size(); ++c) {
    cut[model.entry_of_crack[c]] += model.network.report.cut_by_crack[c];
  }
  for (std::size_t k = 0; k < cut.size(); ++k) {
    if (cut[k] > 0) continue;
    throw InputError(input.where(place_of_crack(input, k)), "crosses no bond of the body",
                     "move the crack into the body, or delete it");
  }
}

NetworkInput network_input(const CaseFile& input, const Model& model, const LaidBars& bars) {
  NetworkInput network;
  network.problem = model.problem;
  if (input.body.model == BodyModel::micropolar) network.model = BondModel::micropolar;
  network.torsion = input.body.torsion;
  network.horizon = model.horizon;
  network.thickness = input.body.thickness;
  network.shell = is_shell(input.body);
  network.radius = input.body.radius.value_or(0.0);
  network.micromodulus = input.body.micromodulus;
  const CriticalStretch rule = input.body.critical_stretch;
  const bool on_lattice = rule == CriticalStretch::lattice ||
                          (rule == CriticalStretch::dissipated && !has_cells(input.body));
  network.critical_stretch = on_lattice ? Constants::lattice : Constants::continuum;
  network.elastic = input.analysis.type == AnalysisType::elastic;
  for (std::size_t m = 0; m < input.materials.size() && !has_cells(input.body); ++m) {
    const std::vector<Box> boxes = boxes_of(input, m);
    network.solid.insert(network.solid.end(), boxes.begin(), boxes.end());
  }
  for (const MaterialSection& material : input.materials) {
    // Laws given by stretches ignore the energy; the network computes it.
    const double energy = has_stretches(material.softening) ? 1.0 : material.fracture_energy;
    network.materials.push_back({material.youngs_modulus, energy,
                                 material.poissons_ratio.value_or(0.0),
                                 network.elastic ? SofteningMaterial{} : material.softening});
    network.materials.back().softening.closes = material.softening.closes;
  }
  network.cracks = model.cracks;
  network.bars = bars.lines;
  network.bar_materials = bars.materials;
  return network;
}

void refuse_unbreakable_bodies(const CaseFile& input, const Network& network) {
  if (input.analysis.type != AnalysisType::damage) return;
  auto finite = [](double value) { return std::isfinite(value); };
  if (std::any_of(network.critical_stretch.begin(), network.critical_stretch.end(), finite)) return;
  throw InputError(input.where("materials[1].fracture_energy"),
                   "is infinite in every material: a damage analysis needs a material "
                   "that can break",
                   "give a material a finite fracture energy, or set analysis.type = \"elastic\"");
}

/// Refuses Poisson's ratios next to that of bonds without bending, which leave no bending
/// stiffness.
void refuse_unbending_materials(const CaseFile& input, const NetworkInput& network) {
  if (network.model != BondModel::micropolar) return;
  const double largest = bond_poissons_ratio(network.problem);
  for (std::size_t m = 0; m < input.materials.size(); ++m) {
    const double ratio = network.materials[m].poissons_ratio;
    if (ratio <= 0.999 * largest) continue;
    throw InputError(
        input.where(item_key("materials", m, "poissons_ratio")),
        fmt::format("is {}, too close to {:.6g}, the ratio of bonds without bending: "
                    "bending bonds have no solution for it",
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
    refuse_unfit_strength(input, network, error);
  } catch (const std::invalid_argument& error) {
    refuse_unbending_materials(input, network);
    throw InputError(input.where(horizon_key(input.body)), error.what(),
                     "use two to four spacings, or set surface = \"none\"");
  }
}

/// Builds a draft first, to refuse invalid regions, loads, supports and gauges before the
/// calibration. Calibrating unstructured particle sets, bodies in space and micropolar bonds can
/// take minutes. Plane lattices of trusses calibrate faster than their matrix is factorised; large
/// boxes in space as fast as small ones.
void refuse_before_calibration(const CaseFile& input, const Body& body, NetworkInput network,
                               const Model& model) {
  if (body.lattice.surface != Surface::calibrated || !body.spans.empty()) return;
  if (repeats_smaller_box(body, network)) return;
  const bool lattice = body.lattice.pattern != Pattern::irregular;
  if (lattice && body.particles.dim == 2 && network.model == BondModel::bond_based) return;
  network.calibrating = Calibrating::never;
  Model draft = model;
  draft.network = build_case_network(input, body, network);
  draft.facets = draft.network.shell ? draft.network.facets : body.facets;
  draft.cells = body.cells;
  draft.groups = body.groups;
  refuse_cracks_without_bonds(input, draft);
  refuse_unbreakable_bodies(input, draft.network);
  apply_boundary_conditions(input, draft);
  build_gauges(input, draft, draft.notes);
}

}  // namespace

bool have_unlike_constants(const CaseFile& input) {
  const MaterialSection& first = input.materials.front();
  const bool has_ratio_of_bonds =
      input.body.method == BodyMethod::bonds && input.body.model == BodyModel::bond_based;
  const double otherwise = bond_poissons_ratio(input.body.problem);
  return std::any_of(input.materials.begin(), input.materials.end(), [&](const auto& material) {
    if (material.youngs_modulus != first.youngs_modulus) return true;
    return !has_ratio_of_bonds &&
           material.poissons_ratio.value_or(otherwise) != first.poissons_ratio.value_or(otherwise);
  });
}

namespace {

/// Adds the slits of the mesh as pre-cracks.
void add_slits(const Body& body, NetworkInput& network) {
  const auto dim = static_cast<std::size_t>(body.particles.dim);
  for (const Group& group : body.groups) {
    if (group.name != slits_of_mesh) continue;
    for (std::size_t k = 0; k < group.sides.size(); ++k) {
      if (k % dim == 0) network.cracks.emplace_back();
      network.cracks.back().points.push_back(
          point_of(body.particles.positions, body.particles.dim, group.sides[k]));
    }
  }
}

}  // namespace

void build_bonds(const CaseFile& input, const BondOptions& options,
                 std::vector<PropertyField> fields, Body& body, Model& model) {
  const LaidBars bars = lay_bars(input, body);
  refuse_bars_outside(input, body, bars);
  model.entry_of_bar = bars.sections;
  DrawnCracks drawn = drawn_cracks(input, body);
  model.cracks = std::move(drawn.cracks);
  model.entry_of_crack = std::move(drawn.entry);
  NetworkInput network = network_input(input, model, bars);
  network.fields = std::move(fields);
  add_slits(body, network);
  network.calibration = options.calibration;
  network.interfaces = weak_interfaces(input, body);
  if (options.draft) network.calibrating = Calibrating::estimated;
  if (body.spans.empty()) refuse_poissons_ratios(input, body, network);
  if (network.shell) refuse_impossible_shell(input, body, network);
  model.crack_cost = count_on_the_path(input, body, network);
  if (!options.draft) refuse_before_calibration(input, body, network, model);
  model.network = build_case_network(input, body, network);
  refuse_cracks_without_bonds(input, model);
  refuse_unbreakable_bodies(input, model.network);
  for (const auto& text :
       {short_horizon_note(model), unmeasured_cost_note(model),
        calibration_shortfall(model.network), path_note(input, model), unnotched_note(input, model),
        thin_body_note(input, model), joint_note(network, model)}) {
    if (text) model.notes.push_back(*text);
  }
  for (const std::string& text : strength_notes(input, model)) model.notes.push_back(text);
  for (const std::string& text : field_notes(network, model.network)) model.notes.push_back(text);
  for (const std::string& text : bar_notes(input)) model.notes.push_back(text);
  body.facets =
      std::move(model.network.facets);  // with the nodal area fractions that balance the bonds
}

}  // namespace perilink

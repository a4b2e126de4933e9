#include "network/builder/network_builder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "discretization/cuts/bonds_across_gaps.hpp"
#include "discretization/cuts/cracks.hpp"
#include "discretization/cuts/outside_bonds.hpp"
#include "discretization/mesh_faces.hpp"
#include "material/critical_stretch.hpp"
#include "material/micromodulus.hpp"
#include "network/bond_strength.hpp"
#include "network/builder/bar_elements.hpp"
#include "network/builder/beam_bonds.hpp"
#include "network/builder/crack_contacts.hpp"
#include "network/builder/graded_stiffness.hpp"
#include "network/builder/repeated_box.hpp"
#include "network/builder/shell_bonds.hpp"
#include "network/builder/softened_bonds.hpp"
#include "network/builder/tied_cells.hpp"
#include "network/correction/surface_correction.hpp"
#include "network/element_columns.hpp"
#include "network/lattice_neighbourhoods.hpp"
#include "network/unknowns.hpp"
#include "network/weak_interfaces.hpp"

namespace perilink {
namespace {

void check_input(const Body& body, const NetworkInput& input) {
  if (body.particles.dim != dimension_of(input.problem)) {
    throw std::invalid_argument("a " + std::to_string(body.particles.dim) +
                                "-dimensional lattice does not fit the kind of problem");
  }
  if (!(input.horizon > 0.0)) throw std::invalid_argument("the horizon must be positive");
  if (input.bars.size() != input.bar_materials.size()) {
    throw std::invalid_argument("every bar needs a material");
  }
  const auto last =
      std::max_element(body.particles.material.begin(), body.particles.material.end());
  if (last == body.particles.material.end() ||
      *last >= static_cast<Index>(input.materials.size())) {
    throw std::invalid_argument("a particle has a material that is not defined");
  }
}

/// Constants of the bonds between two materials.
struct BondConstants {
  MicropolarModuli moduli;  ///< means of the two materials
  double critical_stretch = 0.0;
};

class PairConstants {
 public:
  PairConstants(const Body& body, const NetworkInput& input) : count_(input.materials.size()) {
    std::vector<MicropolarModuli> moduli;
    for (const auto& material : input.materials) {
      moduli.push_back(moduli_of(body, input, material));
    }
    const bool on_lattice = input.critical_stretch == Constants::lattice;
    const InteriorNeighbourhood neighbourhood =
        on_lattice ? interior_neighbourhood(body.lattice, input.horizon) : InteriorNeighbourhood{};
    for (std::size_t a = 0; a < count_; ++a) {
      for (std::size_t b = 0; b < count_; ++b) {
        const double c = 0.5 * (moduli[a].micromodulus + moduli[b].micromodulus);
        // Peri2D, which uses ghosts, takes the mean.
        const double energy =
            body.lattice.surface == Surface::ghost
                ? 0.5 * (input.materials[a].fracture_energy + input.materials[b].fracture_energy)
                : energy_between(input.materials[a], input.materials[b]);
        const double stretch =
            !on_lattice ? continuum_critical_stretch(input.problem, energy, c, input.horizon,
                                                     input.thickness)
                        : lattice_critical_stretch(
                              energy, lattice_fracture_sum(input.problem, neighbourhood.offsets,
                                                           body.lattice.cell_volume, c));
        const double d = 0.5 * (moduli[a].bending_modulus + moduli[b].bending_modulus);
        pairs_.push_back({{c, d}, stretch});
      }
    }
  }

  const BondConstants& of(Index a, Index b) const { return pairs_[a * count_ + b]; }
  SlipSpringConstants tie(Index material) const {
    const auto& [moduli, stretch] = of(material, material);
    return {moduli.micromodulus, stretch};
  }

 private:
  std::size_t count_;
  std::vector<BondConstants> pairs_;
};

void add_bonds(const PairConstants& constants, const NetworkInput& input, Network& network) {
  const Particles& particles = network.particles;
  const auto count = static_cast<std::size_t>(network.bonds.size());
  network.stiffness.reserve(count);
  if (!input.elastic) network.critical_stretch.reserve(count);
  const bool bends = input.model == BondModel::micropolar;
  if (bends) network.bending.reserve(count);
  for (Index b = 0; b < network.bonds.size(); ++b) {
    const Index i = network.bonds.first[b];
    const Index j = network.bonds.second[b];
    const Index own = particles.material[i];  // a ghost is never first
    const bool ghost = particles.kind[j] == ParticleKind::ghost;
    const MicropolarModuli& moduli = constants.of(own, ghost ? own : particles.material[j]).moduli;
    const double part = ghost ? 0.5 : 1.0;
    const double length = network.bonds.length(b);
    network.stiffness.push_back(moduli.micromodulus * part * particles.volumes[i] *
                                particles.volumes[j] / length);
    const auto [first, second] = materials_of_bond(network, b);
    add_critical_stretch(input, constants.of(first, second).critical_stretch, network);
    if (!bends) continue;
    network.bending.push_back(12.0 * (moduli.bending_modulus * part) * particles.volumes[i] *
                              particles.volumes[j] / (length * length * length));
  }
}

/// Returns the pre-cracks, oriented so that one along a joint or an interface cuts the bonds of its
/// weaker side.
std::vector<Crack> cracks_on_weaker_sides(const Body& body, const NetworkInput& input,
                                          const Network& network) {
  std::vector<Crack> cracks = input.cracks;
  const double first = input.materials.front().fracture_energy;
  if (input.interfaces.empty() && std::ranges::all_of(input.materials, [&](const SolidMaterial& m) {
        return m.fracture_energy == first;
      })) {
    return cracks;
  }
  std::vector<double> weakness;  // per bond
  for (Index b = 0; b < network.bonds.size(); ++b) {
    const auto [i, j] = materials_of_bond(network, b);
    weakness.push_back(1.0 / energy_between(input.materials[i], input.materials[j]));
  }
  for (const WeakInterface& face : input.interfaces) {
    for (const Index b : bonds_across(body, input, face, network))
      weakness[b] = 1.0 / face.fracture_energy;
  }
  const auto cut_by = [&](const Crack& crack) {
    return find_cut_bonds(network.particles, network.bonds, {&crack, 1}, body.lattice.spacing).keep;
  };
  for (Crack& crack : cracks) {
    Crack turned = crack;
    std::reverse(turned.points.begin(), turned.points.end());
    const std::vector<std::uint8_t> keep = cut_by(crack), keep_turned = cut_by(turned);
    // Means over the short bonds that only one orientation of the crack cuts.
    std::array<double, 2> sum{}, count{};
    for (Index b = 0; b < network.bonds.size(); ++b) {
      if (keep[b] == keep_turned[b] || network.bonds.length(b) > 1.5 * body.lattice.spacing)
        continue;
      sum[keep[b]] += weakness[b];
      count[keep[b]] += 1.0;
    }
    if (sum[1] * count[0] > (1.0 + 1e-6) * sum[0] * count[1]) crack = turned;
  }
  return cracks;
}

/// Removes the bonds that cross a pre-crack.
ClosingCracks cut_bonds(const Body& body, const NetworkInput& input, Network& network) {
  ClosingCracks closing{cracks_on_weaker_sides(body, input, network), {}};
  const std::vector<Crack>& cracks = closing.cracks;
  CutBonds cut = find_cut_bonds(network.particles, network.bonds, cracks, body.lattice.spacing);
  network.report.cut_by_crack = std::move(cut.count);
  const CrackCutter cutter(cracks, network.dim(), body.lattice.spacing);
  const auto closes = [&](Index bond, const Crack& crack) {
    if (network.particles.kind[network.bonds.second[bond]] != ParticleKind::solid) return false;
    return crack.closes.value_or(
        std::ranges::all_of(materials_of_bond(network, bond),
                            [&](Index m) { return input.materials[m].softening.closes; }));
  };
  const auto at = [&](Index i) { return point_of(network.particles.positions, network.dim(), i); };
  for (Index b = 0; b < network.bonds.size(); ++b) {
    if (cut.keep[b] != 0) continue;
    const auto* piece =
        cutter.piece_between(at(network.bonds.first[b]), at(network.bonds.second[b]));
    if (!closes(b, cracks[piece->crack])) continue;
    const CutBond bond = cut_bond(network, b, piece->normal);
    if (bond.stiffness > 0.0) closing.bonds.push_back(bond);
  }
  keep_elements(network, cut.keep);
  return closing;
}

}  // namespace

namespace {

/// Shares equal directions of many bonds, which take most of the memory of a large elastic network.
void share_directions_of_many(const NetworkInput& input, Bonds& bonds) {
  constexpr Index many = 100'000;
  if (input.elastic && bonds.size() > many) share_directions(bonds);
}

/// Builds the bonds of the solid with calibrated stiffnesses.
Network make_calibrated_bonds(const Body& body, const NetworkInput& input,
                              const PairConstants& constants) {
  Network network;
  network.particles = body.particles;
  network.bonds = make_bonds(network.particles, input.horizon);
  remove_bonds_across_gaps(network.particles, network.bonds, input.solid,
                           1e-6 * body.lattice.spacing);
  if (body.lattice.pattern == Pattern::irregular) {
    remove_bonds_outside(network.particles, network.bonds, body.facets, body.lattice.spacing);
  }
  remove_loose_ghosts(network.particles, network.bonds);
  share_directions_of_many(input, network.bonds);
  network.facets = body.facets;
  set_materials_at_joints(input, network);
  add_bonds(constants, input, network);
  if (input.model == BondModel::micropolar) network.torsion = input.torsion;
  correct_surfaces(body, input, network);
  return network;
}

/// Sets the critical stretches of bonds calibrated in a template box.
void set_stretches(const Body& body, const NetworkInput& input, const PairConstants& constants,
                   Network& network) {
  if (input.elastic) return;
  set_materials_at_joints(input, network);
  network.critical_stretch.clear();  // the box has one material
  network.critical_stretch.reserve(network.stiffness.size());
  for (Index b = 0; b < network.bonds.size(); ++b) {
    const auto [i, j] = materials_of_bond(network, b);
    network.critical_stretch.push_back(constants.of(i, j).critical_stretch);
  }
  if (input.critical_stretch != Constants::lattice) return;
  set_critical_stretches(input, LatticeNeighbourhoods(body, input), body.lattice.cell_volume,
                         network);
}

/// Builds calibrated bonds, from a template box if possible, and removes those that pre-cracks cut.
/// \param closing  receives the pre-cracks that close
Network build_bonds(const Body& body, const NetworkInput& input, const PairConstants& constants,
                    ClosingCracks& closing) {
  const auto make = [&](const Body& whole_or_part, const NetworkInput& its_input) {
    return make_calibrated_bonds(whole_or_part, its_input, constants);
  };
  std::optional<Network> repeated = repeat_smaller_box(body, input, make);
  if (repeated) set_stretches(body, input, constants, *repeated);
  Network network = repeated ? std::move(*repeated) : make(body, input);
  scale_stiffness(input, network);
  if (!input.cracks.empty()) {
    // After the calibration: crack faces must not balance uniform stresses as surfaces do.
    closing = cut_bonds(body, input, network);
  }
  return network;
}

/// Builds the bonds of the body, or of a part with cells in the rest.
/// \param closing  receives the pre-cracks that close
Network build_bonds_and_cells(const Body& body, const NetworkInput& input,
                              const PairConstants& constants, ClosingCracks& closing) {
  if (body.tied.empty()) return build_bonds(body, input, constants, closing);
  const BondedPart part = bonded_part(body, input.thickness);
  Network network = build_bonds(part.body, input, constants, closing);
  join_cells(body, part, input, network);
  for (CutBond& bond : closing.bonds) {
    bond.first = part.whole_of[bond.first];
    bond.second = part.whole_of[bond.second];
  }
  return network;
}

/// Returns the bonds without the factors on Young's modulus; empty without factors.
EvenBonds unscaled(const Network& network, std::vector<double> modulus) {
  EvenBonds bonds;
  for (std::size_t b = 0; b < modulus.size(); ++b) {
    bonds.stiffness.push_back(network.stiffness[b] / modulus[b]);
    if (network.carries_moments()) bonds.bending.push_back(network.bending[b] / modulus[b]);
  }
  bonds.modulus = std::move(modulus);
  return bonds;
}

/// Returns the bonds as if all materials had equal constants everywhere; empty without interfaces
/// or with one stiffness. Calibrating a body of several materials gives bonds near joints
/// stiffnesses between the values of the materials, or outside this range.
EvenBonds even_bonds(const Body& body, const NetworkInput& input, const Network& network) {
  NetworkInput even = input;
  bool unlike = false;
  for (SolidMaterial& material : even.materials) {
    const SolidMaterial& first = input.materials.front();
    unlike = unlike || !(lame_constants(input, material) == lame_constants(input, first));
    material.youngs_modulus = first.youngs_modulus;
    material.poissons_ratio = first.poissons_ratio;
  }
  if (input.interfaces.empty()) return {};
  const std::size_t num_bonds = static_cast<std::size_t>(network.num_bonds());
  std::vector<double> modulus =
      modulus_between(input.fields, network.particles.positions, network.dim(),
                      std::span(network.bonds.first).first(num_bonds),
                      std::span(network.bonds.second).first(num_bonds));
  if (!unlike) return unscaled(network, std::move(modulus));
  even.fields.clear();
  even.interfaces.clear();
  even.cracks.clear();
  even.calibration.on_search = {};
  const PairConstants constants(body, even);
  ClosingCracks none;
  const Network whole = build_bonds_and_cells(body, even, constants, none);
  EvenBonds bonds{std::vector<double>(num_bonds, 0.0), {}, std::move(modulus)};
  if (!whole.bending.empty()) bonds.bending = bonds.stiffness;
  const auto ends = [](const Bonds& all, Index b) {
    return std::pair(all.first[b], all.second[b]);
  };
  const Index count = whole.bonds.size() - whole.num_edges_of_cells();
  Index at = 0;  // both are sorted by their ends
  for (Index b = 0; b < network.num_bonds(); ++b) {
    while (at < count && ends(whole.bonds, at) < ends(network.bonds, b)) ++at;
    if (at == count) break;
    if (ends(whole.bonds, at) != ends(network.bonds, b)) continue;
    bonds.stiffness[b] = whole.stiffness[at];
    if (!whole.bending.empty()) bonds.bending[b] = whole.bending[at];
  }
  return bonds;
}

}  // namespace

Network build_network(const Body& body, const NetworkInput& input) {
  check_input(body, input);
  if (!body.spans.empty()) return make_beam(body, input);
  const PairConstants constants(body, input);
  ClosingCracks closing;
  Network network = build_bonds_and_cells(body, input, constants, closing);
  RebarMesh mesh = add_rebar(network.particles, input.bars, body.lattice.spacing, input.horizon,
                             body.lattice.cell_volume);
  add_contacts(body, input, closing, network);
  add_bars(
      body, input, std::move(mesh), [&](Index material) { return constants.tie(material); },
      network);
  if (!input.elastic) {
    soften_bonds(body, input, network);
    weaken_interfaces(body, input, even_bonds(body, input, network), network);
  }
  complete_columns(network);  // of slip springs
  if (input.shell) make_shell(input, network);
  share_directions_of_many(input, network.bonds);
  return network;
}

std::vector<Index> find_loose_particles(const Network& network) {
  const auto is_loose = loosely_held(network.bonds, network.particles.size(), network.stiffness);
  const std::vector<std::uint8_t> rotating = rotating_particles(network);
  const std::vector<std::uint8_t> in_cells = vertices_of_cells(network);
  std::vector<Index> loose;
  for (Index i = 0; i < network.first_embedded_point(); ++i) {  // embedded points follow their
                                                                // particles
    if (!in_cells.empty() && in_cells[i] != 0) continue;
    // One frame element resists every direction.
    if (is_loose[i] && (rotating.empty() || !rotating[i])) loose.push_back(i);
  }
  return loose;
}

}  // namespace perilink

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
#include "discretization/cuts/outside_bonds.hpp"
#include "material/critical_stretch.hpp"
#include "material/micromodulus.hpp"
#include "network/bond_softening.hpp"
#include "network/bond_strength.hpp"
#include "network/builder/bar_elements.hpp"
#include "network/builder/beam_bonds.hpp"
#include "network/builder/glued_cells.hpp"
#include "network/builder/repeated_box.hpp"
#include "network/builder/shell_bonds.hpp"
#include "network/correction/surface_correction.hpp"
#include "network/lattice_families.hpp"
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

/// What a bond is made from.
struct BondConstants {
  MicropolarModuli moduli;  ///< means of those at its ends
  double critical_stretch = 0.0;
};

/// The constants of every pair of materials.
class PairConstants {
 public:
  PairConstants(const Body& body, const NetworkInput& input) : count_(input.materials.size()) {
    std::vector<MicropolarModuli> moduli;
    for (const auto& material : input.materials) {
      moduli.push_back(moduli_of(body, input, material));
    }
    const bool on_lattice = input.critical_stretch == Constants::lattice;
    const BulkFamily family = on_lattice ? bulk_family(body.lattice, input.horizon) : BulkFamily{};
    for (std::size_t a = 0; a < count_; ++a) {
      for (std::size_t b = 0; b < count_; ++b) {
        const double c = 0.5 * (moduli[a].micromodulus + moduli[b].micromodulus);
        const double energy =
            0.5 * (input.materials[a].fracture_energy + input.materials[b].fracture_energy);
        const double stretch = !on_lattice
                                   ? continuum_critical_stretch(input.problem, energy, c,
                                                                input.horizon, input.thickness)
                                   : lattice_critical_stretch(
                                         energy, lattice_fracture_sum(input.problem, family.offsets,
                                                                      body.lattice.cell_volume, c));
        const double d = 0.5 * (moduli[a].bending_modulus + moduli[b].bending_modulus);
        pairs_.push_back({{c, d}, stretch});
      }
    }
  }

  const BondConstants& of(Index a, Index b) const { return pairs_[a * count_ + b]; }
  TieConstants tie(Index material) const {
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
    const auto& [moduli, stretch] = constants.of(own, ghost ? own : particles.material[j]);
    const double part = ghost ? 0.5 : 1.0;
    const double length = network.bonds.length(b);
    network.stiffness.push_back(moduli.micromodulus * part * particles.volumes[i] *
                                particles.volumes[j] / length);
    add_critical_stretch(input, stretch, network);
    if (!bends) continue;
    network.bending.push_back(12.0 * (moduli.bending_modulus * part) * particles.volumes[i] *
                              particles.volumes[j] / (length * length * length));
  }
}

/// Takes out the bonds that cross a pre-crack, but for those that close.
void cut_bonds(const Body& body, const NetworkInput& input, Network& network) {
  CutBonds cut =
      find_cut_bonds(network.particles, network.bonds, input.cracks, body.lattice.spacing);
  network.cut_by_crack = std::move(cut.count);
  const auto closes = [&](Index bond) {
    const std::vector<Index>& material = network.particles.material;
    const std::array<Index, 2> ends =
        network.materials_of.empty()
            ? std::array{material[network.bonds.first[bond]], material[network.bonds.second[bond]]}
            : network.materials_of[bond];
    return std::all_of(ends.begin(), ends.end(), [&](Index m) {
      return m != no_index && input.materials[m].softening.closes;
    });
  };
  Index number = 0;
  for (Index b = 0; b < network.bonds.size(); ++b) {
    if (cut.keep[b] == 0 && closes(b)) {
      cut.keep[b] = 1;
      network.cut_elements.push_back(number);
    }
    number += cut.keep[b];
  }
  keep_elements(network, cut.keep);
}

}  // namespace

namespace {

/// They are most of what the network of a large elastic body takes, and calibrations come on top.
void share_directions_of_many(const NetworkInput& input, Bonds& bonds) {
  constexpr Index many = 100'000;
  if (input.elastic && bonds.size() > many) share_directions(bonds);
}

/// Bonds of the solid and their stiffness.
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
  add_bonds(constants, input, network);
  if (input.model == BondModel::micropolar) network.torsion = input.torsion;
  correct_surfaces(body, input, network);
  return network;
}

/// Critical stretches of bonds that were calibrated in a smaller box.
void set_stretches(const Body& body, const NetworkInput& input, const PairConstants& constants,
                   Network& network) {
  if (input.elastic) return;
  const std::vector<Index>& material = network.particles.material;
  network.critical_stretch.reserve(network.stiffness.size());
  for (Index b = 0; b < network.bonds.size(); ++b) {
    const Index i = network.bonds.first[b], j = network.bonds.second[b];
    network.critical_stretch.push_back(constants.of(material[i], material[j]).critical_stretch);
  }
  if (input.critical_stretch != Constants::lattice) return;
  set_critical_stretches(input, LatticeFamilies(body, input), body.lattice.cell_volume, network);
}

/// The same, made in a smaller box where that will do, without those that pre-cracks cut.
Network build_bonds(const Body& body, const NetworkInput& input, const PairConstants& constants) {
  const auto make = [&](const Body& whole_or_part, const NetworkInput& its_input) {
    return make_calibrated_bonds(whole_or_part, its_input, constants);
  };
  std::optional<Network> repeated = repeat_smaller_box(body, input, make);
  if (repeated) set_stretches(body, input, constants, *repeated);
  Network network = repeated ? std::move(*repeated) : make(body, input);
  if (!input.cracks.empty()) {
    // After the calibration: a crack is not a surface on which a uniform strain finds its stress.
    cut_bonds(body, input, network);
  }
  return network;
}

/// Bonds of a part of the body, and cells of the rest.
Network build_bonds_and_cells(const Body& body, const NetworkInput& input,
                              const PairConstants& constants) {
  const BondedPart part = bonded_part(body, input.thickness);
  Network network = build_bonds(part.body, input, constants);
  join_cells(body, part, input, network);
  return network;
}

}  // namespace

Network build_network(const Body& body, const NetworkInput& input) {
  check_input(body, input);
  if (!body.spans.empty()) return make_beam(body, input);
  const PairConstants constants(body, input);
  Network network = body.glued.empty() ? build_bonds(body, input, constants)
                                       : build_bonds_and_cells(body, input, constants);
  add_bars(
      body, input, [&](Index material) { return constants.tie(material); }, network);
  if (!input.elastic) {
    soften_bonds(body, input, network);
    weaken_interfaces(body, input, network);
    for (const Index e : network.cut_elements) network.critical_stretch[e] = infinity;
  } else if (!network.cut_elements.empty()) {
    network.laws = {BondLaw::brittle().closing()};
  }
  for (std::vector<double>* of_ties : {&network.bending, &network.bending_ratio}) {
    if (!of_ties->empty()) of_ties->resize(network.stiffness.size(), 0.0);
  }
  if (!network.inflection.empty()) network.inflection.resize(network.stiffness.size(), 0.5);
  if (!network.hinged.empty()) network.hinged.resize(network.stiffness.size(), 0);
  if (input.shell) make_shell(input, network);
  share_directions_of_many(input, network.bonds);
  return network;
}

std::vector<Index> find_loose_particles(const Network& network) {
  const auto is_loose = loosely_held(network.bonds, network.particles.size(), network.stiffness);
  const std::vector<std::uint8_t> rotating = rotating_particles(network);
  const std::vector<std::uint8_t> in_cells = vertices_of_cells(network);
  std::vector<Index> loose;
  for (Index i = 0; i < network.first_anchor(); ++i) {  // anchors go with their particles
    if (!in_cells.empty() && in_cells[i] != 0) continue;
    // One frame holds every direction.
    if (is_loose[i] && (rotating.empty() || !rotating[i])) loose.push_back(i);
  }
  return loose;
}

}  // namespace perilink

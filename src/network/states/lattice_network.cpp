#include "network/states/lattice_network.hpp"

#include <algorithm>
#include <tuple>

namespace perilink {
namespace {

/// A bond between two slots.
struct LatticeBond {
  Index first = 0, second = 0;
  int own = 0;  ///< index of the directed bond that determines length and modulus
};

/// Returns every bond once, sorted by its ends.
std::vector<LatticeBond> bonds_of(const LatticeRows& lattice) {
  std::vector<LatticeBond> bonds;
  const int own = lattice.own_bonds();
  for (std::size_t r = 0; r < lattice.rows.size(); ++r) {
    for (Index i = 0; i < lattice.rows[r].size; ++i) {
      const Index slot = lattice.rows[r].first + i;
      for (int k = 0; k < own; ++k) {
        if (lattice.present[lattice.at(k, slot)] == 0.0) continue;
        const Index partner = slot + lattice.shift_out[r * own + k];
        bonds.push_back({std::min(slot, partner), std::max(slot, partner), k});
      }
    }
  }
  std::sort(bonds.begin(), bonds.end(), [](const LatticeBond& a, const LatticeBond& b) {
    return std::tie(a.first, a.second) < std::tie(b.first, b.second);
  });
  return bonds;
}

/// Removes the bonds of loose particles until no particle is loose. \return whether each particle
/// stays
std::vector<std::uint8_t> leave_out_loose(Network& network) {
  for (;;) {
    const auto loose = loosely_held(network.bonds, network.particles.size());
    std::vector<std::uint8_t> keep;
    for (Index e = 0; e < network.num_elements(); ++e) {
      keep.push_back(!loose[network.bonds.first[e]] && !loose[network.bonds.second[e]]);
    }
    if (std::find(keep.begin(), keep.end(), 0) == keep.end()) {
      std::vector<std::uint8_t> stays;
      for (const std::uint8_t is_loose : loose) stays.push_back(!is_loose);
      return stays;
    }
    keep_elements(network, keep);
  }
}

}  // namespace

Particles lattice_particles(const LatticeRows& lattice, std::span<const Index> slots,
                            std::span<const double> volumes) {
  Particles particles;
  particles.dim = lattice.dim;
  for (const Index slot : slots) {
    for (int axis = 0; axis < lattice.dim; ++axis) {
      particles.positions.push_back(lattice.positions[lattice.at(axis, slot)]);
    }
    particles.volumes.push_back(volumes[slot]);
  }
  particles.material.assign(slots.size(), 0);
  particles.kind.assign(slots.size(), ParticleKind::solid);
  return particles;
}

LatticeNetwork lattice_network(const LatticeRows& lattice, std::span<const double> own_modulus,
                               double sum_modulus, std::span<const double> volumes) {
  LatticeNetwork result;
  Network& network = result.network;
  network.particles = lattice_particles(lattice, lattice.particle_slot, volumes);
  network.bonds.dim = lattice.dim;
  std::vector<Index> number(static_cast<std::size_t>(lattice.slots), no_index);
  for (Index i = 0; i < lattice.particles(); ++i) number[lattice.particle_slot[i]] = i;
  for (const LatticeBond& bond : bonds_of(lattice)) {
    network.bonds.append(network.particles, number[bond.first], number[bond.second]);
    network.stiffness.push_back(own_modulus[bond.own] / lattice.bonds[bond.own].length);
  }
  const std::vector<std::uint8_t> stays = leave_out_loose(network);
  keep_particles(network.particles, network.bonds, stays);
  for (Index i = 0; i < lattice.particles(); ++i) {
    if (stays[i]) result.slots.push_back(lattice.particle_slot[i]);
  }
  result.left_out = lattice.particles() - network.particles.size();
  network.states.emplace().stiffness.assign(result.slots.size(),
                                            sum_modulus / (2.0 * lattice.spacing));
  network.first_slip_spring = network.first_bar_element = network.bonds.size();
  return result;
}

}  // namespace perilink

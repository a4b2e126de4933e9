#include "network/lattice_network.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <tuple>

namespace perilink {
namespace {

/// Squared sines between directions of bonds below this are round-off.
constexpr double in_line = 1e-10;

/// A bond between two slots.
struct LatticeBond {
  Index first = 0, second = 0;
  int own = 0;  ///< number of the own bond, which settles length and modulus
};

/// Every bond once, sorted by its ends.
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

/// Whether bonds of these directions (sum of n n') leave a particle a direction to move in.
bool is_loose(Eigen::Matrix3d directions, int dim) {
  const double trace = directions.trace();
  if (dim == 2) directions(2, 2) = trace;  // the third direction is not asked for
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(directions, Eigen::EigenvaluesOnly);
  return !(solver.eigenvalues()[0] > in_line * trace);
}

/// Takes out loose particles until there are none. \return whether each slot stays
std::vector<std::uint8_t> leave_out_loose(const LatticeRows& lattice,
                                          std::vector<LatticeBond>& bonds) {
  std::vector<std::uint8_t> stays(static_cast<std::size_t>(lattice.slots), 0);
  for (const Index slot : lattice.particle_slot) stays[slot] = 1;
  std::vector<Eigen::Matrix3d> directions(static_cast<std::size_t>(lattice.slots));
  for (bool again = true; again;) {
    std::fill(directions.begin(), directions.end(), Eigen::Matrix3d::Zero());
    for (const LatticeBond& bond : bonds) {
      const Eigen::Map<const Eigen::Vector3d> n(lattice.bonds[bond.own].direction.data());
      directions[bond.first] += n * n.transpose();
      directions[bond.second] += n * n.transpose();
    }
    again = false;
    for (const Index slot : lattice.particle_slot) {
      if (stays[slot] == 0 || !is_loose(directions[slot], lattice.dim)) continue;
      stays[slot] = 0;
      again = true;
    }
    std::erase_if(bonds, [&](const LatticeBond& bond) {
      return stays[bond.first] == 0 || stays[bond.second] == 0;
    });
  }
  return stays;
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
  std::vector<LatticeBond> bonds = bonds_of(lattice);
  const std::vector<std::uint8_t> stays = leave_out_loose(lattice, bonds);
  LatticeNetwork result;
  std::vector<Index> number(static_cast<std::size_t>(lattice.slots), no_index);
  for (const Index slot : lattice.particle_slot) {
    if (stays[slot] == 0) continue;
    number[slot] = static_cast<Index>(result.slots.size());
    result.slots.push_back(slot);
  }
  result.left_out = lattice.particles() - static_cast<Index>(result.slots.size());
  Network& network = result.network;
  network.particles = lattice_particles(lattice, result.slots, volumes);
  network.bonds.dim = lattice.dim;
  for (const LatticeBond& bond : bonds) {
    network.bonds.append(network.particles, number[bond.first], number[bond.second]);
    network.stiffness.push_back(own_modulus[bond.own] / lattice.bonds[bond.own].length);
  }
  network.state_stiffness.assign(result.slots.size(), sum_modulus / (2.0 * lattice.spacing));
  network.critical_stretch.assign(network.stiffness.size(),
                                  std::numeric_limits<double>::infinity());
  network.first_tie = network.first_segment = network.bonds.size();
  return result;
}

}  // namespace perilink

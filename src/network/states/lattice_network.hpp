#pragma once

#include <span>
#include <vector>

#include "discretization/lattices/lattice_rows.hpp"
#include "network/network.hpp"

namespace perilink {

/// A lattice of state-based particles for statics.
struct LatticeNetwork {
  Network network;
  std::vector<Index> slots;  ///< slots of its particles in the lattice, ascending
  Index left_out = 0;        ///< number of particles that bonds hold in fewer than dim directions
};

/// Returns solid particles of material 0 at slots of a lattice.
/// \param volumes  per slot [length^3]
Particles lattice_particles(const LatticeRows& lattice, std::span<const Index> slots,
                            std::span<const double> volumes);

/// Returns the intact lattice as a network for small displacements. Bonds have the stiffness a / L
/// and states the stiffness b / (2 L_0); the energy is sum_i sum_j L_j F_j S_j / 4
/// (docs/theory/lattice_particles.md, section 6). Particles held by one bond or a line of bonds, as
/// at the corners of turned lattices, would move freely. They are left out with the particles that
/// depend on them. All others have material 0 and no law.
/// \param own_modulus  coefficient a of directed bond k [force]
/// \param sum_modulus  coefficient b of the sum of the stretches [force]
/// \param volumes      per slot [length^3]
LatticeNetwork lattice_network(const LatticeRows& lattice, std::span<const double> own_modulus,
                               double sum_modulus, std::span<const double> volumes);

}  // namespace perilink

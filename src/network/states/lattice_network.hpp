#pragma once

#include <span>
#include <vector>

#include "discretization/lattices/lattice_rows.hpp"
#include "network/network.hpp"

namespace perilink {

/// A lattice of state-based particles for statics.
struct LatticeNetwork {
  Network network;
  std::vector<Index> slots;  ///< where its particles are in the lattice, ascending
  Index left_out = 0;        ///< particles that bonds hold in fewer than dim directions
};

/// Solid particles at slots of a lattice, of material 0.
/// \param volumes  per slot [length^3]
Particles lattice_particles(const LatticeRows& lattice, std::span<const Index> slots,
                            std::span<const double> volumes);

/// The intact lattice as a network for small displacements: bonds of stiffness a / L and particles
/// with states of stiffness b / (2 L_0), whose energy is sum_i sum_j L_j F_j S_j / 4
/// (docs/theory/lattice_particles.md, section 6). Particles that hang on a bond or a line of bonds,
/// as at the corners of turned lattices, could move for nothing and are left out, with those that
/// hung on them. All others have material 0; nothing breaks.
/// \param own_modulus  coefficient a of own bond k [force]
/// \param sum_modulus  b, coefficient of the sum of the stretches [force]
/// \param volumes      per slot [length^3]
LatticeNetwork lattice_network(const LatticeRows& lattice, std::span<const double> own_modulus,
                               double sum_modulus, std::span<const double> volumes);

}  // namespace perilink

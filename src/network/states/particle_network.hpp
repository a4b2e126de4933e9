#pragma once

#include <span>

#include "discretization/lattices/lattice.hpp"
#include "material/elasticity.hpp"
#include "material/states/state_fit.hpp"
#include "network/network.hpp"

namespace perilink {

/// How the constants of the particles of a body were found.
struct ParticleFitReport {
  Index exact = 0, least = 0, many = 0, indefinite = 0, singular = 0;  ///< families of each FitKind
  Index enlarged = 0;  ///< families that needed more than the nearest neighbours
  double mean_residual = 0.0, largest_residual = 0.0;  ///< [-]
  Index worst = no_index;                              ///< particle of the largest residual
};

/// A body of state-based particles (SPPM, Nikravesh 2017, chapter 3). Scattered ones are kept for
/// comparison with the papers: they are too soft, and no refinement helps
/// (docs/theory/lattice_particles.md, section 7).
struct ParticleNetwork {
  Network network;
  ParticleFitReport report;
};

/// Neighbours of a particle (Eq. 3.50): all that are no farther than its sixth (in the plane) or
/// eighteenth nearest one, not counting those that can be reached only by leaving the body, and as
/// many more as are needed for every strain to stretch some bond. Distances that differ by a
/// millionth are equal: regular arrangements keep their symmetry.
inline constexpr int neighbors_in_plane = 6, neighbors_in_space = 18;

/// Particles with the volumes of their Voronoi cells and the constants of fit_particle_moduli().
/// Neighbours need not be mutual: a bond has the force of the state of each end to which the other
/// one is a neighbour, and exists where at least one is. Its force is the mean of the two states'
/// (Eq. 3.7), which derive from the energy
///   sum_i 1/4 sum_(j neighbour of i) L_ij F_ij S_ij.
/// Nothing breaks by a stretch: no bond has a critical one.
/// \param body       with cells
/// \param materials  by Particles::material
/// \param thickness  two-dimensional bodies only [length]
ParticleNetwork make_particle_network(const Body& body, Problem problem,
                                      std::span<const IsotropicMaterial> materials,
                                      double thickness);

}  // namespace perilink

#pragma once

#include <span>

#include "discretization/lattices/lattice.hpp"
#include "material/elasticity.hpp"
#include "material/states/state_fit.hpp"
#include "network/network.hpp"

namespace perilink {

/// Statistics of the fit of particle constants.
struct ParticleFitReport {
  Index exact = 0, least = 0, many = 0, indefinite = 0, singular = 0;  ///< number per FitKind
  Index enlarged = 0;  ///< neighbourhoods with more than the nearest neighbours
  double mean_residual = 0.0, largest_residual = 0.0;  ///< [-]
  Index worst = no_index;                              ///< particle of the largest residual
};

/// A body of state-based particles (SPPM, Nikravesh 2017, chapter 3). Unstructured sets serve for
/// comparison with the papers: they are too soft, and refinement does not help
/// (docs/theory/lattice_particles.md, section 7).
struct ParticleNetwork {
  Network network;
  ParticleFitReport report;
};

/// Number of nearest neighbours of a particle (Eq. 3.50). All particles not farther than the sixth
/// nearest (in the plane) or the eighteenth nearest (in space) count. Particles that can only be
/// reached by leaving the body do not. More are added until every strain stretches some bond.
/// Relative differences of distances up to 1e-6 are ignored, so that regular arrangements keep
/// their symmetry.
inline constexpr int neighbors_in_plane = 6, neighbors_in_space = 18;

/// Returns particles with the volumes of their Voronoi cells and the constants of
/// fit_particle_moduli(). A bond exists if at least one end is a neighbour of the other, which need
/// not be mutual. Its force is the mean of the two states' forces (Eq. 3.7); an end counts if the
/// other is its neighbour. The energy is
///   sum_i 1/4 sum_(j neighbour of i) L_ij F_ij S_ij.
/// Bonds have no critical stretch.
/// \param body       with cells
/// \param materials  by Particles::material
/// \param thickness  thickness of two-dimensional bodies [length]
ParticleNetwork make_particle_network(const Body& body, Problem problem,
                                      std::span<const IsotropicMaterial> materials,
                                      double thickness);

}  // namespace perilink

#pragma once

#include <span>
#include <vector>

#include "base/csr.hpp"
#include "material/elasticity.hpp"
#include "material/j2_plasticity.hpp"
#include "network/network.hpp"

/// \file
/// Stresses of an elastic body at its particles.

namespace perilink {

/// [force/length^2], in the order of VTK's symmetric tensors.
using Stress = SymmetricTensor;

/// What stresses at particles are found from.
struct StressInput {
  const Network& network;
  const Csr& families;  ///< bonds of each particle (bonds_of_particles)
  Problem problem = Problem::plane_stress;
  std::span<const HookeConstants> materials;  ///< by Particles::material
  /// Whether neighbours of neighbours count, too: edges of linear elements alone are too few.
  bool second_neighbors = false;
};

/// Hooke's law for the displacement gradient at a particle. The gradient is that of the polynomial
/// of second degree through the particle's own displacement that fits those of its neighbours of
/// the same material best, each weighted with 1/distance^2: exact for quadratic fields, at the
/// surface too, so that the error falls with the square of the horizon. Where the neighbours do not
/// settle a quadratic field a linear one is fitted, and where they do not settle that the stress is
/// zero. In plane strain zz = lambda (e_xx + e_yy). Forces between bonds play no part: in a
/// homogeneous strain their virial is this stress, elsewhere it averages over the horizon.
/// \param displacement  shape (particles, dim)
Stress stress_at(const StressInput& input, std::span<const double> displacement, Index particle);

/// The same at all particles, zero at those that are not solid; shape (particles, 6).
std::vector<double> particle_stresses(const StressInput& input,
                                      std::span<const double> displacement);

}  // namespace perilink

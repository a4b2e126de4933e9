#pragma once

#include <span>
#include <vector>

#include "base/csr.hpp"
#include "material/elasticity.hpp"
#include "material/j2_plasticity.hpp"
#include "network/network.hpp"

/// \file
/// Stresses at the particles of a body, whole or damaged.

namespace perilink {

/// [force/length^2], in the order of VTK's symmetric tensors.
using Stress = SymmetricTensor;

/// What stresses at particles are found from.
struct StressInput {
  const Network& network;
  const Csr& neighbourhoods;  ///< bonds of each particle (bonds_of_particles)
  Problem problem = Problem::plane_stress;
  std::span<const HookeConstants> materials;  ///< by Particles::material
  /// Whether neighbours of neighbours count, too: edges of linear elements alone are too few.
  bool second_neighbors = false;
  Secants secants = {};  ///< one per element; empty: nothing is damaged
};

/// Hooke's law for the strain at a particle (docs/theory/stress.md). Where all its bonds are intact
/// that is the gradient of the polynomial of second degree through the particle's own displacement
/// that fits those of its neighbours of the same material best, each weighted with 1/distance^2:
/// exact for quadratic fields, at the surface too. Where the neighbours do not settle a quadratic
/// field a linear one is fitted, and where they do not settle that the stress is zero. Where bonds
/// are damaged it is bond_strain(), so that they count with the forces that they still carry. In
/// plane strain zz = lambda (e_xx + e_yy).
/// \param motion  shape (particles, width)
Stress stress_at(const StressInput& input, std::span<const double> motion, Index particle);

/// The same at all particles, zero at those that are not solid; shape (particles, 6).
std::vector<double> particle_stresses(const StressInput& input, std::span<const double> motion);

}  // namespace perilink

#pragma once

#include <span>

#include "assembly/results/surface_conditions.hpp"
#include "base/csr.hpp"
#include "material/elasticity.hpp"
#include "material/j2_plasticity.hpp"
#include "network/network.hpp"

namespace perilink {

/// Stress [force/length^2], in the order of VTK's symmetric tensors.
using Stress = SymmetricTensor;

/// Input of the stress computation.
struct StressInput {
  const Network& network;
  const Csr& neighbourhoods;  ///< bonds of each particle (bonds_of_particles)
  Problem problem = Problem::plane_stress;
  std::span<const HookeConstants> materials;  ///< by Particles::material
  /// Include neighbours of neighbours: the edges of linear elements are too few.
  bool second_neighbors = false;
  Secants secants = {};                        ///< one per element; empty: undamaged
  const SurfaceConditions* surface = nullptr;  ///< nothing: unknown
  /// Young's modulus over that of the material [-], per particle; empty: 1.
  std::span<const double> modulus = {};
};

}  // namespace perilink

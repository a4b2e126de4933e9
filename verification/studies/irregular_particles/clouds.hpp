#pragma once

#include <vector>

#include "analysis/dynamics/lattice/lattice_analysis.hpp"
#include "network/states/particle_network.hpp"
#include "network/unknowns.hpp"

namespace perilink::verification {

inline constexpr double youngs_modulus = 25e9, poissons_ratio = 0.2;  // Pa
inline constexpr double strength = 2.62e6;                            // Pa

/// A bar along y of state-based particles whose places inside are random.
struct UnstructuredParticles {
  double width = 1.0, length = 1.0;  ///< width and depth [m]
  double thickness = 1.0;            ///< in the plane [m]
  Problem problem = Problem::plane_stress;
  /// Spacing of the lattice, hexagonal or cubic, that the particles leave [m].
  double spacing = 0.1;
  double scatter = 0.0;  ///< by at most this many spacings along each axis
  bool square = false;   ///< instead of hexagonal
};

/// \throws std::runtime_error where the scatter turns a cell of the mesh inside out
ParticleNetwork build(const UnstructuredParticles& particle_set);

/// The bar stretched by `extension`; free to contract at its ends, held against rigid motions.
Unknowns pull(const UnstructuredParticles& particle_set, const Network& network, double extension);

/// How the bar stretches.
struct Stretching {
  double modulus = 0.0;       ///< apparent Young's modulus over that of the solid
  double displacement = 0.0;  ///< largest error over the extension
};
Stretching stretch(const UnstructuredParticles& particle_set, const ParticleNetwork& built);

/// Energy that a crack takes [N/m].
inline constexpr double fracture_energy = 0.5 * strength * (2e-5 + 0.25 * 2e-4);

/// The bar torn apart within some sixty fundamental periods; only its middle third can
/// break.
ExplicitResult tear(const UnstructuredParticles& particle_set, const ParticleNetwork& built);

}  // namespace perilink::verification

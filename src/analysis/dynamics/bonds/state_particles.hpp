#pragma once

#include <memory>
#include <span>

#include "analysis/dynamics/bonds/explicit_bonds.hpp"
#include "material/crack_opening.hpp"
#include "material/elasticity.hpp"
#include "network/network.hpp"

namespace perilink {

/// Material of state-based particles.
struct StateMaterial {
  double youngs_modulus = 0.0;  ///< [force/length^2]
  double poissons_ratio = 0.0;
  bool breakable = false;
  CrackOpeningLaw softening;
  /// Tensile damage at which damage in compression begins.
  double compressive_threshold = 1.0 / 3.0;
};

/// Checks the widths of crack bands.
/// \throws std::invalid_argument where a particle's crack band is so wide that stress would fall
///     faster than it unloads: the spacing is too large for the softening
/// \param materials  by Particles::material
/// \param thickness  two-dimensional bodies only [length]
void check_bands(const Particles& particles, std::span<const StateMaterial> materials,
                 double thickness);

/// State-based particles with unstructured neighbours (SPPM, Nikravesh 2017, chapter 3; elastic
/// constants: network/states/particle_network.hpp) in small strains. Damage follows the two-spring
/// rule of the consistent lattice rules. Forces derive from
///   sum_bonds d k e^2 / 2 + sum_i c_i (sum_(j neighbour of i) d_ij e_ij)^2 / 2,
/// with extensions e and damage factors d of the two ends.
///
/// The stress of a particle is Hooke's law for the strain that fits the extensions of its
/// neighbours' bonds best. In bonds between different damages the particle uses its own share of
/// the extension. The fit is exact under uniform strains for any arrangement of neighbours; a
/// stress from the forces of few scattered bonds is not. Unstructured particles are too soft at any
/// number and are kept for comparison with the papers.
///
/// Damage follows the opening of a crack in a band as wide as a square (cube) of the particle's
/// volume. It weakens bonds from the next step on.
/// \param materials  by Particles::material
/// \param thickness  two-dimensional bodies only [length]
/// \throws std::invalid_argument where check_bands() does
std::unique_ptr<ExplicitBonds> make_explicit_particles(const Network& network, Problem problem,
                                                       std::span<const StateMaterial> materials,
                                                       double thickness);

}  // namespace perilink

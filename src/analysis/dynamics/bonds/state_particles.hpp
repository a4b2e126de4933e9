#pragma once

#include <memory>
#include <span>

#include "analysis/dynamics/bonds/explicit_bonds.hpp"
#include "material/crack_opening.hpp"
#include "material/elasticity.hpp"
#include "network/network.hpp"

namespace perilink {

/// What a state-based particle is made of.
struct StateMaterial {
  double youngs_modulus = 0.0;  ///< [force/length^2]
  double poissons_ratio = 0.0;
  bool breakable = false;
  CrackOpeningLaw softening;
  /// Tensile damage at which damage in compression begins.
  double compressive_threshold = 1.0 / 3.0;
};

/// \throws std::invalid_argument where a particle's band of a crack is so wide that its stress
/// would fall faster than it unloads: particles too far apart for the softening
/// \param materials  by Particles::material
/// \param thickness  two-dimensional bodies only [length]
void check_bands(const Particles& particles, std::span<const StateMaterial> materials,
                 double thickness);

/// State-based particles with neighbours anywhere (SPPM, Nikravesh 2017, chapter 3; elastic
/// constants: network/states/particle_network.hpp) in small strains, with the two-spring damage of
/// the consistent rules of lattices: forces derive from
///   sum_bonds d k e^2 / 2 + sum_i c_i (sum_(j neighbour of i) d_ij e_ij)^2 / 2,
/// e the extensions and d the factors of damage of the two ends.
///
/// A particle's stress is Hooke's of the strain that fits the extensions of its neighbours' bonds
/// best, each particle's share of bonds between different damages counted as its own, which is
/// exact under uniform strains wherever the neighbours are; the stress of the forces of a few
/// scattered bonds is not. Scattered particles are kept for comparison with the papers: they are
/// too soft, however many there are. Damage follows the opening of a crack in a band as wide as a
/// square (cube) of the particle's volume. It weakens bonds from the next step on.
/// \param materials  by Particles::material
/// \param thickness  two-dimensional bodies only [length]
/// \throws std::invalid_argument as check_bands() does
std::unique_ptr<ExplicitBonds> make_explicit_particles(const Network& network, Problem problem,
                                                       std::span<const StateMaterial> materials,
                                                       double thickness);

}  // namespace perilink

#pragma once

#include <span>

#include "base/types.hpp"
#include "material/elasticity.hpp"

namespace perilink {

/// A bond of a particle to one of its neighbours.
struct NeighbourhoodBond {
  Vector3 direction{};  ///< unit vector
  double length = 0.0;  ///< L [length]
  bool far = false;     ///< to one of the second neighbours
};

/// Elastic constants of a state-based particle with neighbours anywhere. The force state of bond j:
///   F_j = (own + [j is far] far) S_j + state sum_m L_m S_m.
struct ParticleModuli {
  double own = 0.0;    ///< a [force]
  double far = 0.0;    ///< c [force]
  double state = 0.0;  ///< b, with the lengths in the sum [force/length]
};

/// How Eq. 3.20 of a particle was solved.
enum class FitKind {
  exact,       ///< the family carries every uniform strain as Hooke's solid does
  least,       ///< no constants do; these come nearest
  many,        ///< several do, far bonds being like near ones: those without `far`
  indefinite,  ///< the nearest ones would give a deformation no energy: bonds without states
  singular,    ///< the same, since some strain leaves all bonds of the family as they are
};

/// Constants of a particle and how well they fit.
struct ParticleFit {
  ParticleModuli moduli;
  FitKind kind = FitKind::exact;
  /// Difference between the stresses of uniform strains and Hooke's, over Hooke's (Frobenius norms
  /// of the fourth-order tensors) [-].
  double residual = 0.0;
};

/// Constants of a particle by least squares of D = M K N (Nikravesh 2017, Eq. 3.20), which makes
/// its stress (1 / 2V) sum_j L_j F_j n_j n_j' under uniform strains that of Hooke's solid, in the
/// norm of the tensors, so that axes do not matter. Departs from the dissertation where that is
/// neither isotropic nor derived from an energy (docs/theory/lattice_particles.md): far bonds have
/// their own stretch, in the plane too, and lengths weigh the sum.
/// \param volume  V of the particle [length^3]
ParticleFit fit_particle_moduli(Problem problem, double youngs_modulus, double poissons_ratio,
                                std::span<const NeighbourhoodBond> neighbourhood, double volume);

}  // namespace perilink

#pragma once

#include <span>

#include "base/types.hpp"
#include "material/elasticity.hpp"

namespace perilink {

/// A bond of a particle to one of its neighbours.
struct NeighbourhoodBond {
  Vector3 direction{};  ///< unit vector
  double length = 0.0;  ///< L [length]
  bool far = false;     ///< to a second neighbour
};

/// Elastic constants of a state-based particle with any arrangement of neighbours. The force state
/// of bond j is
///   F_j = (own + [j is far] far) S_j + state sum_m L_m S_m.
struct ParticleModuli {
  double own = 0.0;    ///< a [force]
  double far = 0.0;    ///< c [force]
  double state = 0.0;  ///< b, with lengths in the sum [force/length]
};

/// Outcome of solving Eq. 3.20 for a particle.
enum class FitKind {
  exact,       ///< every uniform strain has Hooke's stress
  least,       ///< no exact solution; least squares
  many,        ///< several solutions, since far bonds are equivalent to near ones: the one without
               ///< `far`
  indefinite,  ///< the least-squares energy is not positive in every deformation: bonds without
               ///< states
  singular,    ///< bonds without states, since some strain stretches no bond of the neighbourhood
};

/// Constants of a particle and the quality of their fit.
struct ParticleFit {
  ParticleModuli moduli;
  FitKind kind = FitKind::exact;
  /// Difference between the stresses of uniform strains and Hooke's, over Hooke's, in Frobenius
  /// norms of the fourth-order tensors [-].
  double residual = 0.0;
};

/// Returns the constants of a particle by least squares of D = M K N (Nikravesh 2017, Eq. 3.20).
/// Its stress (1 / 2V) sum_j L_j F_j n_j n_j' under uniform strains then matches Hooke's solid in
/// the norm of the tensors, independent of axes. The fit departs from the dissertation where that
/// is not isotropic or not conservative (docs/theory/lattice_particles.md). Far bonds have their
/// own stretch, in the plane too, and lengths weight the sum.
/// \param volume  V of the particle [length^3]
ParticleFit fit_particle_moduli(Problem problem, double youngs_modulus, double poissons_ratio,
                                std::span<const NeighbourhoodBond> neighbourhood, double volume);

}  // namespace perilink

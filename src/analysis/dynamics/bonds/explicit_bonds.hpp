#pragma once

#include <span>
#include <vector>

#include "base/types.hpp"

namespace perilink {

/// Motion of a network at step n: displacements now, velocities half a step earlier, both of shape
/// (particles, width).
struct BondMotion {
  std::vector<double> displacement;  ///< [length], rotations [-]
  std::vector<double> velocity;      ///< [length/time, 1/time]
};

/// What happened to the bonds of some particles in a step; halves of bonds count half.
struct BondLosses {
  double fractured = 0.0;  ///< energy that breaking bonds and yielding bars gave up [force length]
  /// Bonds whose halves at these particles broke, both where both ends are among them; where
  /// particles crack and not bonds, the particles in which damage began.
  std::vector<Index> broken;

  Index broken_halves() const { return static_cast<Index>(broken.size()); }
};

/// The elements of a network as an explicit run sees them: every particle holds its own half of
/// each of its bonds, so that particles need nothing from each other but displacements, and the
/// sums are the same for any number of threads. Both halves of a bond measure its deformation from
/// the same end and break in the same step.
///
/// The bonds, stiffnesses and critical stretches of the implicit mode (docs/theory/bonds.md,
/// micropolar.md), the same teeth of yielding bars.
class ExplicitBonds {
 public:
  virtual ~ExplicitBonds() = default;

  /// Whether forces need sums over the neighbours of both ends of a bond: prepare() then comes
  /// before forces(), for all particles, and finish_step() once after them.
  virtual bool has_states() const { return false; }
  virtual BondLosses prepare(Index /*begin*/, Index /*end*/, double /*time_step*/,
                             const BondMotion& /*motion*/) {
    return {};
  }
  virtual void finish_step() {}

  /// Internal force, K u of small strains, of the particles [begin, end), after the bonds that
  /// reach their limit at this displacement have broken. Calls for different particles may run at
  /// once.
  /// \param force  shape (particles, width); these particles' part is overwritten
  virtual BondLosses forces(Index begin, Index end, double time_step, const BondMotion& motion,
                            std::span<double> force) = 0;

  /// u_(n-1)' K u_n / 2 of these particles' halves [force length]: with the kinetic energy half a
  /// step ago what Euler–Cromer keeps exactly. Of Green strains the like with g_(n-1) g_n, which it
  /// keeps but for a part of the kinetic energy as small as the stretches.
  virtual double stored(Index begin, Index end, double time_step,
                        const BondMotion& motion) const = 0;

  /// Present secant stiffness of each element over the intact one [-].
  virtual std::vector<double> secants() const = 0;

  /// Damage of each particle [-]; empty where bonds break and not particles.
  virtual std::vector<double> damage() const { return {}; }
};

}  // namespace perilink

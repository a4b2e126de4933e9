#pragma once

#include <span>
#include <vector>

#include "base/types.hpp"

namespace perilink {

struct MovingElements;

/// Motion of a network at step n: displacements now, velocities half a step earlier, both of shape
/// (particles, width).
struct BondMotion {
  std::vector<double> displacement;  ///< [length], rotations [-]
  std::vector<double> velocity;      ///< [length/time, 1/time]
};

/// Losses of the bonds of some particles in a step; halves of bonds count half.
struct BondLosses {
  double fractured = 0.0;  ///< energy lost by breaking bonds and yielding bars [force length]
  /// Bonds whose halves at these particles broke; a bond with both ends among the particles appears
  /// twice. State-based: the particles in which damage began.
  std::vector<Index> broken;

  Index broken_halves() const { return static_cast<Index>(broken.size()); }
};

/// Elements of a network in an explicit run. Every particle has its own half of each of its bonds
/// and needs only displacements of others. So sums do not depend on the number of threads. Both
/// halves of a bond measure its deformation from one end and break in one step.
///
/// Bonds, stiffnesses, critical stretches and segments of yielding bars are those of the implicit
/// mode (docs/theory/bonds.md, micropolar.md).
class ExplicitBonds {
 public:
  virtual ~ExplicitBonds() = default;

  /// Returns whether forces need sums over the neighbours of both ends of a bond. If so, prepare()
  /// comes before forces() for all particles, and finish_step() once after them.
  virtual bool has_states() const { return false; }
  virtual BondLosses prepare(Index /*begin*/, Index /*end*/, double /*time_step*/,
                             const BondMotion& /*motion*/) {
    return {};
  }
  virtual void finish_step() {}

  /// Computes the internal force of the particles [begin, end), K u for small strains, after
  /// breaking the bonds that reach their limit. Calls for different particles may run in parallel.
  /// \param force  shape (particles, width) [force]; the part of these particles is overwritten
  virtual BondLosses forces(Index begin, Index end, double time_step, const BondMotion& motion,
                            std::span<double> force) = 0;

  /// Returns u_(n-1)' K u_n / 2 of these particles' halves [force length]. Euler–Cromer conserves
  /// the sum of it and the kinetic energy half a step ago. With Green strains it is the product of
  /// g_(n-1) and g_n, conserved up to a fraction of the kinetic energy as small as the stretches.
  virtual double stored(Index begin, Index end, double time_step,
                        const BondMotion& motion) const = 0;

  /// Returns the secant stiffness ratio of each element [-].
  virtual std::vector<double> secants() const = 0;

  /// Returns the damage of each particle [-]; empty where bonds break.
  virtual std::vector<double> damage() const { return {}; }

  /// Writes the values between two steps that set-up cannot rebuild.
  virtual void save(MovingElements& state) const = 0;
  /// Continues from saved values, in elements just constructed from the same network.
  /// \throws std::invalid_argument where the state is that of another body
  virtual void restore(const MovingElements& state) = 0;
};

}  // namespace perilink

#pragma once

#include <vector>

#include "base/types.hpp"
#include "discretization/lattices/lattice_rows.hpp"
#include "material/crack_opening.hpp"
#include "material/elasticity.hpp"
#include "material/j2_plasticity.hpp"
#include "material/lattice_rules.hpp"
#include "material/states/state_moduli.hpp"

namespace perilink {

/// Material of a lattice body.
struct LatticeMaterial {
  double youngs_modulus = 0.0;  ///< [force/length^2]
  double poissons_ratio = 0.0;
  double density = 0.0;  ///< [mass/length^3]
  bool breakable = false;
  CrackOpeningLaw softening;
  /// Tensile damage at which damage in compression begins.
  double compressive_threshold = 1.0 / 3.0;
  bool yields = false;
  /// Yield stress over plastic strain. With LatticeRules::consistent, failure_strain follows from
  /// crushing_energy; the other rules soften as their papers state.
  YieldCurve yielding;
  double crushing_energy = 0.0;   ///< dissipated by softening per area; infinite: none
                                  ///< [force/length]
  double boundary_factor = 1.0;   ///< beta_1: factor of the stress of particles that lack bonds [-]
  double internal_damping = 0.0;  ///< damping ratio at the frequency of a particle's own vibration
  double external_damping = 0.0;  ///< damping ratio at the fundamental frequency of the body
  /// Longest period of the body [time]; needed for external damping.
  double fundamental_period = 0.0;
};

/// A component of a particle's motion that is prescribed: amplitude times the load factor.
struct PrescribedMotion {
  Index slot = 0;
  int component = 0;
  double amplitude = 0.0;  ///< at load factor 1 [length]; zero: a support
};

/// A force on a component of a particle: value times the load factor.
struct AppliedForce {
  Index slot = 0;
  int component = 0;
  double value = 0.0;  ///< at load factor 1 [force]
};

/// Constant data of an explicit lattice run.
struct ExplicitModel {
  Problem problem = Problem::plane_stress;
  LatticeRules rules = LatticeRules::consistent;
  LatticeRows lattice;
  LatticeMaterial material;
  double thickness = 1.0;  ///< two-dimensional bodies only [length]
  StateModuli moduli;
  std::vector<double> mass;          ///< per slot; one where it is empty [mass]
  std::vector<double> inverse_mass;  ///< zero where a slot is empty
  std::vector<double> volume;        ///< volume over which a particle's stress is taken [length^3]
  std::vector<std::vector<PrescribedMotion>> prescribed;  ///< per row, by slot
  std::vector<std::vector<AppliedForce>> applied;         ///< per row, by slot; empty: no forces
  /// component along which reactions of supports are summed: that of the largest amplitude
  int load_component = 1;
  double bond_damping = 0.0;  ///< force of a bond per velocity of its ends [force time/length]
  double mass_damping = 0.0;  ///< force per momentum [1/time]

  /// Returns the coefficient of the own stretch of own bond k [force].
  double own_modulus(int k) const {
    return moduli.own + (lattice.bonds[k].length > 1.2 * lattice.spacing ? moduli.far : 0.0);
  }
  /// Returns whether particles can be damaged or yield.
  bool alters() const { return material.breakable || material.yields; }
  /// Returns whether damage reduces a bond's stretch in the sums of its ends by a factor other than
  /// that of its force.
  bool weighs_halves() const { return material.breakable && rules == LatticeRules::consistent; }
};

/// Returns the rate of mass-proportional damping that damps a vibration of a period with a ratio
/// [1/time]: twice the ratio times the circular frequency (Nikravesh 2017, Eq. 3.57).
double mass_damping_rate(double ratio, double period);

/// Returns a body without supports, with masses, moduli and damping.
/// \throws std::invalid_argument for an impossible material (see hexagonal_moduli), different
///     dimensions of lattice and problem, damage or flow by the rules of 2018 in space, or a
///     spacing at which the stress of a band falls faster than it unloads
ExplicitModel make_explicit_model(Problem problem, LatticeRules rules, LatticeRows lattice,
                                  const LatticeMaterial& material, double thickness);

/// Prescribes a component of the motion of particles.
void prescribe(ExplicitModel& model, const std::vector<PrescribedMotion>& motions);

/// Returns the width of the crack band of a particle [length]: its volume over the area of a crack.
/// The crack runs in steps along rows (in space: densest planes) of the lattice.
/// \param normal  unit vector normal to the crack
double band_width(const ExplicitModel& model, const Vector3& normal);

/// Returns an upper bound of the square of the highest circular frequency of the body [1/time^2].
/// Every bond's energy is at most k (p_i + p_j) times the kinetic form of its two particles, with
/// p_i the largest eigenvalue of particle i's own stiffness over its mass. The bound is exact far
/// from surfaces where the sum of the stretches softens (poissons_ratio up to 1/3 in plane stress,
/// 1/4 else).
double frequency_bound_squared(const ExplicitModel& model);

/// Returns the time step below which Euler–Cromer with lagging damping forces is stable [time]: the
/// positive root of dt^2 K + 2 dt C = 4 with upper bounds of both operators.
double critical_time_step(const ExplicitModel& model);

}  // namespace perilink

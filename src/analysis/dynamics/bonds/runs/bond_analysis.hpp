#pragma once

#include "analysis/dynamics/bonds/moving_bonds.hpp"
#include "analysis/dynamics/bonds/state_particles.hpp"
#include "base/parcel.hpp"
#include "material/strain.hpp"

namespace perilink {

/// What a network with states is made of.
struct StateBody {
  Problem problem = Problem::plane_stress;
  double thickness = 1.0;  ///< two-dimensional bodies only [length]
  std::vector<StateMaterial> materials;
};

/// What moves the bonds of a run and how.
struct BondRunRules {
  double damping_rate = 0.0;  ///< [1/time]
  Strain strain = Strain::small;
  /// Prescribed displacements are those at the end of the duration, reached at constant velocity;
  /// else they follow the load factor.
  bool constant_velocity = false;
  StateBody states{};  ///< looked at where the network has states
};

/// Runs a network of bonds, truss or frame, from rest by Euler–Cromer: forces at step n change
/// velocities, those the displacements. Loads and prescribed displacements are those of the
/// implicit analyses times the load factor over time, ramped_load_factor(); so are the bonds and
/// where they break. With the ramp many times the fundamental period (fundamental_period.hpp) long
/// the run is quasistatic but for the moments in which bonds break.
///
/// Damping is in proportion to the mass: force = rate times mass times velocity, at the middle of
/// the step, so that it costs nothing of the critical time step.
///
/// The energies of a row balance to round-off, since every force works over the mean of the old and
/// the new velocity, the stored energy is u_(n-1)' K u_n / 2, and a bond that breaks at step n
/// loses its own part of that. Of Green strains they balance but for a part of the kinetic energy
/// as small as the stretches, docs/theory/explicit_bonds.md, section 5.
/// \param options  `reference` is not looked at. Ranks share the work where there are blocks of
///                 particles for all of them; every sum is the same as without them
/// \throws std::invalid_argument where the time step exceeds the critical one (unless
/// refuse_unstable is off) or the duration is not positive
/// \returns ending = failed where energy grows from nothing; peak_displacement is zero where loads
/// drive the body
ExplicitResult run_explicit_bonds(const LoadedNetwork& problem, const Inertia& inertia,
                                  const BondRunRules& rules, const ExplicitOptions& options,
                                  BondRunObserver& observer);

/// The work of another rank in a run that ranks share.
void move_bonds_along(Ranks& ranks, Parcel& order);

}  // namespace perilink

#pragma once

#include "analysis/dynamics/bonds/moving_bonds.hpp"
#include "analysis/dynamics/bonds/state_particles.hpp"
#include "base/parcel.hpp"
#include "material/strain.hpp"

namespace perilink {

/// Material of a network of state-based particles.
struct StateBody {
  Problem problem = Problem::plane_stress;
  double thickness = 1.0;  ///< two-dimensional bodies only [length]
  std::vector<StateMaterial> materials;
};

/// Rules of motion of a run.
struct BondRunRules {
  double damping_rate = 0.0;  ///< [1/time]
  Strain strain = Strain::small;
  /// true: prescribed displacements are reached at the end of the duration at constant velocity;
  /// false: they follow the load factor.
  bool constant_velocity = false;
  StateBody states{};  ///< used where the network has states
};

/// Runs a network of truss or frame bonds from rest by Euler–Cromer: forces at step n change
/// velocities, and these the displacements. Loads and prescribed displacements of the implicit
/// analyses are multiplied by ramped_load_factor() over time. Bonds and their limits are those of
/// the implicit analyses. With a ramp of many fundamental periods (fundamental_period.hpp) the run
/// is quasistatic except while bonds break.
///
/// Damping forces are rate times mass times velocity at the middle of the step. They do not reduce
/// the critical time step.
///
/// The energies of a row balance to round-off. Every force works over the mean of the old and the
/// new velocity. The stored energy is u_(n-1)' K u_n / 2, and a bond that breaks at step n loses
/// its own part of it. With Green strains they balance up to a fraction of the kinetic energy as
/// small as the stretches (docs/theory/explicit_bonds.md, section 5).
/// \param options  `reference` is not used. Ranks share the work where each has at least one block
///                 of particles; every sum is the same as on one process
/// \param from     state in which a run of this problem, these rules and options was saved; null:
///                 the run starts at rest. Runs that ranks share have no saved states
/// \throws std::invalid_argument where the time step exceeds the critical one (unless
///     refuse_unstable is off), the duration is not positive, `from` is of another body or run, or
///     ranks would share a run with `from`
/// \returns termination = failed where energy grows without external work; peak_displacement is
///          zero in runs under loads
ExplicitResult run_explicit_bonds(const LoadedNetwork& problem, const Inertia& inertia,
                                  const BondRunRules& rules, const ExplicitOptions& options,
                                  BondRunObserver& observer, const TimeState* from = nullptr);

/// Runs the part of a worker in a shared run.
void move_bonds_along(Ranks& ranks, Parcel& order);

}  // namespace perilink

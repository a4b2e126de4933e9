#pragma once

#include "analysis/damage_analysis.hpp"
#include "analysis/explicit_analysis.hpp"
#include "analysis/explicit_bonds.hpp"
#include "analysis/inertia.hpp"
#include "assembly/unknowns.hpp"

namespace perilink {

/// What observers of an explicit run of bonds may look at, valid during the call only.
struct BondRunState {
  const Network& network;
  const BondMotion& motion;
  const ExplicitBonds& bonds;
};

/// Watches a run.
class BondRunObserver {
 public:
  virtual ~BondRunObserver() = default;
  virtual void on_row(const ExplicitRecord& record, const BondRunState& state) = 0;
  /// Once, after the last row.
  virtual void on_end(const ExplicitRecord& /*last*/, const BondRunState& /*state*/) {}
  /// Asked before every row and every few hundred steps; after a yes comes one more row.
  virtual bool stop_requested() { return false; }
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
/// loses its own part of that.
/// \param damping_rate  [1/time]
/// \param options       `reference` is not looked at
/// \throws std::invalid_argument where the time step exceeds the critical one (unless
/// refuse_unstable is off) or the duration is not positive
/// \returns ending = failed where energy grows from nothing; peak_displacement is zero where loads
/// drive the body
ExplicitResult run_explicit_bonds(const Network& network, const Unknowns& unknowns,
                                  const Loads& loads, const ReferenceLoad& reference,
                                  const Inertia& inertia, double damping_rate,
                                  const ExplicitOptions& options, BondRunObserver& observer);

}  // namespace perilink

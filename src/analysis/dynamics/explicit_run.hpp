#pragma once

#include <cmath>
#include <string>

#include "analysis/quasistatic/observer.hpp"

namespace perilink {

class Ranks;
struct TimeState;

/// \file
/// Options, rows and results of explicit runs of bonds and lattices.

/// Returns the load factor: (1 - cos(pi t / ramp)) / 2 up to `ramp`, then one.
double ramped_load_factor(double time, double ramp);

/// Time stepping of an explicit run.
struct ExplicitOptions {
  double duration = 0.0;   ///< [time]
  double ramp = 0.0;       ///< time in which the load factor rises from zero to one [time]
  double time_step = 0.0;  ///< zero: `safety` times the critical one [time]
  double safety = 0.9;
  int rows = 500;  ///< approximate number of rows of the history
  /// Displacement of the displacement-controlled particles at load factor 1 [length]. Without them
  /// (`driven` is false): the load at load factor 1 [force].
  double reference = 1.0;
  bool driven = true;
  int threads = 1;
  /// communicator of explicit bonds, one thread per rank; null: one process
  Ranks* ranks = nullptr;
  /// false: a step beyond the critical one runs until the energy grows
  bool refuse_unstable = true;

  /// Returns the number of steps; needs a positive `time_step`.
  Index steps() const { return static_cast<Index>(std::ceil(duration / time_step)); }
};

/// Energies of an explicit run [force length].
struct EnergyBalance {
  double kinetic = 0.0;
  double stored = 0.0;
  double internal_damping = 0.0;
  double external_damping = 0.0;
  double fractured = 0.0;
  double external_work = 0.0;
  double plastic = 0.0;

  /// Returns the energy that appeared (+) or vanished (-) [force length].
  double surplus() const {
    return kinetic + stored + internal_damping + external_damping + fractured + plastic -
           external_work;
  }
  friend bool operator==(const EnergyBalance&, const EnergyBalance&) = default;
  template <class Archive>
  void serialize(Archive& archive) {
    archive(kinetic, stored, internal_damping, external_damping, fractured, external_work, plastic);
  }
};

/// One row of an explicit history.
struct ExplicitRecord {
  Index step = 0;
  double time = 0.0;  ///< [time]
  double load_factor = 0.0;
  double load = 0.0;              ///< force on controlled particles, inertia included [force]
  double support_reaction = 0.0;  ///< along the load [force]
  double displacement = 0.0;      ///< displacement of controlled particles [length]
  Index cracked_particles = 0;    ///< lattices only
  Index yielded_particles = 0;    ///< lattices only
  Index broken_bonds = 0;         ///< networks of bonds only
  EnergyBalance energy;

  friend bool operator==(const ExplicitRecord&, const ExplicitRecord&) = default;
  template <class Archive>
  void serialize(Archive& archive) {
    archive(step, time, load_factor, load, support_reaction, displacement, cracked_particles,
            yielded_particles, broken_bonds, energy);
  }
};

/// Observer of a run over time; the state is valid during the call only. Every function does
/// nothing by default.
template <class State>
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  virtual void on_row(const ExplicitRecord& /*record*/, const State& /*state*/) {}
  /// Called once, after the last row.
  virtual void on_end(const ExplicitRecord& /*last*/, const State& /*state*/) {}
  /// Called every few hundred iterations of a dynamic relaxation.
  virtual void on_iteration(Index /*load_step*/, Index /*iteration*/, double /*residual*/) {}
  /// Returns whether the run is to stop. Called before every row and every few hundred steps; a
  /// stopped run writes one more row.
  virtual bool stop_requested() { return false; }
  /// Returns whether on_checkpoint() is to be called. Called by one thread between two steps after
  /// a row, or after a load step of a relaxation; never after the last row, and never in runs
  /// shared by several processes, which have no checkpoints.
  /// \param last  the last row
  virtual bool wants_checkpoint(const ExplicitRecord& /*last*/) { return false; }
  /// Receives the state from which a run goes on with identical rows; called after the observer
  /// has asked for it. An exception ends the run as failed.
  virtual void on_checkpoint(const TimeState& /*state*/) {}
};

/// Result of an explicit run.
struct ExplicitResult {
  Termination termination = Termination::completed;
  std::string reason;
  Index steps = 0;
  double time_step = 0.0;           ///< [time]
  double critical_time_step = 0.0;  ///< [time]
  double peak_load = 0.0;           ///< largest support reaction in magnitude [force]
  double peak_displacement = 0.0;   ///< displacement of controlled particles at the peak [length]
  double largest_surplus = 0.0;  ///< largest energy surplus over the external work at the end [-]
  int ranks = 1;                 ///< number of processes that shared the work
  ExplicitRecord last;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(termination, reason, steps, time_step, critical_time_step, peak_load, peak_displacement,
            largest_surplus, ranks, last);
  }
};

}  // namespace perilink

#pragma once

#include <cmath>
#include <string>

#include "analysis/quasistatic/observer.hpp"

namespace perilink {

class Ranks;

/// \file
/// How explicit runs are asked for and what they tell, whatever they move.

/// Load factor over time: (1 - cos(pi t / ramp)) / 2 up to `ramp`, then one.
double ramped_load_factor(double time, double ramp);

/// How an explicit run goes through time.
struct ExplicitOptions {
  double duration = 0.0;   ///< [time]
  double ramp = 0.0;       ///< time in which the load factor rises from zero to one [time]
  double time_step = 0.0;  ///< zero: `safety` times the critical one [time]
  double safety = 0.9;
  int rows = 500;  ///< about how many the history gets
  /// Displacement of the driven particles at load factor 1 [length]; where nothing is driven
  /// (`driven` is false) the load there [force].
  double reference = 1.0;
  bool driven = true;
  int threads = 1;
  Ranks* ranks = nullptr;       ///< that share the work of bonds, each by one thread; null: none do
  bool refuse_unstable = true;  ///< false: a step beyond the critical one runs until it is noticed

  /// Where the time step is given.
  Index steps() const { return static_cast<Index>(std::ceil(duration / time_step)); }
};

/// Where the energy is [force length].
struct EnergyBalance {
  double kinetic = 0.0;
  double stored = 0.0;
  double internal_damping = 0.0;
  double external_damping = 0.0;
  double fractured = 0.0;
  double external_work = 0.0;
  double plastic = 0.0;

  /// Energy that appeared (+) or vanished.
  double surplus() const {
    return kinetic + stored + internal_damping + external_damping + fractured + plastic -
           external_work;
  }
  friend bool operator==(const EnergyBalance&, const EnergyBalance&) = default;
};

/// One row of an explicit history.
struct ExplicitRecord {
  Index step = 0;
  double time = 0.0;  ///< [time]
  double load_factor = 0.0;
  double load = 0.0;              ///< force on the driven particles, inertia included [force]
  double support_reaction = 0.0;  ///< along the load [force]
  double displacement = 0.0;      ///< at the driven particles [length]
  Index cracked_particles = 0;    ///< lattices only
  Index yielded_particles = 0;    ///< lattices only
  Index broken_bonds = 0;         ///< networks of bonds only
  EnergyBalance energy;

  friend bool operator==(const ExplicitRecord&, const ExplicitRecord&) = default;
};

/// Watches a run over time; the state is valid during the call only. By itself it looks at nothing.
template <class State>
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  virtual void on_row(const ExplicitRecord& /*record*/, const State& /*state*/) {}
  /// Once, after the last row.
  virtual void on_end(const ExplicitRecord& /*last*/, const State& /*state*/) {}
  /// Every few hundred iterations of a dynamic relaxation.
  virtual void on_iteration(Index /*load_step*/, Index /*iteration*/, double /*residual*/) {}
  /// Asked before every row and every few hundred steps; after a yes comes one more row.
  virtual bool stop_requested() { return false; }
};

/// How an explicit run ended.
struct ExplicitResult {
  Termination termination = Termination::completed;
  std::string reason;
  Index steps = 0;
  double time_step = 0.0;           ///< [time]
  double critical_time_step = 0.0;  ///< [time]
  double peak_load = 0.0;           ///< largest support reaction in magnitude [force]
  double peak_displacement = 0.0;  ///< displacement of the driven particles at that moment [length]
  double largest_surplus = 0.0;    ///< over the external work at the end [-]
  int ranks = 1;                   ///< that shared the work
  ExplicitRecord last;
};

}  // namespace perilink

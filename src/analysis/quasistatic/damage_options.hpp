#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/quasistatic/events/event_engine.hpp"
#include "analysis/quasistatic/load_curve.hpp"
#include "analysis/quasistatic/observer.hpp"
#include "network/network.hpp"
#include "solver/factor.hpp"

/// \file
/// What a damage analysis is asked for, and what it finds.

namespace perilink {

/// When a run ends before collapse.
struct StopRules {
  std::optional<Index> broken_bonds;
  std::optional<double> load_fraction;  ///< |load| below this fraction of its peak
  int load_fraction_rows = 10;  ///< successive rows that have to lie below: between two events of a
                                ///< growing crack the load may dip deep and come back
  std::optional<double> displacement;  ///< |displacement| at or above this [length]
};

/// One of the stages of a run: a set of loads goes to a load factor, or by events until a stop rule
/// is met.
struct StageRules {
  std::size_t set = 0;       ///< LoadedNetwork::sets: the loads that change
  std::optional<double> to;  ///< load factor at which it ends
  StopRules stop;
  /// Load at which it ends [force]; absent, and without `to`: by events.
  std::optional<double> to_load = {};
};

/// How a stage ended.
struct StageResult {
  Termination termination = Termination::completed;
  std::string reason;
  StepRecord last;     ///< row at its end
  CurvePoint peak;     ///< highest row of its loads so far, see DamageResult::peak_load
  CurvePoint largest;  ///< |load| of them
  std::optional<double> smoothed_peak_load;
};

struct DamageOptions {
  EquilibriumOptions engine;
  std::vector<double> load_factors;  ///< control by steps when not empty, else by events
  StopRules stop;
  std::vector<StageRules> stages;  ///< one after the other, in place of those two
  int check_interval = 50;         ///< events between looks at the residual
  /// Asked after each row: unknowns that move the particles from now on, which must outlive the
  /// run; null: those of before. Empty: they never change.
  std::function<const Unknowns*(StateSource&)> new_motion;
  /// Whether a conversion that comes late ends the analysis by a LateConversion, so that it begins
  /// again; otherwise these are counted.
  bool begins_again = false;
};

/// A bond that finite elements let go of was past its limit before: the analysis has to begin again
/// with these elements alone.
struct MissedRelease {
  std::vector<std::uint8_t> whole;  ///< as CarriedBody::whole
};

struct DamageResult {
  Termination termination = Termination::completed;
  std::string reason;               ///< in words
  std::vector<StageResult> stages;  ///< those that began, where the run has any
  StepRecord last;
  Index broken_bonds = 0;  ///< with the one that separated the body, if it did
  /// Largest |load| before the body had failed, with its sign; with bars that of all rows.
  double peak_load = 0.0;
  double peak_displacement = 0.0;            ///< displacement at the peak load
  PeakWatch peaks;                           ///< first and largest peak
  Index broken_as_gave_way = 0;              ///< bonds broken when the body first gave way
  std::optional<double> smoothed_peak_load;  ///< where the path of events is long enough
  double initial_stiffness = 0.0;            ///< load / displacement of the intact body
  double largest_residual = 0.0;
  Index conversions = 0;  ///< times that finite elements let go of particles
  /// Conversions after which a bond was farther beyond its limit than the alert allowed for: it may
  /// have failed before, unseen.
  Index missed_releases = 0;
  Index elements = 0;  ///< that carry particles now
  Index unknowns = 0;  ///< now
  /// Largest |work - stored - dissipated - freed| / work of all rows, the stored energy summed over
  /// the elements wherever the whole equilibrium was measured.
  double energy_error = 0.0;
  bool beyond_small_strains = false;  ///< a bond was shorter than they allow (StrainWatch)
  FactorStatistics factor;
};

}  // namespace perilink

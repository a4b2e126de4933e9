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
/// Options and results of a damage analysis.

namespace perilink {

/// Rules that end a run before collapse.
struct StopRules {
  std::optional<Index> broken_bonds;
  /// |load| below this fraction of the largest of its sign, and fallen in the present stage.
  std::optional<double> load_fraction;
  /// Successive rows that must lie below `load_fraction`, since the load may dip deeply between two
  /// events of a growing crack.
  int load_fraction_rows = 10;
  std::optional<double> displacement;  ///< |displacement| at or above this [length]
};

/// One stage of a run. A load case moves to a load factor, or by events until a stop rule is met.
struct StageRules {
  std::size_t set = 0;       ///< index into LoadedNetwork::sets: the load case that changes
  std::optional<double> to;  ///< load factor at which the stage ends
  StopRules stop;
  /// Load at which the stage ends [force]. Without `to` and `to_load` the stage runs by events.
  std::optional<double> to_load = {};
};

/// Result of one stage.
struct StageResult {
  Termination termination = Termination::completed;
  std::string reason;
  StepRecord last;     ///< last row of the stage
  CurvePoint peak;     ///< highest row of its load case so far, see DamageResult::peak_load
  CurvePoint largest;  ///< row with the largest |load| of its load case so far
  std::optional<double> smoothed_peak_load;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(termination, reason, last, peak, largest, smoothed_peak_load);
  }
};

struct DamageOptions {
  EquilibriumOptions engine;
  std::vector<double> load_factors;  ///< control by steps when not empty, else by events
  StopRules stop;
  std::vector<StageRules> stages;  ///< in order; they replace `load_factors` and `stop`
  int check_interval = 50;         ///< events between residual checks
  /// Whether a missed host release ends the analysis, so that it can start again: a bond that a
  /// release freed had exceeded its limit before. Otherwise missed releases are counted.
  bool begins_again = false;
  /// Returns whether to stop now, for example after a signal; asked between events.
  std::function<bool()> stop_requested = {};
  /// Returns why the run or its stage is complete after the last row, by a rule of its own.
  std::function<std::optional<std::string>()> rule_met = {};
};

struct DamageResult {
  Termination termination = Termination::completed;
  std::string reason;               ///< why the run ended
  std::vector<StageResult> stages;  ///< stages that began
  StepRecord last;
  Index broken_bonds = 0;  ///< includes a bond that separated the body
  /// Largest |load| before the body failed, with its sign [force]. In bodies with bars, the largest
  /// of all rows.
  double peak_load = 0.0;
  double peak_displacement = 0.0;  ///< displacement at the peak load
  PeakWatch peaks;                 ///< first and largest peak
  /// Largest |load| of the other sign before the body failed; absent if that is small.
  std::optional<CurvePoint> other_peak;
  Index broken_as_gave_way = 0;              ///< broken bonds when the body first gave way
  std::optional<double> smoothed_peak_load;  ///< absent if the path of events is too short
  double initial_stiffness = 0.0;            ///< load / displacement of the intact body
  double largest_residual = 0.0;
  Index conversions = 0;  ///< number of host releases
  /// Host releases after which a bond exceeded its limit by more than the release threshold allows.
  /// The bond may have failed earlier, undetected.
  Index missed_releases = 0;
  Index elements = 0;  ///< active hosts now
  Index unknowns = 0;  ///< number of unknowns now
  /// Largest |work - stored - dissipated - constraint energy| / work of all rows [-]. The stored
  /// energy is summed over the elements at full residual checks.
  double energy_error = 0.0;
  bool beyond_small_strains = false;  ///< a bond shortened beyond small strains (StrainWatch)
  FactorStatistics factor;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(termination, reason, stages, last, broken_bonds, peak_load, peak_displacement, peaks,
            other_peak, broken_as_gave_way, smoothed_peak_load, initial_stiffness, largest_residual,
            conversions, missed_releases, elements, unknowns, energy_error, beyond_small_strains,
            factor.factorizations, factor.iterations, factor.most_bytes);
  }
};

}  // namespace perilink

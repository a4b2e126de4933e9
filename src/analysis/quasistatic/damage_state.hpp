#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/quasistatic/damage_options.hpp"
#include "analysis/quasistatic/events/body_state.hpp"
#include "analysis/quasistatic/events/event_engine.hpp"
#include "analysis/quasistatic/path_energy.hpp"
#include "analysis/quasistatic/strain_watch.hpp"
#include "base/error.hpp"

namespace perilink {

/// Position of a damage analysis on its load path, with all that it has recorded.
struct PathState {
  StepRecord row;                ///< last row
  std::vector<StepRecord> rows;  ///< rows of the present load case; empty under control by steps
  DamageResult result;           ///< so far; `factor` is of former engines
  std::optional<Event> pending;  ///< event of the last row, not applied yet
  std::size_t position = 0;      ///< index of the next load factor, or of the present stage
  bool in_stage = false;         ///< the stage has begun
  bool over = false;             ///< the last row ended the run
  PathEnergy energy;
  PathEnergy following;  ///< within a load step: energies of a load that follows the events
  StrainWatch strains;
  double compliance = 0.0;          ///< f'u - R'd at load factor 1 [force length]
  double checked_compliance = 0.0;  ///< compliance at the last full residual check
  double stored_by_elements = std::numeric_limits<double>::quiet_NaN();
  Beside stored_by_permanent;  ///< contribution of permanent loads to the stored energy
  double most_work = 0.0;      ///< largest work or energy so far, for stages [force length]
  int events = 0;
  int looks = 0;  ///< scheduled residual checks so far
  /// Load fraction of the stop rule, and successive rows below it.
  std::optional<double> load_fraction;
  int rows_below = 0;
  /// Largest |load| of positive and of negative loads, of the load case and of the present stage.
  std::array<double, 2> largest{}, largest_of_stage{};
  Index broken_bonds = 0;
  Index yield_events = 0;
  /// Bonds that host releases freed since the last event, with the load factor of each release.
  std::vector<std::pair<std::vector<Index>, double>> freed;
  std::vector<std::uint8_t> whole;  ///< per finite element: it is an active host; empty: none

  /// Sets the compliance under the loads of a run or stage.
  /// \throws SolverError if they do no work on the body
  void begin_work(const LoadWork& work) {
    const double sum = work.forces + work.supports;
    compliance = work.compliance();
    if (!(sum > 0.0) && !work.separated) throw SolverError("the loads do no work on the body");
    if (!std::isfinite(sum)) throw SolverError("the elastic solution is not finite");
  }
  void end(Termination termination, std::string reason) {
    result.termination = termination;
    result.reason = std::move(reason);
  }
  /// Records the residual and, if it was summed over the elements, the stored energy.
  void note(const Balance& balance) {
    row.residual = balance.residual;
    stored_by_elements = balance.stored_energy;
    stored_by_permanent = balance.stored_by_permanent;
    result.largest_residual = std::max(result.largest_residual, balance.residual);
    if (!std::isnan(balance.stored_energy)) checked_compliance = compliance;
  }
  /// Adds the prescribed load factor to the reason of a collapse under forces.
  void note_overload(double load_factor) {
    if (result.termination != Termination::collapsed) return;
    result.reason =
        fmt::format("the body cannot carry the load factor {:.6g}: {}", load_factor, result.reason);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(row, rows, result, pending, position, in_stage, over, energy, following, strains,
            compliance, checked_compliance, stored_by_elements, stored_by_permanent, most_work,
            events, looks, load_fraction, rows_below, largest, largest_of_stage, broken_bonds,
            yield_events, freed, whole);
  }
};

/// Returns whether a row lies below the load fraction of the stop rule. The load is compared with
/// the largest of its sign. One that holds back earlier loads is no load of the body, and is
/// compared with the largest of the other sign.
inline bool is_below(const StepRecord& row, const PathState& path) {
  if (!path.load_fraction) return false;
  const std::size_t sign = row.load < 0.0 ? 1 : 0;
  const std::size_t loaded = path.largest_of_stage[sign] > 0.0 ? sign : 1 - sign;
  const double load = std::abs(row.load);
  return load < path.largest_of_stage[loaded] && load < *path.load_fraction * path.largest[loaded];
}

/// Returns whether the last row lies below the load fraction. Load steps below the largest load
/// factor so far are no fall.
/// \param load_factors  of load steps; empty: a run by events or stages
inline bool has_fallen(const PathState& path, const std::vector<double>& load_factors) {
  const auto begin = load_factors.begin();
  const auto end = load_factors.empty() ? begin : begin + static_cast<Index>(path.position);
  const bool unloads = end != begin && path.row.load_factor < *std::max_element(begin, end);
  return !unloads && is_below(path.row, path);
}

/// State of a damage analysis between two rows: all that the run cannot rebuild from its problem
/// and options.
struct DamageState {
  BodyState body;
  PathState path;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(body, path);
  }
};

}  // namespace perilink

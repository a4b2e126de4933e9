#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/quasistatic/damage_options.hpp"
#include "analysis/quasistatic/damage_state.hpp"
#include "analysis/quasistatic/events/staged_engine.hpp"
#include "analysis/quasistatic/host_release.hpp"
#include "base/timer.hpp"

/// \file
/// Loop of the damage analysis, row by row. Control by events and by steps is in
/// damage_analysis.cpp, control by stages in staged_run.cpp, host releases in releasing_run.cpp.

namespace perilink {

/// THE MAIN JOB: loads a network of bonds that soften and break, event by event, until it collapses
/// or a stop rule is met:
///
///     EventRun run(problem, options);
///     while (const StepRecord* row = run.next()) write(*row, run.state());
///     const DamageResult result = run.result();
class EventRun final : public StateSource {
 public:
  /// \param problem  must outlive the run, as must the options
  /// \throws SolverError if there is no equilibrium, or the loads do no work
  /// \throws CracksSeparate if initial cracks cut off a piece that the first loads pull away
  EventRun(const LoadedNetwork& problem, const DamageOptions& options);

  /// Goes on from a saved state. All that follows equals, bit by bit, the run that saved it if that
  /// one went on from it too: the new factor changes the last digits.
  /// \param saved  of this problem with these options, except for stop rules
  EventRun(const LoadedNetwork& problem, const DamageOptions& options, DamageState saved);

  /// Advances to the next row.
  /// \return the row, valid until the next call; null at the end: see result(). If the solver fails
  ///         or memory runs out, the result holds all rows so far.
  const StepRecord* next();

  /// Returns the state in the equilibrium of the last row. Displacements may cost a solve.
  StepState state() override;
  StepState unsolved_state() override;
  std::vector<double> completed(const StepState& earlier) override;
  Secants secants() override { return engine_->secants(); }

  /// Ends the run as failed, for a reason outside of the solver, as a full disk.
  void fail(const std::exception& error);
  /// Returns sizes of the factor, and its work so far.
  FactorStatistics factor_statistics() const;
  /// Returns the result so far. Peaks are found anew from all rows.
  DamageResult result() const;
  /// Returns the active hosts with which the analysis must start again, if a host release was
  /// missed and DamageOptions::begins_again is set; the run has then ended.
  const std::optional<std::vector<std::uint8_t>>& missed_release() const { return missed_; }

  /// Returns all that the run needs to go on after the last row.
  DamageState save() const;

  /// Changes how particles move after the last row. Prescribed motions stay.
  /// \param unknowns  must outlive the run
  void adopt(const Unknowns& unknowns);

  /// Checks the equilibrium in full. \throws SolverError if there is none
  void check() { path_.note(engine_->check_equilibrium()); }

 private:
  std::unique_ptr<EventEngine> make_engine();
  bool by_events();
  bool by_steps();
  // Control by stages: staged_run.cpp.
  bool by_stages();
  bool leave_row(const Event& event);
  bool follow_stage();
  void begin_stage();
  void follow_rules();
  const StageRules& stage() const { return options_.stages[path_.position]; }
  void record(double load_factor, const LoadWork& work, const Event& event);
  // Host releases: releasing_run.cpp.
  bool converts(const Event& event, double sense = 1.0,
                double most = std::numeric_limits<double>::infinity());
  void take_over(const Unknowns& unknowns, double load_factor);
  bool is_beyond_small_strains(double load_factor);
  bool leaves_small_strains(const Event& event);
  void record_separated(double load_factor, const LoadWork& work);
  bool pass(const Event& event);

  const Network& network_;
  const LoadedNetwork& problem_;
  const DamageOptions& options_;
  const ReferenceLoad* reference_;  ///< reference load of the present stage or run
  const StopRules* stop_;           ///< stop rules of the present stage or run
  PathState path_;
  std::optional<HostRelease> host_release_;  ///< present if particles are embedded
  StagedEngine* staged_ = nullptr;           ///< the engine if the run has stages, or null
  std::unique_ptr<EventEngine> engine_;
  Timer timer_;
  bool is_checked_ = false;  ///< the equilibrium at the start has been checked
  std::optional<std::vector<std::uint8_t>> missed_;
};

/// Ends a run if one of its stop rules is met after the last row.
/// \param stop  rules of the run or the present stage
/// \return whether the run has ended
bool stop_rule_met(PathState& path, const DamageOptions& options, const StopRules& stop);

/// Ends a run in which no element can fail any more. Pieces of a separated body that springs still
/// hold go on to the displacement of the stop rule.
/// \param now  present load factor
/// \return load factor of the row at this displacement, if there is one
std::optional<double> end_without_event(PathState& path, const Event& event, const LoadWork& work,
                                        const ReferenceLoad& load, const StopRules& stop,
                                        double now);

/// Writes the result of the present stage at its end.
void end_stage(PathState& path, const Network& network);

/// Makes a body begin with other active hosts, as an analysis that starts again after a missed
/// release.
/// \param whole  EventRun::missed_release()
void begin_with_hosts(LoadedNetwork& problem, const std::vector<std::uint8_t>& whole);

}  // namespace perilink

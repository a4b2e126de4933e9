#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/quasistatic/damage_options.hpp"
#include "analysis/quasistatic/events/staged_engine.hpp"
#include "analysis/quasistatic/host_release.hpp"
#include "analysis/quasistatic/path_energy.hpp"
#include "analysis/quasistatic/strain_watch.hpp"
#include "base/timer.hpp"

/// \file
/// Loop of the damage analysis. Control by events and by steps is in damage_analysis.cpp, control
/// by stages in staged_run.cpp.

namespace perilink {

/// Gives observers the equilibrium of the engine.
class EngineState final : public StateSource {
 public:
  EngineState(const Network& network, EventEngine& engine) : network_(network), engine_(engine) {}
  StepState state() override {
    return {network_, engine_.secants(), engine_.displacement(),
            elements != nullptr ? elements->whole() : std::span<const std::uint8_t>()};
  }
  Secants secants() override { return engine_.secants(); }
  const HostRelease* elements = nullptr;  ///< hosts of embedded particles, or null

 private:
  const Network& network_;
  EventEngine& engine_;
};

/// A damage analysis in progress: engine, path energies, present row and result.
class EventRun {
 public:
  EventRun(const LoadedNetwork& problem, const DamageOptions& options, StepObserver& observer);
  EventRun(const EventRun&) = delete;

  /// Runs the analysis to its end.
  /// \throws MissedRelease if DamageOptions::begins_again and a host release was missed
  DamageResult go();
  /// Checks the equilibrium of the initial body.
  /// \throws SolverError if there is none
  void require_equilibrium() { check(); }

 private:
  std::unique_ptr<EventEngine> make_engine();
  LoadWork begin_work();
  DamageResult by_events();
  DamageResult by_steps();
  DamageResult end_within_step(const Event& event);
  // Control by stages: staged_run.cpp.
  DamageResult by_stages();
  void begin_stage(std::size_t number);
  void end_stage();
  std::optional<double> end_of(const StageRules& stage, const LoadWork& work) const;
  bool follow_stage(const StageRules& stage);
  void measure_permanent(const LoadWork& work);
  void record(double load_factor, const LoadWork& work, const Event& event);
  void note_peaks();
  void take_note_of(const Balance& balance);
  void check() { take_note_of(engine_->check_equilibrium()); }
  void look_after(const EventOutcome& outcome);
  void follow_motion();
  void adopt(const Unknowns& unknowns);
  // Host releases: releasing_run.cpp.
  bool converts(const Event& event, double sense = 1.0,
                double most = std::numeric_limits<double>::infinity());
  void take_over(const Unknowns& unknowns, double load_factor);
  void note_missed_releases(const Event& event, double sense);
  bool residual_may_be_large() const;
  bool is_beyond_small_strains(double load_factor);
  void note_overload(double load_factor);
  bool leaves_small_strains(const Event& event);
  int check_interval() const;
  bool meets_tolerance() const { return row_.residual <= options_.engine.residual_tolerance; }
  void record_separated(double load_factor, const LoadWork& work);
  bool pass(const Event& event);
  bool stop_rule_met();
  void end(Termination termination, std::string reason) {
    result_.termination = termination;
    result_.reason = std::move(reason);
  }
  DamageResult finish();

  const Network& network_;
  const ReferenceLoad* reference_;  ///< reference load of the present stage or run
  const DamageOptions& options_;
  const StopRules* stop_;  ///< stop rules of the present stage or run
  StepObserver& observer_;
  const LoadedNetwork& problem_;
  StagedEngine* staged_ = nullptr;  ///< the engine if the run has stages, or null
  std::unique_ptr<EventEngine> engine_;
  EngineState state_;
  std::optional<HostRelease> host_release_;  ///< present if particles are embedded
  /// Bonds that host releases freed since the last event, with the load factor of each release.
  std::vector<std::pair<std::vector<Index>, double>> freed_;
  PathEnergy energy_;
  PathEnergy following_;  ///< within a load step: energies of a load that follows the events
  StrainWatch strains_;
  Timer timer_;
  double compliance_ = 0.0;          ///< f'u - R'd at load factor 1 [force length]
  double checked_compliance_ = 0.0;  ///< compliance_ at the last full residual check
  double stored_by_elements_ = std::numeric_limits<double>::quiet_NaN();
  Beside stored_by_permanent_;  ///< contribution of permanent loads to the stored energy
  double most_work_ = 0.0;      ///< largest work or energy so far, for stages [force length]
  int events_ = 0;
  int looks_ = 0;       ///< scheduled residual checks so far
  int rows_below_ = 0;  ///< successive rows below the load fraction of the stop rule
  Index broken_bonds_ = 0;
  Index yield_events_ = 0;
  StepRecord row_;
  std::vector<StepRecord> rows_;  ///< rows of the present load case; empty under control by steps
  DamageResult result_;
};

}  // namespace perilink

#pragma once

#include <limits>
#include <vector>

#include "analysis/quasistatic/events/crossing_search.hpp"
#include "analysis/quasistatic/events/single_event_engine.hpp"

namespace perilink {

/// One event at a time under loads that grow beside constant ones: each set of loads of a problem
/// has a load factor of its own, and one set grows at a time. `displacement()` is that of all loads
/// at the present load factor.
class StagedEngine final : public SingleEventEngine {
 public:
  StagedEngine(const LoadedNetwork& problem, const EngineOptions& options);

  /// A set of loads grows from its present load factor, 0 at first; the others stay as they are.
  /// What the set drives is gripped where it is.
  void begin_stage(std::size_t set);

  /// That of the loads that grow.
  double load_factor() const { return load_factor_; }
  void move_to(double load_factor);

  /// At the largest load factor at which every element is within its limit. Where there is none the
  /// worst element fails at the present one. Without an element nothing can fail.
  Event next_event() override;

  /// On the way to a load factor: the worst element that is beyond its limit at the present one,
  /// else the first that reaches it. Without an element none does.
  Event next_event_towards(double target);

  EventOutcome apply(const Event& event) override;
  std::span<const double> displacement() override;
  LoadWork load_work() override;
  Balance check_equilibrium() override;
  Balance glance_at_equilibrium() override { return check_equilibrium(); }
  /// \throws SolverError: stages know their own unknowns only
  double change_motion(const Unknowns& unknowns) override;

 private:
  BreakSearch::Hit worst();
  Event side_change_within(double distance) const;

  const LoadedNetwork& problem_;
  CrossingSearch crossings_;
  void grip(std::size_t set);

  Unknowns unknowns_;                 ///< with the motions of the set that grows
  std::vector<double> gripped_at_;    ///< displacements at which slots were gripped, shape of these
  std::vector<double> load_factors_;  ///< per set, where it does not grow
  std::size_t set_ = 0;
  std::size_t newest_ = 0;  ///< last one of the sets that have grown
  double load_factor_ = 0.0;
  std::vector<double> now_;  ///< displacements at the present load factor
};

}  // namespace perilink

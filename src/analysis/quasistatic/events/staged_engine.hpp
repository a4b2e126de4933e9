#pragma once

#include <limits>
#include <map>
#include <vector>

#include "analysis/quasistatic/events/crossing_search.hpp"
#include "analysis/quasistatic/events/single_event_engine.hpp"

namespace perilink {

/// One event at a time under loads that grow beside constant ones: each set of loads of a problem
/// has a load factor of its own, and one set grows at a time. `displacement()` is that of all loads
/// at the present load factor.
class StagedEngine final : public SingleEventEngine {
 public:
  StagedEngine(const LoadedNetwork& problem, const EquilibriumOptions& options);

  /// A set of loads grows from its present load factor, 0 at first; the others stay as they are.
  /// What the set drives is gripped where it is.
  /// \param held  how particles move from the first stage of the set on, used if it is_new()
  void begin_stage(std::size_t set, const Unknowns& held);

  /// Before begin_stage(): bars that have flowed unload elastically from there on, as they are.
  /// The equilibrium stays.
  /// \return whether some have
  bool leave_flow();

  /// Whether a set has not grown yet, and neither has any after it.
  bool is_new(std::size_t set) const { return set > newest_; }

  /// Before the first event: damaged bonds take the sides that the loads will give them.
  /// \param direction  in which the load factor moves first
  EventOutcome open_for(double direction) { return equilibrium_.pass_side_change(direction); }

  /// That of the loads that grow.
  double load_factor() const { return load_factor_; }
  void move_to(double load_factor);

  /// At the largest load factor at which every element is within its limit. Where there is none the
  /// worst element fails at the present one. Without an element nothing can fail.
  Event next_event_below(double most) override;

  /// On the way to a load factor: the worst element that is beyond its limit at the present one,
  /// else the first that reaches it. Without an element none does.
  Event next_event_towards(double target);

  EventOutcome apply(const Event& event) override;
  std::span<const double> displacement() override;
  LoadWork load_work() override;
  Balance check_equilibrium() override;
  Balance check_cheaply() override { return check_equilibrium(); }
  Freedom change_motion(const Unknowns& unknowns) override;
  void set_release_threshold(std::span<const Index> elements, double fraction) override;
  /// Constant loads change all displacements.

 private:
  std::vector<BreakSearch::Hit> near_hits(const Event& event, double fraction) override;
  BreakSearch::Hit worst();
  std::span<const double> displacement_at(double load_factor);
  Event side_change_within(double distance);
  bool is_last_change(double load_factor) const;
  bool turns_back(const Event& change);
  /// Limits of the search for crossings, beyond which the elements that fail first have to be.
  double limit_of_crossings(Index element) const {
    return (fails_with_others(element) ? 1.0 + 0.5 * tolerance_ : 1.0) * limit_of(element);
  }
  Event with_others(Event event);
  void count_changes();

  const LoadedNetwork& problem_;
  CrossingSearch crossings_;
  ThreadChoice last_crossing_threads_, next_crossing_threads_;
  void clamped(std::size_t set, const Unknowns& held);
  void harden(Index segment);

  std::unique_ptr<Unknowns> unknowns_;  ///< with the motions of the set that grows
  std::vector<double> gripped_at_;  ///< displacements at which slots were gripped, shape of these
  std::vector<double> flowed_;      ///< by which flow has moved slots, shape of these; empty: none
  std::map<Index, double> flow_;    ///< per segment: sum of the sizes of its plastic strains [-]
  std::vector<double> load_factors_;  ///< per set, where it does not grow
  std::size_t set_ = 0;
  std::size_t newest_ = 0;  ///< last one of the sets that have grown
  double load_factor_ = 0.0;
  double direction_ = 0.0;        ///< in which it moves when damaged bonds close or open next
  double largest_factor_ = 0.0;   ///< largest |load factor| of this stage
  double changed_at_ = 0.0;       ///< load factor at which they did last, ...
  double changed_towards_ = 0.0;  ///< ... in which direction ...
  int changes_there_ = 0;    ///< ... and how often one after the other; 0: something failed since
  std::vector<double> now_;  ///< displacements at the load factor asked for last
};

}  // namespace perilink

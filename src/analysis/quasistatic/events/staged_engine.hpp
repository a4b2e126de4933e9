#pragma once

#include <limits>
#include <map>
#include <vector>

#include "analysis/quasistatic/events/crossing_search.hpp"
#include "analysis/quasistatic/events/single_event_engine.hpp"

namespace perilink {

/// Engine for one event at a time under constant and growing loads. Each load case has its own load
/// factor, and one load case grows at a time. `displacement()` is under all loads at the present
/// load factors.
class StagedEngine final : public SingleEventEngine {
 public:
  StagedEngine(const LoadedNetwork& problem, const EquilibriumOptions& options);

  /// Starts a stage: a load case grows from its present load factor, 0 at first, and the others
  /// stay constant. Particles that it moves are clamped at their present positions.
  /// \param held  motion of the particles from the load case's first stage on, used if is_new()
  void begin_stage(std::size_t set, const Unknowns& held);

  /// Makes bars that have flowed unload elastically from their present strain. Precedes
  /// begin_stage(). The equilibrium stays.
  /// \return whether bars have flowed
  bool leave_flow();

  /// Returns whether neither this load case nor a later one has grown yet.
  bool is_new(std::size_t set) const { return set > newest_; }

  /// Sets the contact states of damaged bonds for the first loads. Precedes the first event.
  /// \param direction  1 if the load factor grows first, -1 if it falls
  EventOutcome open_for(double direction) { return equilibrium_.pass_side_change(direction); }

  /// Returns the load factor of the growing load case.
  double load_factor() const { return load_factor_; }
  void move_to(double load_factor);

  /// Finds the event at the largest load factor at which every element is within its limit. If
  /// there is none, the worst element fails at the present load factor. The event has no element if
  /// no element can fail.
  Event next_event_below(double most) override;

  /// Finds the next event on the way to a load factor. It is the worst element beyond its limit at
  /// the present load factor, else the first that reaches its limit. The event has no element if
  /// there is none.
  Event next_event_towards(double target);

  EventOutcome apply(const Event& event) override;
  std::span<const double> displacement() override;
  LoadWork load_work() override;
  Balance check_equilibrium() override;
  Balance check_cheaply() override { return check_equilibrium(); }
  Freedom change_motion(const Unknowns& unknowns) override;
  void set_release_threshold(std::span<const Index> elements, double fraction) override;

 private:
  std::vector<BreakSearch::Hit> near_hits(const Event& event, double fraction) override;
  BreakSearch::Hit worst();
  std::span<const double> displacement_at(double load_factor);
  Event side_change_within(double distance);
  bool is_last_change(double load_factor) const;
  bool turns_back(const Event& change);
  /// Returns the limit in the search for crossings. Elements that may fail with others exceed their
  /// own limits by half of the tolerance first.
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

  std::unique_ptr<Unknowns> unknowns_;  ///< with the motions of the growing load case
  /// Displacements at which slots were clamped, shape (particles, width).
  std::vector<double> gripped_at_;
  /// Motion of slots by plastic flow, shape (particles, width); empty: none.
  std::vector<double> flowed_;
  std::map<Index, double> flow_;      ///< per bar element: sum of the absolute plastic strains [-]
  std::vector<double> load_factors_;  ///< per load case, while it does not grow
  std::size_t set_ = 0;
  std::size_t newest_ = 0;  ///< last load case that has grown
  double load_factor_ = 0.0;
  double direction_ = 0.0;        ///< sign of the load change towards the next contact state change
  double largest_factor_ = 0.0;   ///< largest |load factor| of this stage
  double changed_at_ = 0.0;       ///< load factor of the last contact state change
  double changed_towards_ = 0.0;  ///< direction of the last contact state change
  /// Successive contact state changes at changed_at_; 0: an element has failed since.
  int changes_there_ = 0;
  std::vector<double> now_;  ///< displacements at the load factor of the last query
};

}  // namespace perilink

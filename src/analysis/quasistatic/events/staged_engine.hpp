#pragma once

#include <limits>
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
  /// Goes on from a saved state.
  /// \param held  motion of the particles in that state
  StagedEngine(const LoadedNetwork& problem, const EquilibriumOptions& options,
               const Unknowns& held, const BodyState& saved);

  /// Starts a stage: a load case grows from its present load factor, 0 at first, and the others
  /// stay constant. Particles that it moves are clamped at their present positions.
  /// \param held  motion of the particles from the load case's first stage on, used if is_new()
  void begin_stage(std::size_t set, const Unknowns& held);

  /// Makes bars that have flowed unload elastically from their present strain. Precedes
  /// begin_stage(). The equilibrium stays.
  /// \return whether bars have flowed
  bool leave_flow();

  /// Returns whether neither this load case nor a later one has grown yet.
  bool is_new(std::size_t set) const { return set > loads_.newest; }

  /// Sets the contact states of damaged bonds for the first loads. Precedes the first event.
  /// \param direction  1 if the load factor grows first, -1 if it falls
  EventOutcome open_for(double direction) { return equilibrium_.pass_side_change(direction); }

  /// Returns the load factor of the growing load case.
  double load_factor() const { return loads_.load_factor; }
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
  std::span<const double> displacement(std::span<const double> earlier = {},
                                       Secants secants = {}) override;
  Freedom change_motion(const Unknowns& unknowns) override;
  void set_release_threshold(std::span<const Index> elements, double fraction) override;
  BodyState state() const override { return {equilibrium_.state(), progress_, loads_}; }

 private:
  std::vector<BreakSearch::Hit> near_hits(const Event& event, double fraction) override;
  BreakSearch::Hit worst();
  std::span<const double> displacement_at(double load_factor);
  Event side_change_within(double distance);
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
  void set_crossing_limits();
  void clamped(std::size_t set, const Unknowns& held);
  void apply_loads();
  void harden(Index segment);

  std::unique_ptr<Unknowns> unknowns_;  ///< with the motions of the growing load case
  LoadState loads_;
  std::vector<double> now_;  ///< displacements at the load factor of the last query
};

}  // namespace perilink

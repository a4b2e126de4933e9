#pragma once

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "analysis/quasistatic/equilibrium/equilibrium.hpp"
#include "analysis/quasistatic/events/body_state.hpp"
#include "base/types.hpp"

namespace perilink {

/// The next event under a growing load.
struct Event {
  Index element = no_index;        ///< breaks or yields; no_index: there are no more events
  double load_factor = 0.0;        ///< load factor of the event
  bool at_constant_load = false;   ///< the element is beyond its limit at a constant load
  bool changes_side = false;       ///< a damaged bond closes or opens, and no element fails
  std::vector<Index> others = {};  ///< elements that fail with it, within the event tolerance
  /// There is no element: pieces of a damaged body move, and strain none of its elements.
  bool no_strain = false;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(element, load_factor, at_constant_load, changes_side, others);
  }
};

/// Moves a network from event to event at unit load factor. The damage analysis uses the solver
/// through this interface only, so that engines can be exchanged.
class EventEngine {
 public:
  virtual ~EventEngine() = default;

  /// Finds the element that reaches its limit first as the load grows from zero. Among load factors
  /// within `tie_tolerance` the lowest element wins, so that round-off and threads do not decide.
  /// With an event tolerance, the load factor is the middle of the range of all elements that
  /// fail together.
  /// \param most  load factor of a step: elements that reach their limits above it do not fail with
  ///              it
  virtual Event next_event_below(double most) = 0;
  Event next_event() { return next_event_below(std::numeric_limits<double>::infinity()); }

  /// Weakens the elements of the event: they break, or take the next secants of their laws.
  virtual EventOutcome apply(const Event& event) = 0;

  /// Returns the displacements of all particles in equilibrium at load factor 1, shape (particles,
  /// width). They include rotations and prescribed displacements.
  /// \param earlier  displacements of an earlier state that were current wherever an element can
  ///                 fail: these, current everywhere; not in runs by stages. Empty: the present
  ///                 state
  /// \param secants  of the earlier state
  virtual std::span<const double> displacement(std::span<const double> earlier = {},
                                               Secants secants = {}) = 0;

  /// Returns displacements that are current wherever an element can fail, without a solve.
  virtual std::span<const double> where_elements_fail() = 0;

  virtual LoadWork load_work() = 0;

  /// Returns the present stiffness of every element over its intact stiffness.
  virtual Secants secants() const = 0;

  /// See Equilibrium::check() and Equilibrium::check_cheaply().
  virtual Balance check_equilibrium() = 0;
  virtual Balance check_cheaply() = 0;

  /// See Equilibrium::change_motion().
  virtual Freedom change_motion(const Unknowns& unknowns) = 0;

  /// Moves the next events of elements to this fraction of their limits.
  virtual void set_release_threshold(std::span<const Index> elements, double fraction) = 0;

  /// Returns the elements whose ratio at the load factor of the event is at least `fraction`,
  /// ascending.
  virtual std::vector<Index> near_events(const Event& event, double fraction) = 0;

  virtual FactorStatistics factor_statistics() const = 0;

  /// Returns what an engine needs to go on from here. It makes a new factor, so that results
  /// differ by round-off from those of this engine.
  virtual BodyState state() const = 0;
};

/// Relative difference within which load factors count as equal.
inline constexpr double tie_tolerance = 1e-10;

/// Makes the engine of a run without stages.
/// \throws SolverError if the stiffness matrix is not positive definite
std::unique_ptr<EventEngine> make_event_engine(const LoadedNetwork& problem,
                                               const EquilibriumOptions& options);

}  // namespace perilink

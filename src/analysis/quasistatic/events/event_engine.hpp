#pragma once

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "analysis/quasistatic/equilibrium/equilibrium.hpp"
#include "base/types.hpp"

namespace perilink {

/// The next thing that happens under a growing load.
struct Event {
  Index element = no_index;       ///< it breaks or yields; no_index: nothing can break any more
  double load_factor = 0.0;       ///< when it happens
  bool at_constant_load = false;  ///< the element is beyond its limit, at a load that does not move
  bool changes_side = false;      ///< a damaged bond closes or opens, and nothing fails
  std::vector<Index> others = {};  ///< elements that fail with it, within the tolerance of events
};

/// Moves a network from event to event at unit load factor. The damage analysis sees no more of the
/// solver than this, so that a faster engine can take this one's place.
class EventEngine {
 public:
  virtual ~EventEngine() = default;

  /// The element that reaches its limit first as the load grows from zero. Ties within
  /// `tie_tolerance` of the load factor go to the element with the lowest number, so that no route
  /// and no number of threads decides by round-off. Under an event tolerance the load factor is the
  /// middle of those of all that fail together.
  /// \param most  load factor of a step: all that reach their limits below it fail together
  virtual Event next_event_below(double most) = 0;
  Event next_event() { return next_event_below(std::numeric_limits<double>::infinity()); }

  /// Lets the elements pass their limits: broken, or on the next secants of their laws.
  virtual EventOutcome apply(const Event& event) = 0;

  /// Displacement of all particles at load factor 1, rotations included; shape (particles,
  /// width), prescribed ones and all: equilibrium of the network as it stands.
  virtual std::span<const double> displacement() = 0;

  /// Those that are right wherever an element can fail, and cost no solution.
  virtual std::span<const double> where_elements_fail() = 0;

  virtual LoadWork load_work() = 0;

  /// Present stiffness of every element as a fraction of the intact one.
  virtual Secants secants() const = 0;

  /// Equilibrium::check() and Equilibrium::glance().
  virtual Balance check_equilibrium() = 0;
  virtual Balance check_cheaply() = 0;

  /// Equilibrium::change_motion().
  virtual Freedom change_motion(const Unknowns& unknowns) = 0;

  /// From now on the elements have their next event at this fraction of its limit.
  virtual void set_release_threshold(std::span<const Index> elements, double fraction) = 0;

  /// Elements that are within this fraction of their next event as the element of an event is at
  /// its load factor, ascending.
  virtual std::vector<Index> near_events(const Event& event, double fraction) = 0;

  /// Numerical factorisations so far.
  virtual int factorizations() const = 0;

  virtual FactorStatistics factor_statistics() const = 0;
};

/// Relative width within which load factors count as equal.
inline constexpr double tie_tolerance = 1e-10;

/// \throws SolverError when the stiffness matrix is not positive definite
std::unique_ptr<EventEngine> make_event_engine(const LoadedNetwork& problem,
                                               const EquilibriumOptions& options);

}  // namespace perilink

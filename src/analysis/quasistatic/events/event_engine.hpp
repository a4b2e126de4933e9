#pragma once

#include <memory>
#include <span>

#include "base/types.hpp"
#include "network/loaded_network.hpp"
#include "network/network.hpp"
#include "solver/factor_routes.hpp"

namespace perilink {

/// The next thing that happens under a growing load.
struct Event {
  Index element = no_index;  ///< it breaks or yields; no_index: nothing can break any more
  double load_factor = 0.0;  ///< when it happens
};

/// What became of an event.
struct EventOutcome {
  bool mechanism = false;  ///< the element held the last load path, weak elastic supports not
                           ///< counted: nothing was changed
  double secant = 0.0;     ///< with it the element goes on, over its intact stiffness; 0: it broke
  bool broke() const { return secant == 0.0; }
  /// 1 - x' K^-1 x, of a micropolar bond the smallest of its modes; 0: cannot be told from zero
  double pivot = 1.0;
  /// Growth of f'u - R'd at load factor 1: k e^2 / pivot [force length]. The event dissipates
  /// lambda_k lambda_(k+1) / 2 times this along the path drawn through the events.
  double compliance_growth = 0.0;
  double released = 0.0;  ///< energy that left the element, at load factor 1 [force length]
};

/// Work products at load factor 1 [force length].
struct LoadWork {
  double forces = 0.0;    ///< f'u: applied forces on their displacements
  double supports = 0.0;  ///< R'd: reactions of driven particles on their displacements
  /// The body no longer resists what drives it: nothing does, and both are zero, or nothing but
  /// elastic supports that are weak beside what it was.
  bool separated = false;
};

/// Figures that need a pass over all elements.
struct Equilibrium {
  double residual = 0.0;       ///< |f - K u| / |f|
  double stored_energy = 0.0;  ///< sum over elements of k e^2 / 2 at load factor 1 [force length]
};

/// Moves a network from event to event at unit load factor. The damage analysis sees no more of the
/// solver than this, so that a faster engine can take this one's place.
class EventEngine {
 public:
  virtual ~EventEngine() = default;

  /// The element that reaches its limit first as the load grows from zero. Ties within
  /// `tie_tolerance` of the load factor go to the element with the lowest number, so that no route
  /// and no number of threads decides by round-off.
  virtual Event next_event() = 0;

  /// Lets the element pass its limit: broken, or on the next secant of its law.
  virtual EventOutcome apply(const Event& event) = 0;

  /// Displacement of all particles at load factor 1, rotations included; shape (particles,
  /// width), prescribed ones and all: equilibrium of the network as it stands.
  virtual std::span<const double> displacement() = 0;

  virtual LoadWork load_work() = 0;

  /// Present stiffness of every element as a fraction of the intact one.
  virtual std::span<const double> secants() const = 0;

  /// Measures the residual; above the tolerance refines the displacement once, then factorises
  /// anew.
  virtual Equilibrium check_equilibrium() = 0;

  /// Numerical factorisations so far.
  virtual int factorizations() const = 0;

  virtual FactorStatistics factor_statistics() const = 0;
};

/// Relative width within which load factors count as equal.
inline constexpr double tie_tolerance = 1e-10;

/// Pivots below this are computed again from energies: a body that is slender or about to separate
/// has a condition number that takes most digits of what the factor says.
inline constexpr double doubtful_pivot = 1e-2;

/// What an engine needs to know.
struct EngineOptions {
  FactorRoute route = FactorRoute::in_place;
  double residual_tolerance = 1e-10;
  int threads = 1;
};

/// One factor, one event at a time.
/// \throws SolverError when the stiffness matrix is not positive definite
std::unique_ptr<EventEngine> make_event_engine(const LoadedNetwork& problem,
                                               const EngineOptions& options);

}  // namespace perilink

#pragma once

#include <memory>
#include <span>

#include "assembly/network.hpp"
#include "assembly/unknowns.hpp"
#include "base/types.hpp"
#include "solver/factor.hpp"

namespace perilink {

/// The next thing that happens under a growing load.
struct Event {
  Index element = no_index;  ///< that breaks or yields; no_index: nothing can break any more
  double load_factor = 0.0;  ///< at which it happens
};

/// What became of an event.
struct EventOutcome {
  bool mechanism = false;  ///< the element held the last load path: nothing was changed
  double pivot = 1.0;      ///< 1 - x' K^-1 x
  /// Energy that the event takes, per lambda_k lambda_(k+1) / 2: x'u squared over the pivot at unit
  /// load, the growth of the compliance [force length]
  double compliance_growth = 0.0;
  double released = 0.0;   ///< energy that left the element, at unit load factor [force length]
};

/// Equilibrium figures that need a pass over all elements.
struct Equilibrium {
  double residual = 0.0;       ///< |f - K u| / |f|
  double stored_energy = 0.0;  ///< sum over elements of k e^2 / 2 at unit load [force length]
};

/// Moves a network from event to event at unit load factor. The damage analysis sees no more of the
/// solver than this, so that a faster engine can take this one's place.
class EventEngine {
 public:
  virtual ~EventEngine() = default;

  /// The element that reaches its limit first as the load grows from zero. Ties within 1e-10 of the
  /// load factor go to the element with the lowest number, so that no route depends on round-off.
  virtual Event next_event() = 0;

  /// Lets the element pass its limit: broken, or on the next secant of its law.
  virtual EventOutcome apply(const Event& event) = 0;

  /// Displacement of all particles at load factor 1, shape (particles, dim), prescribed ones and
  /// all; exact equilibrium of the network as it stands.
  virtual std::span<const double> displacement() = 0;

  /// Work-conjugate compliance sum at load factor 1: f'u - R'd (R reactions at driven particles with
  /// displacement d) [force length]
  virtual double compliance() = 0;

  /// Present stiffness of every element as a fraction of the intact one.
  virtual std::span<const double> secants() const = 0;

  virtual Equilibrium check_equilibrium() = 0;

  virtual FactorStatistics factor_statistics() const = 0;
};

}  // namespace perilink

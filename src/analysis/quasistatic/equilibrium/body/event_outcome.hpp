#pragma once

#include <algorithm>

#include "analysis/quasistatic/equilibrium/body/constant_work.hpp"
#include "base/types.hpp"

/// \file
/// Outcomes of events, and energy figures of an equilibrium.

namespace perilink {

/// Outcome of an event in which an element loses stiffness.
struct EventOutcome {
  /// The element held the last load path, except for weak elastic supports; the body is unchanged.
  bool mechanism = false;
  double secant = 0.0;  ///< new stiffness of the element over its intact stiffness; 0: it broke
  bool broke() const { return secant == 0.0; }
  /// Downdate pivot 1 - x' K^-1 x, for a micropolar bond the smallest of its vectors; 0: not
  /// distinguishable from zero.
  double pivot = 1.0;
  /// Growth of f'u - R'd at load factor 1: k e^2 / pivot [force length]. The event dissipates
  /// lambda_k lambda_(k+1) / 2 times this along the path through the events.
  double compliance_growth = 0.0;
  double released = 0.0;  ///< energy that left the element, at load factor 1 [force length]
  /// Set by the engine: number of elements that broke, and that took a smaller secant.
  Index broken = 0, yielded = 0;
  Index exhausted = no_index;   ///< set by the engine: an element without further limits
  Index separating = no_index;  ///< set by the engine: the element that forms a mechanism
  Beside permanent_growth = {}, released_by_permanent = {};  ///< contribution of permanent loads

  /// Adds the outcome of a later element.
  void add(const EventOutcome& next) {
    mechanism = next.mechanism;
    secant = next.secant;
    pivot = std::min(pivot, next.pivot);
    broken += next.broken;
    yielded += next.yielded;
    if (next.exhausted != no_index) exhausted = next.exhausted;
    if (mechanism) {
      separating = next.separating;
      pivot = next.pivot;
    }
    if (mechanism) return;
    compliance_growth += next.compliance_growth;
    released += next.released;
    permanent_growth += next.permanent_growth;
    released_by_permanent += next.released_by_permanent;
  }
};

/// Growth of the compliance by one event that means separation. Bonds that are parallel up to
/// round-off or the last digits of a mesh cause less.
inline constexpr double next_to_infinite = 1e12;

/// Work products at load factor 1 [force length].
struct LoadWork {
  double forces = 0.0;    ///< f'u: applied forces times displacements
  double supports = 0.0;  ///< R'd: reactions times prescribed displacements
  /// The body no longer resists the prescribed displacements. Both products are
  /// then zero, or the resistance is negligible compared with the former one.
  bool separated = false;
  ConstantWork constant = {};  ///< contribution of permanent loads
  double compliance() const { return forces - supports; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(forces, supports, separated, constant);
  }
};

/// Growth of the compliance f'u - R'd without an event, at load factor 1 [force length].
struct Freedom {
  double growth = 0.0;
  Beside beside = {};  ///< contribution of permanent loads

  template <class Archive>
  void serialize(Archive& archive) {
    archive(growth, beside);
  }
};

/// Result of a residual check.
struct Balance {
  double residual = 0.0;       ///< |f - K u| / |f|
  double stored_energy = 0.0;  ///< sum over elements of k e^2 / 2 at load factor 1 [force length]
  Beside stored_by_permanent = {};  ///< contribution of permanent loads
};

}  // namespace perilink

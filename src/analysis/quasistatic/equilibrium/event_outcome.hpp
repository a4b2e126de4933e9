#pragma once

#include <algorithm>

#include "analysis/quasistatic/equilibrium/constant_field.hpp"
#include "base/types.hpp"

/// \file
/// What events do to an equilibrium, and figures of it.

namespace perilink {

/// What became of an element that lost stiffness.
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
  double released = 0.0;      ///< energy that left the element, at load factor 1 [force length]
  bool changed_side = false;  ///< a damaged bond closed or opened
  /// Set by the engine: elements that broke, and that went on with a smaller secant.
  Index broken = 0, yielded = 0;
  Index exhausted = no_index;   ///< set by the engine: an element that no longer limits anything
  Index separating = no_index;  ///< set by the engine: the element of the mechanism
  Beside permanent_growth = {}, released_by_permanent = {};  ///< what constant loads add to both

  /// What became of another element after this one.
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

/// A body that has become as many times as compliant by one event lies in two. Bonds that are
/// parallel but for the last digits of a mesh, or of round-off, leave less.
inline constexpr double next_to_infinite = 1e12;

/// Work products at load factor 1 [force length].
struct LoadWork {
  double forces = 0.0;    ///< f'u: applied forces on their displacements
  double supports = 0.0;  ///< R'd: reactions of driven particles on their displacements
  /// The body no longer resists what drives it: nothing does, and both are zero, or what does is
  /// next to nothing beside what it was.
  bool separated = false;
  ConstantWork constant = {};  ///< what constant loads add
  double compliance() const { return forces - supports; }
};

/// Growth of the compliance f'u - R'd without an event, at load factor 1 [force length].
struct Freedom {
  double growth = 0.0;
  Beside beside = {};  ///< what constant loads add
};

/// Figures that need a pass over the elements.
struct Balance {
  double residual = 0.0;       ///< |f - K u| / |f|
  double stored_energy = 0.0;  ///< sum over elements of k e^2 / 2 at load factor 1 [force length]
  Beside stored_by_permanent = {};  ///< what constant loads add
};

}  // namespace perilink

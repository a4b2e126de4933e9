#pragma once

#include <span>

#include "network/secants.hpp"

namespace perilink {

/// The present state of a model, as gauges and reactions look at it.
struct ModelState {
  Secants secants;                 ///< one per element; empty: all are intact
  std::span<const double> motion;  ///< over `scale`, shape (particles, width)
  double scale = 1.0;
  double load_factor = 1.0;  ///< factor on the loads
  /// With stages those on LoadedNetwork::sets, in place of it; else empty.
  std::span<const double> set_factors = {};
  /// Forces that hold the particles so, where they are known (InternalForce::forces); else empty.
  std::span<const double> internal = {};
  /// Stresses at the particles, where they are known, shape (particles, 6); else empty.
  std::span<const double> stresses = {};
};

}  // namespace perilink

#pragma once

#include <cstdint>
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
  /// Per finite element, whether it constrains its particles; empty: as in LoadedNetwork::carried.
  std::span<const std::uint8_t> whole = {};
};

}  // namespace perilink

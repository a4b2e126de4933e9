#pragma once

#include <cstdint>
#include <span>

#include "network/secants.hpp"

namespace perilink {

/// Current state of a model, for gauges and reactions.
struct ModelState {
  Secants secants;                 ///< one per element; empty: all are intact
  std::span<const double> motion;  ///< over `scale`, shape (particles, width)
  double scale = 1.0;
  double load_factor = 1.0;  ///< factor on the loads
  /// With stages, factors on LoadedNetwork::sets instead of `load_factor`; else empty.
  std::span<const double> set_factors = {};
  /// Internal forces where they are known (InternalForce::forces); else empty.
  std::span<const double> internal = {};
  /// Per finite element, whether it constrains its particles; empty: as in LoadedNetwork::carried.
  std::span<const std::uint8_t> whole = {};
};

}  // namespace perilink

#pragma once

#include <cstdint>
#include <vector>

#include "analysis/quasistatic/equilibrium/removal.hpp"

namespace perilink {

/// An element that takes a smaller secant.
struct Weakening {
  Index element;
  double secant;  ///< 0: it breaks
};

/// Elements weakened at once, and the body before. Vectors have one entry per element, solutions
/// one per unknown.
struct EventBatch {
  std::vector<Removal> removals;
  std::vector<Removal::Deformations> before;  ///< by growing loads
  std::vector<Removal::Deformations> beside;  ///< x'u by constant loads
  std::vector<std::uint8_t> was_first;        ///< the element was intact
  std::vector<std::uint8_t> breaks;
  std::vector<double> secants;
  std::vector<double> solution, constant_solution;
  bool tells_pivots = false;  ///< the factor has reported the smallest pivot
  bool keeps_factor = false;  ///< the factor is unchanged
  bool lagged = false;        ///< the factor belonged to an even earlier body
  double force_work = 0.0;    ///< f'u before the batch
};

}  // namespace perilink

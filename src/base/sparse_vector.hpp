#pragma once

#include <array>

#include "base/types.hpp"

namespace perilink {

/// The few entries of the vector x of a rank-one change K -+ x x', each row once, in any order.
struct SparseVector {
  static constexpr int capacity = 12;
  int size = 0;
  std::array<Index, capacity> rows;
  std::array<double, capacity> values;
};

}  // namespace perilink

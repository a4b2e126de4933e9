#pragma once

#include <algorithm>
#include <vector>

#include "base/types.hpp"

namespace perilink {

/// Nonzero entries of the vector x of a rank-one change K -+ x x', each row once, in any order.
struct SparseVector {
  std::vector<Index> rows;
  std::vector<double> values;

  bool operator==(const SparseVector&) const = default;
  int size() const { return static_cast<int>(rows.size()); }

  /// Adds to the entry of a row; creates the entry if it is missing.
  void add(Index row, double value) {
    const auto found = std::find(rows.begin(), rows.end(), row);
    if (found == rows.end()) {
      rows.push_back(row);
      values.push_back(value);
    } else {
      values[static_cast<std::size_t>(found - rows.begin())] += value;
    }
  }
};

}  // namespace perilink

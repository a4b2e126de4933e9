#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "base/sparse_vector.hpp"
#include "base/types.hpp"

namespace perilink {

/// What a few sparse vectors are combined to: bonds between particles that have many of them pull
/// at no more unknowns than these particles have.
class VectorSpan {
 public:
  /// A vector that was added, by its number, and how much of it.
  struct Part {
    Index number;
    double share;
  };

  void clear();
  /// Vectors that others make up but for round-off are not taken in.
  void add(const SparseVector& x, Index number);
  /// Which vectors make it up, to 1e-12 of its length; none where that would take vectors of more
  /// than some times its length, whose errors it would have.
  std::optional<std::vector<Part>> parts_of(const SparseVector& x) const;

 private:
  /// Coordinates along the directions, and the rest, by the rows.
  struct Split {
    std::vector<double> along, rest;
  };
  Split split(const SparseVector& x) const;

  std::unordered_map<Index, std::size_t> row_of_;  ///< where each unknown that they act on comes
  std::vector<Index> numbers_;
  std::vector<double> lengths_;                   ///< that the vectors have
  std::vector<std::vector<double>> directions_;   ///< orthonormal; rows behind the last are zero
  std::vector<std::vector<double>> coordinates_;  ///< one list for each vector, over its length
};

}  // namespace perilink

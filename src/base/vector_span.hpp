#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "base/sparse_vector.hpp"
#include "base/types.hpp"

namespace perilink {

/// Span of a few sparse vectors. Many bonds between few particles have linearly dependent vectors.
class VectorSpan {
 public:
  /// Number of an added vector and its coefficient.
  struct Part {
    Index number;
    double share;
  };

  void clear();
  /// Adds a vector unless it depends linearly on the others up to round-off.
  void add(const SparseVector& x, Index number);
  /// Returns coefficients of a linear combination that equals `x` to 1e-12 of its length. Empty if
  /// the vectors do not span `x`, or only by coefficients that are too large to be exact.
  std::optional<std::vector<Part>> parts_of(const SparseVector& x) const;

 private:
  /// Coordinates along the directions, and the remainder by rows.
  struct Split {
    std::vector<double> along, rest;
  };
  Split split(const SparseVector& x) const;

  std::unordered_map<Index, std::size_t> row_of_;  ///< position of each unknown with entries
  std::vector<Index> numbers_;
  std::vector<double> lengths_;                   ///< lengths of the vectors
  std::vector<std::vector<double>> directions_;   ///< orthonormal; rows beyond the last are zero
  std::vector<std::vector<double>> coordinates_;  ///< one list per vector, divided by its length
};

}  // namespace perilink

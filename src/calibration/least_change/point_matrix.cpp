#include "calibration/least_change/point_matrix.hpp"

#include <algorithm>

namespace perilink {

PointMatrix::PointMatrix(Index rows, Index points, Pairs pairs) : rows_(rows) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  offsets_.assign(static_cast<std::size_t>(points) + 1, 0);
  for (const auto& [point, later] : pairs) {
    ++offsets_[point + 1];
    later_.push_back(later);
  }
  for (Index p = 0; p < points; ++p) offsets_[p + 1] += offsets_[p];
  const Index size = points * rows;
  matrix_.resize(size, size);
  matrix_.resizeNonZeros(static_cast<Index>(later_.size()) * rows * rows +
                         points * rows * (rows + 1) / 2);
  Index next = 0;
  for (Index p = 0; p < points; ++p) {
    for (Index c = 0; c < rows; ++c) {
      matrix_.outerIndexPtr()[p * rows + c] = next;
      for (Index r = c; r < rows; ++r) matrix_.innerIndexPtr()[next++] = p * rows + r;
      for (Index k = offsets_[p]; k < offsets_[p + 1]; ++k) {
        for (Index r = 0; r < rows; ++r) matrix_.innerIndexPtr()[next++] = later_[k] * rows + r;
      }
    }
  }
  matrix_.outerIndexPtr()[size] = next;
}

bool PointMatrix::holds(Index points, const Pairs& pairs) const {
  if (static_cast<std::size_t>(points) + 1 != offsets_.size()) return false;
  return std::ranges::all_of(pairs, [&](const std::pair<Index, Index>& pair) {
    return std::binary_search(later_.begin() + offsets_[pair.first],
                              later_.begin() + offsets_[pair.first + 1], pair.second);
  });
}

double* PointMatrix::block(Index upper, Index lower, Index column) {
  double* begin = matrix_.valuePtr() + matrix_.outerIndexPtr()[upper * rows_ + column];
  if (upper == lower) return begin - column;
  const auto first = later_.begin() + offsets_[upper], last = later_.begin() + offsets_[upper + 1];
  return begin + rows_ - column + (std::lower_bound(first, last, lower) - first) * rows_;
}

void PointMatrix::set_zero() { std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0); }

std::vector<Index> PointMatrix::point_of_rows() const {
  std::vector<Index> points;
  for (Index k = 0; k < matrix_.cols(); ++k) points.push_back(k / rows_);
  return points;
}

}  // namespace perilink

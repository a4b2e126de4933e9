#include "calibration/bounded_least_squares/equations/point_matrix.hpp"

#include <algorithm>

namespace perilink {

PointMatrix::PointMatrix(std::vector<Index> first_row, Pairs pairs)
    : first_row_(std::move(first_row)) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  offsets_.assign(first_row_.size(), 0);
  for (const auto& [point, later] : pairs) {
    ++offsets_[point + 1];
    later_.push_back(later);
  }
  Index numbers = 0;
  for (Index p = 0; p < points(); ++p) {
    offsets_[p + 1] += offsets_[p];
    Index behind = 0;
    for (Index k = offsets_[p]; k < offsets_[p + 1]; ++k) {
      below_.push_back(behind);
      behind += rows(later_[k]);
    }
    numbers += rows(p) * (rows(p) + 1) / 2 + rows(p) * behind;
  }
  matrix_.resize(first_row_.back(), first_row_.back());
  matrix_.resizeNonZeros(numbers);
  Index next = 0;
  for (Index p = 0; p < points(); ++p) {
    for (Index c = first_row_[p]; c < first_row_[p + 1]; ++c) {
      matrix_.outerIndexPtr()[c] = next;
      for (Index r = c; r < first_row_[p + 1]; ++r) matrix_.innerIndexPtr()[next++] = r;
      for (Index k = offsets_[p]; k < offsets_[p + 1]; ++k) {
        const Index last = first_row_[later_[k] + 1];
        for (Index r = first_row_[later_[k]]; r < last; ++r) matrix_.innerIndexPtr()[next++] = r;
      }
    }
  }
  matrix_.outerIndexPtr()[first_row_.back()] = next;
}

double* PointMatrix::block(Index upper, Index lower, Index column) {
  double* begin = matrix_.valuePtr() + matrix_.outerIndexPtr()[first_row_[upper] + column];
  if (upper == lower) return begin - column;
  const auto first = later_.begin() + offsets_[upper], last = later_.begin() + offsets_[upper + 1];
  const auto found = std::lower_bound(first, last, lower);
  return begin + rows(upper) - column + below_[found - later_.begin()];
}

void PointMatrix::set_zero() { std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0); }

std::vector<Index> PointMatrix::point_of_rows() const {
  std::vector<Index> points;
  for (Index p = 0; p < this->points(); ++p) points.insert(points.end(), rows(p), p);
  return points;
}

}  // namespace perilink

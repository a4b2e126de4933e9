#include "base/vector_span.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace perilink {
namespace {

/// Length of a remainder over the vector's length: below `none` it is zero, above `enough` it is a
/// new direction.
constexpr double none = 1e-12, enough = 1e-3;

/// Largest sum of the lengths of combined vectors over the length of their result.
constexpr double longest = 30.0;

double length_of(const std::vector<double>& values) {
  return std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0));
}

}  // namespace

void VectorSpan::clear() { *this = {}; }

auto VectorSpan::split(const SparseVector& x) const -> Split {
  Split result{{}, std::vector<double>(row_of_.size(), 0.0)};
  std::vector<std::size_t> rows;
  for (int k = 0; k < x.size(); ++k) {
    rows.push_back(row_of_.at(x.rows[k]));
    result.rest[rows.back()] = x.values[k];
  }
  for (const std::vector<double>& direction : directions_) {
    double along = 0.0;
    for (int k = 0; k < x.size(); ++k) {
      if (rows[k] < direction.size()) along += x.values[k] * direction[rows[k]];
    }
    result.along.push_back(along);
    for (std::size_t row = 0; along != 0.0 && row < direction.size(); ++row) {
      result.rest[row] -= along * direction[row];
    }
  }
  return result;
}

void VectorSpan::add(const SparseVector& x, Index number) {
  for (const Index unknown : x.rows) row_of_.try_emplace(unknown, row_of_.size());
  Split parts = split(x);
  const double length = length_of(x.values);
  const double left = length_of(parts.rest);
  if (!(left > enough * length)) return;
  for (double& value : parts.rest) value /= left;
  // Second orthogonalisation, against round-off.
  for (const std::vector<double>& direction : directions_) {
    const double along =
        std::inner_product(direction.begin(), direction.end(), parts.rest.begin(), 0.0);
    for (std::size_t row = 0; row < direction.size(); ++row) {
      parts.rest[row] -= along * direction[row];
    }
  }
  parts.along.push_back(left);
  for (double& value : parts.along) value /= length;
  numbers_.push_back(number);
  lengths_.push_back(length);
  directions_.push_back(std::move(parts.rest));
  coordinates_.push_back(std::move(parts.along));
}

auto VectorSpan::parts_of(const SparseVector& x) const -> std::optional<std::vector<Part>> {
  const auto is_inside = [&](Index unknown) { return row_of_.contains(unknown); };
  if (!std::ranges::all_of(x.rows, is_inside)) return {};
  Split parts = split(x);
  const double length = length_of(x.values);
  if (!(length_of(parts.rest) <= none * length)) return {};
  std::vector<Part> result;
  double whole = 0.0;
  for (std::size_t c = directions_.size(); c-- > 0;) {
    const double share = parts.along[c] / coordinates_[c][c];
    for (std::size_t d = 0; d < c; ++d) parts.along[d] -= share * coordinates_[c][d];
    if (std::abs(share) <= none * length) continue;
    whole += std::abs(share);
    result.push_back({numbers_[c], share / lengths_[c]});
  }
  if (whole > longest * length) return {};
  return result;
}

}  // namespace perilink

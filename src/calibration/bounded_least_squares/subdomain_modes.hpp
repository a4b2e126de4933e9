#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/block.hpp"

namespace perilink {

/// Modes on the points of one subdomain in single precision, stored row after row. Products have
/// double precision, so that they are exact for the stored modes.
class SubdomainModes {
 public:
  SubdomainModes() = default;
  /// \param modes  one after the other, shape (count, points * rows)
  SubdomainModes(std::size_t count, std::span<const double> fields);

  std::size_t count() const { return count_; }
  /// Returns the modes row after row, shape (points * rows, count).
  std::vector<double> values() const;

  /// Adds F' values to sums, for the rows from `first`.
  void add_sums(std::size_t first, std::span<const double> values, double* sums) const;
  /// Adds F shares to values.
  void add_fields(std::span<const double> shares, double* values) const;

 private:
  static constexpr std::size_t lanes = 16;

  std::size_t count_ = 0, rows_ = 0;
  std::size_t width_ = 0;      // number of modes, rounded up to whole lanes
  BlockVector<float> values_;  // shape (points * rows, width)
};

}  // namespace perilink

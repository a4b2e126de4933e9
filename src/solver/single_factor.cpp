#include "solver/single_factor.hpp"

#include <cstddef>

#include "base/lanes.hpp"

namespace perilink {
namespace {

using Side = LongLanes<float, block_width>;

/// Rows processed together, so that shared values are loaded once.
constexpr Index together = 4;

/// Rows of a supernode and the positions of their right sides.
class Rows {
 public:
  Rows(const SingleFactor::Supernode& node, float* sides)
      : node_(node), sides_(reinterpret_cast<Side*>(sides)) {}

  const float* values(Index row) const {
    return node_.values.data() + static_cast<std::size_t>(row) * node_.columns;
  }
  Side& side(Index row) const {
    const Index columns = node_.columns;
    return sides_[row < columns ? node_.first + row : node_.rows[row - columns]];
  }
  Index count() const { return node_.columns + static_cast<Index>(node_.rows.size()); }

  /// Subtracts the first `columns` columns, whose solutions are known, from `Count` rows.
  template <Index Count>
  void eliminate(Index row, Index columns) const {
    Side sums[Count] = {};
    const float* value = values(row);
    const std::ptrdiff_t next = node_.columns;
    const Side* solved = sides_ + node_.first;
    for (Index k = 0; k < columns; ++k) {
      const Side own = solved[k];
      for (Index r = 0; r < Count; ++r) sums[r] += value[r * next + k] * own;
    }
    for (Index r = 0; r < Count; ++r) side(row + r) -= sums[r];
  }

  /// Subtracts `Count` rows, whose solutions are known, from the first `columns` columns.
  template <Index Count>
  void substitute(Index row, Index columns) const {
    Side solved[Count];
    for (Index r = 0; r < Count; ++r) solved[r] = side(row + r);
    const float* value = values(row);
    const std::ptrdiff_t next = node_.columns;
    Side* own = sides_ + node_.first;
    for (Index k = 0; k < columns; ++k) {
      Side sum = own[k];
      for (Index r = 0; r < Count; ++r) sum -= value[r * next + k] * solved[r];
      own[k] = sum;
    }
  }

 private:
  const SingleFactor::Supernode& node_;
  Side* sides_;
};

/// Solves the triangle of the few columns from `begin` to `end`.
void forward_triangle(const Rows& rows, Index begin, Index end) {
  for (Index k = begin; k < end; ++k) {
    Side sum = rows.side(k);
    for (Index j = begin; j < k; ++j) sum -= rows.values(k)[j] * rows.side(j);
    rows.side(k) = rows.values(k)[k] * sum;
  }
}

void backward_triangle(const Rows& rows, Index begin, Index end) {
  for (Index k = end; k-- > begin;) {
    Side sum = rows.side(k);
    for (Index j = k + 1; j < end; ++j) sum -= rows.values(j)[k] * rows.side(j);
    rows.side(k) = rows.values(k)[k] * sum;
  }
}

void forward(const Rows& rows, Index columns) {
  Index row = 0;
  for (; row + together <= columns; row += together) {
    rows.eliminate<together>(row, row);
    forward_triangle(rows, row, row + together);
  }
  for (const Index begin = row; row < columns; ++row) {
    rows.eliminate<1>(row, begin);
    if (row + 1 == columns) forward_triangle(rows, begin, columns);
  }
  for (; row + together <= rows.count(); row += together) rows.eliminate<together>(row, columns);
  for (; row < rows.count(); ++row) rows.eliminate<1>(row, columns);
}

void backward(const Rows& rows, Index columns) {
  Index row = columns;
  for (; row + together <= rows.count(); row += together) rows.substitute<together>(row, columns);
  for (; row < rows.count(); ++row) rows.substitute<1>(row, columns);
  Index end = columns;
  const Index odd = columns % together;
  backward_triangle(rows, end - odd, end);
  for (Index k = end - odd; k < end; ++k) rows.substitute<1>(k, end - odd);
  for (end -= odd; end > 0; end -= together) {
    backward_triangle(rows, end - together, end);
    rows.substitute<together>(end - together, end - together);
  }
}

}  // namespace

void SingleFactor::solve(std::span<float> sides) const {
  for (const Supernode& node : supernodes) forward({node, sides.data()}, node.columns);
  for (auto node = supernodes.rbegin(); node != supernodes.rend(); ++node) {
    backward({*node, sides.data()}, node->columns);
  }
}

}  // namespace perilink

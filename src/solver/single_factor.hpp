#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/block.hpp"
#include "base/types.hpp"

namespace perilink {

/// A supernodal factor L L' in single precision, for block_width right sides side by side: a
/// preconditioner needs no more digits, and libraries pack L anew for so few of them at a time,
/// which takes longer than the products.
struct SingleFactor {
  /// Columns that have the same rows below them.
  struct Supernode {
    Index first = 0, columns = 0;
    std::vector<Index> rows;    ///< below its own columns
    std::vector<float> values;  ///< row after row, shape (columns + rows, columns); zero above the
                                ///< diagonal, which holds one over its numbers
  };
  std::vector<Supernode> supernodes;  ///< in the order of elimination
  std::vector<Index> place;           ///< where each unknown comes in it

  /// Solves right sides where they are, shape (n, block_width), in the order of the factor.
  void solve(std::span<float> sides) const;
};

}  // namespace perilink

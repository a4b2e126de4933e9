#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/block.hpp"
#include "base/types.hpp"

namespace perilink {

/// Supernodal factor L L' in single precision for block_width right sides side by side, for
/// preconditioners. Libraries would repack L for each such small block, which takes longer than the
/// products.
struct SingleFactor {
  /// Columns with one pattern of rows below them.
  struct Supernode {
    Index first = 0, columns = 0;
    std::vector<Index> rows;    ///< below the supernode's own columns
    std::vector<float> values;  ///< row after row, shape (columns + rows, columns); zero above the
                                ///< diagonal, which holds reciprocals
  };
  std::vector<Supernode> supernodes;  ///< in the order of elimination
  std::vector<Index> place;           ///< position of each unknown in the order of elimination

  /// Solves right sides in place, shape (n, block_width), in the order of the factor.
  void solve(std::span<float> sides) const;
};

}  // namespace perilink

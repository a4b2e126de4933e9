#pragma once

#include <cholmod.h>

#include <span>
#include <utility>
#include <vector>

#include "base/types.hpp"

/// \file
/// What CHOLMOD's supernodal factor holds: only files of this folder may include it.

namespace perilink {

/// Columns of L with the same rows, which begin with the columns themselves.
struct Supernode {
  const Index* rows;
  double* values;  ///< column-major, shape (count, columns)
  Index first, columns, count;

  Index below() const { return count - columns; }
  double* column(Index j) const { return values + static_cast<std::size_t>(j) * count; }
};

Supernode supernode_of(const cholmod_factor& factor, Index s);

/// The elimination tree of the supernodes.
struct SupernodeTree {
  SupernodeTree() = default;
  explicit SupernodeTree(const cholmod_factor& factor);

  std::vector<Index> of_column;  ///< the supernode of each column
  std::vector<Index> parent;     ///< per supernode; no_index at roots

  /// Independent subtrees, and what is above them.
  struct Cut {
    std::vector<std::pair<Index, Index>> subtrees;  ///< [first, last] supernodes, in postorder
    std::vector<Index> top;                         ///< descending
  };
  /// \param work  per supernode
  /// \param most  work of a subtree
  Cut cut(std::vector<double> work, double most) const;
};

}  // namespace perilink

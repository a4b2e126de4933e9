#pragma once

#include <cholmod.h>

#include <utility>
#include <vector>

#include "base/types.hpp"

/// \file
/// Access to CHOLMOD's supernodal factor; only files of this folder may include this header.

namespace perilink {

/// Columns of L with a common pattern of rows, which begins with the columns themselves.
template <class Number>
struct Supernode {
  const Index* rows;
  Number* values;  ///< column-major, shape (count, columns)
  Index first, columns, count;

  Index below() const { return count - columns; }
  Number* column(Index j) const { return values + static_cast<std::size_t>(j) * count; }
  Number& diagonal(Index j) const { return column(j)[j]; }
};

/// \param values  numbers of the supernode, shape (count, columns)
template <class Number>
Supernode<Number> supernode_of(const cholmod_factor& factor, Number* values, Index s) {
  const auto ints = [](const void* array) { return static_cast<const Index*>(array); };
  const Index* super = ints(factor.super);
  const Index* first_row = ints(factor.pi);
  return {ints(factor.s) + first_row[s], values, super[s], super[s + 1] - super[s],
          first_row[s + 1] - first_row[s]};
}
/// Returns a supernode with its numbers, or a null pointer if the factor has none.
inline Supernode<double> supernode_of(const cholmod_factor& factor, Index s) {
  auto* all = static_cast<double*>(factor.x);
  return supernode_of(factor, all == nullptr ? all : all + static_cast<const Index*>(factor.px)[s],
                      s);
}

/// Elimination tree of the supernodes.
struct SupernodeTree {
  SupernodeTree() = default;
  explicit SupernodeTree(const cholmod_factor& factor);

  std::vector<Index> of_column;  ///< supernode of each column
  std::vector<Index> parent;     ///< per supernode; no_index at roots

  /// Independent subtrees and the supernodes above them.
  struct Cut {
    std::vector<std::pair<Index, Index>> subtrees;  ///< [first, last] supernodes, in postorder
    std::vector<Index> top;                         ///< descending
  };
  /// \param work  per supernode
  /// \param most  largest work of a subtree
  Cut cut(std::vector<double> work, double most) const;
};

}  // namespace perilink

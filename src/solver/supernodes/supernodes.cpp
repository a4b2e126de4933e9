#include "solver/supernodes/supernodes.hpp"

#include <algorithm>
#include <numeric>

namespace perilink {
SupernodeTree::SupernodeTree(const cholmod_factor& factor)
    : of_column(factor.n), parent(factor.nsuper, no_index) {
  const Index count = static_cast<Index>(factor.nsuper);
  for (Index s = 0; s < count; ++s) {
    const auto node = supernode_of(factor, s);
    std::fill_n(of_column.begin() + node.first, node.columns, s);
  }
  for (Index s = 0; s < count; ++s) {
    const auto node = supernode_of(factor, s);
    if (node.below() > 0) parent[s] = of_column[node.rows[node.columns]];
  }
}

SupernodeTree::Cut SupernodeTree::cut(std::vector<double> work, double most) const {
  std::vector<Index> first(parent.size());
  std::iota(first.begin(), first.end(), 0);
  for (std::size_t s = 0; s < parent.size(); ++s) {
    if (parent[s] == no_index) continue;
    work[parent[s]] += work[s];
    first[parent[s]] = std::min(first[parent[s]], first[s]);
  }
  Cut cut;
  for (Index s = static_cast<Index>(parent.size()) - 1; s >= 0;) {
    if (work[s] > most) {
      cut.top.push_back(s--);
    } else {
      cut.subtrees.emplace_back(first[s], s);
      s = first[s] - 1;
    }
  }
  return cut;
}

}  // namespace perilink

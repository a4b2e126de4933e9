#include "solver/supernodes/supernodes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "solver/cholmod_support.hpp"
#include "support/spring_lattice.hpp"

namespace perilink {
namespace {

struct AnalysedLattice {
  AnalysedLattice()
      : factor(analyze_supernodal(session, lattice.lower, lattice.groups)), tree(*factor) {}
  test::SpringLattice lattice = test::make_spring_lattice(24, 24, 2.0);
  CholmodSession session;
  CholmodFactorPtr factor;
  SupernodeTree tree;
};

TEST(SupernodeTree, HoldsEachColumnOnceAndParentsBehindTheirChildren) {
  const AnalysedLattice analysed;
  const SupernodeTree& tree = analysed.tree;
  Index next = 0, roots = 0;
  for (Index s = 0; s < static_cast<Index>(tree.parent.size()); ++s) {
    const auto node = supernode_of(*analysed.factor, s);
    EXPECT_EQ(node.first, next);
    next += node.columns;
    for (Index j = 0; j < node.columns; ++j) {
      EXPECT_EQ(node.rows[j], node.first + j);
      EXPECT_EQ(tree.of_column[node.first + j], s);
    }
    roots += tree.parent[s] == no_index;
    if (tree.parent[s] == no_index) continue;
    EXPECT_GT(tree.parent[s], s);
  }
  EXPECT_EQ(next, analysed.lattice.size);
  EXPECT_EQ(roots, 1) << "the lattice hangs together";
}

TEST(SupernodeTree, IsCutIntoSubtreesOfSoMuchWorkAndTheRest) {
  const AnalysedLattice analysed;
  const SupernodeTree& tree = analysed.tree;
  const std::vector<double> work(tree.parent.size(), 1.0);
  for (const double most : {0.0, 3.0, 10.0, 1e9}) {
    const SupernodeTree::Cut cut = tree.cut(work, most);
    std::vector<int> part(tree.parent.size(), -1);  // number of the subtree; 0 above
    for (const Index s : cut.top) part[s] = 0;
    for (std::size_t t = 0; t < cut.subtrees.size(); ++t) {
      const auto [first, last] = cut.subtrees[t];
      EXPECT_LE(last - first + 1, most);
      for (Index s = first; s <= last; ++s) {
        EXPECT_EQ(part[s], -1) << "in two parts";
        part[s] = static_cast<int>(t) + 1;
      }
    }
    EXPECT_TRUE(std::ranges::is_sorted(cut.top, std::greater<>()));
    for (std::size_t s = 0; s < part.size(); ++s) {
      EXPECT_NE(part[s], -1) << "in no part";
      if (tree.parent[s] == no_index) continue;
      const int above = part[tree.parent[s]];
      EXPECT_TRUE(above == part[s] || above == 0) << "subtrees depend on each other";
    }
    EXPECT_EQ(cut.top.empty(), most > static_cast<double>(part.size()));
  }
}

}  // namespace
}  // namespace perilink

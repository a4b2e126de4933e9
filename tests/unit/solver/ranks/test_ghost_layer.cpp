#include "solver/ranks.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "support/thread_ranks.hpp"

namespace perilink {
namespace {

/// Three ranks own two particles each, 0 to 5, and know one or two of the next rank's as well, the
/// last one none: the first gives nothing, the last takes nothing.
void update_chain(Ranks& ranks) {
  const int own = ranks.own();
  Ghosts ghosts;
  if (own == 0) ghosts = {{2, 3}, {1, 1}, {1, 0}};
  if (own == 1) ghosts = {{2}, {2}, {1}};
  GhostLayer layer(ranks, ghosts);
  const std::size_t known = 2 + ghosts.owners.size();
  std::vector<double> motion(2 * known, -1.0), speed(2 * known, -1.0);
  for (int k = 0; k < 4; ++k) motion[k] = 10.0 * own + k, speed[k] = 100.0 + motion[k];
  layer.update(2, {motion, speed});
  const std::vector<std::vector<double>> expected = {
      {0, 1, 2, 3, 12, 13, 10, 11}, {10, 11, 12, 13, 22, 23}, {20, 21, 22, 23}};
  EXPECT_EQ(motion, expected[own]);
  for (std::size_t k = 0; k < speed.size(); ++k) EXPECT_EQ(speed[k], 100.0 + expected[own][k]);
}

TEST(GhostLayer, BringsEveryFieldOfGhostsFromTheirOwners) {
  test::with_thread_ranks(3, update_chain, update_chain);
}

}  // namespace
}  // namespace perilink

#include "solver/ordering.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/spring_lattice.hpp"

namespace perilink {
namespace {

TEST(Ordering, IsAPermutationThatKeepsParticlesTogether) {
  const auto lattice = test::make_spring_lattice(20, 15, 3.0);

  const auto order = order_by_particles(lattice.lower, lattice.groups);

  auto sorted = order;
  std::sort(sorted.begin(), sorted.end());
  for (Index k = 0; k < lattice.size; ++k) ASSERT_EQ(sorted[k], k);
  for (std::size_t k = 0; k < order.size(); k += 2) EXPECT_EQ(order[k] + 1, order[k + 1]);
}

TEST(Ordering, IsTheSameInEveryRun) {
  const auto lattice = test::make_spring_lattice(20, 15, 3.0);
  EXPECT_EQ(order_by_particles(lattice.lower, lattice.groups),
            order_by_particles(lattice.lower, lattice.groups));
}

TEST(Ordering, HoldsForOneParticleAndForNoBonds) {
  const auto one = test::make_spring_lattice(1, 1, 1.0);
  EXPECT_EQ(order_by_particles(one.lower, one.groups), (std::vector<Index>{0, 1}));
  const auto loose = test::make_spring_lattice(3, 1, 0.5);
  EXPECT_EQ(order_by_particles(loose.lower, loose.groups).size(), 6u);
}

}  // namespace
}  // namespace perilink

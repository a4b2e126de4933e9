#include "analysis/quasistatic/events/crushing_bonds.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;
using testing::UnorderedElementsAre;

/// Four particles in a row; bonds 0 - 1, 1 - 2, 2 - 3.
Network chain() {
  Network network = make_chains(3, 1, false, 1.0, 0.01).network;
  network.laws.front() = BondLaw::brittle().crushing({{1.0, 1.0}}, 7.0, true);
  return network;
}

TEST(CrushingBonds, WakeAtBothEndsOfWhatIsStretched) {
  const Network network = chain();
  ASSERT_EQ(network.num_elements(), 3);
  CrushingBonds bonds(network);
  EXPECT_THAT(bonds.wake(0), UnorderedElementsAre(0, 0, 1));
  EXPECT_TRUE(bonds.wake(0).empty()) << "they are awake";
  EXPECT_THAT(bonds.wake(1), UnorderedElementsAre(1, 2));
  EXPECT_THAT(bonds.wake(2), UnorderedElementsAre(2));
}

TEST(CrushingBonds, AreThoseOfTheLawThatCanBreak) {
  Network network = chain();
  network.critical_stretch[1] = std::numeric_limits<double>::infinity();
  network.laws.push_back(BondLaw::brittle());
  network.law_of = {0, 0, 1};
  CrushingBonds bonds(network);
  EXPECT_THAT(bonds.wake(0), UnorderedElementsAre(0, 0));
  EXPECT_TRUE(bonds.wake(2).empty());
}

TEST(CrushingBonds, AreShorterWhereTheirEndsApproach) {
  const Network network = chain();
  const std::vector<double> motion = {0.0, 0.0, 0.5, 1.0, 0.2, -2.0, 0.2, 0.0};
  EXPECT_FALSE(is_shorter(network, 0, motion));
  EXPECT_TRUE(is_shorter(network, 1, motion));
  EXPECT_FALSE(is_shorter(network, 2, motion));
}

}  // namespace
}  // namespace perilink

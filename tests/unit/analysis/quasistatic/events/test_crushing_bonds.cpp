#include "analysis/quasistatic/events/crushing_bonds.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;
using testing::UnorderedElementsAre;

/// Four particles, every pair bonded: 0 - 1, 0 - 2, 0 - 3, 1 - 2, 1 - 3, 2 - 3.
Network crushing_square() {
  Network network = make_square().network;
  network.laws.front() = BondLaw::brittle().crushing({{1.0, 1.0}}, 7.0, true);
  return network;
}

TEST(CrushingBonds, WakeAtBothEndsOfWhatIsStretched) {
  const Network network = crushing_square();
  ASSERT_EQ(network.num_elements(), 6);
  CrushingBonds bonds(network);
  EXPECT_THAT(bonds.wake(0), UnorderedElementsAre(0, 1, 2, 0, 3, 4));
  EXPECT_TRUE(bonds.wake(0).empty()) << "they are active";
  EXPECT_THAT(bonds.wake(1), UnorderedElementsAre(1, 3, 5)) << "those at particle 2";
  EXPECT_THAT(bonds.wake(5), UnorderedElementsAre(2, 4, 5)) << "those at particle 3";
}

TEST(CrushingBonds, AreThoseOfTheLawThatCanBreak) {
  Network network = crushing_square();
  network.critical_stretch[1] = std::numeric_limits<double>::infinity();
  network.laws.push_back(BondLaw::brittle());
  network.law_of = {0, 0, 1, 0, 0, 0};
  CrushingBonds bonds(network);
  EXPECT_THAT(bonds.wake(0), UnorderedElementsAre(0, 0, 3, 4));
}

TEST(CrushingBonds, AreShorterWhereTheirEndsApproach) {
  const Network network = crushing_square();
  const std::vector<double> motion = {0.0, 0.0, 0.5, 1.0, 0.2, -2.0, 0.2, 0.0};
  const auto sides = [&](Index element, double x, double y) {
    const std::span<const double> n = network.bonds.direction(element);
    return n[0] * x + n[1] * y < 0.0;
  };
  EXPECT_EQ(is_shorter(network, 0, motion), sides(0, 0.5, 1.0));
  EXPECT_EQ(is_shorter(network, 1, motion), sides(1, 0.2, -2.0));
  EXPECT_EQ(is_shorter(network, 5, motion), sides(5, 0.0, 2.0));
  EXPECT_NE(is_shorter(network, 0, motion), is_shorter(network, 1, motion));
}

}  // namespace
}  // namespace perilink

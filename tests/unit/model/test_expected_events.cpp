#include "model/expected_events.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "network/bond_softening.hpp"
#include "support/small_networks.hpp"

namespace perilink {
namespace {

using namespace test;

/// A plate of 20 by 5 spacings whose bonds reach one spacing along it and across it.
Network long_plate() {
  LatticeInput body = body_input(rectangular, 5);
  body.solid = {{{0.0, 0.0, 0.0}, {20.0 * body.spacing, 5.0 * body.spacing, 0.0}}};
  NetworkInput input = network_input(body);
  input.horizon = 1.1 * body.spacing;
  return build_network(make_body(body), input);
}

TEST(ExpectedEvents, CountTheBondsAcrossTheBody) {
  Network plate = long_plate();
  EXPECT_NEAR(expected_crack(plate)->events, 6.0, 1e-9);
  for (double& x : plate.particles.positions) x *= -3.0;
  EXPECT_NEAR(expected_crack(plate)->events, 6.0, 1e-9);
}

TEST(ExpectedEvents, CountEverySegment) {
  Network plate = long_plate();
  plate.laws = {BondLaw::saw_tooth({{1.0, 1.0}, {0.5, 1.5}, {0.25, 2.0}})};
  EXPECT_EQ(count_segments(plate.laws[0]), 3);
  EXPECT_NEAR(expected_crack(plate)->events, 18.0, 1e-9);
}

/// The crack lies where bonds can break, and the part that cannot does not thin them out.
TEST(ExpectedEvents, LeaveOutBondsThatCannotBreak) {
  Network plate = long_plate();
  const double end = 10.5 * 0.2;
  for (Index e = 0; e < plate.num_elements(); ++e) {
    const bool left = plate.particles.position(plate.bonds.first[e])[0] < end &&
                      plate.particles.position(plate.bonds.second[e])[0] < end;
    if (left) plate.critical_stretch[e] = infinity;
  }
  EXPECT_NEAR(expected_crack(plate)->events, 6.0, 1e-9);
  plate.critical_stretch.assign(plate.critical_stretch.size(), infinity);
  EXPECT_FALSE(expected_crack(plate));
}

TEST(ExpectedEvents, FollowWeakInterfaces) {
  Network plate = long_plate();
  plate.report.interfaces = {{.count = 7, .strength = {.segments = 4}}};
  EXPECT_EQ(expected_crack(plate)->events, 28.0);
}

/// The crack takes the ligament of a notched body.
TEST(ExpectedEvents, CountTheWeakestPlane) {
  LatticeInput body = body_input(rectangular, 5);
  const double h = body.spacing;
  body.solid = {{{0.0, 0.0, 0.0}, {9.0 * h, 5.0 * h, 0.0}},
                {{9.0 * h, 0.0, 0.0}, {11.0 * h, 2.0 * h, 0.0}},
                {{11.0 * h, 0.0, 0.0}, {20.0 * h, 5.0 * h, 0.0}}};
  body.material = {0, 0, 0};
  NetworkInput input = network_input(body);
  input.horizon = 1.1 * h;
  EXPECT_NEAR(expected_crack(build_network(make_body(body), input))->events, 3.0, 1e-9);
}

TEST(ExpectedEvents, TellTheEnergyOfTheCrack) {
  Network plate = long_plate();
  plate.laws = {BondLaw::saw_tooth({{1.0, 1.0}, {0.5, 1.5}})};
  std::ranges::fill(plate.stiffness, 2.0);
  std::ranges::fill(plate.critical_stretch, 0.01);
  const double extension = 0.01 * plate.bonds.length(0);
  const double of_bond = extension * extension * (0.5 + 0.5 * 1.5 * 1.5);
  EXPECT_NEAR(expected_crack(plate)->energy, 6.0 * of_bond, 1e-9 * of_bond);
}

TEST(ExpectedEvents, AreLeftAsTheCrackGrows) {
  const ExpectedCrack crack{1000.0, 2.0};
  EXPECT_EQ(crack.events_left(0.0), 1000.0);
  EXPECT_NEAR(crack.events_left(1.5), 250.0, 1e-9);
  EXPECT_NEAR(crack.events_left(2.3), 100.0, 1e-9) << "about to be complete";
  EXPECT_NEAR(crack.events_left(2.6), 700.0, 1e-9) << "another crack";
  for (double released = 0.0; released < 20.0; released += 0.1) {
    EXPECT_LE(crack.events_left(released), 1000.0);
  }
}

TEST(ExpectedEvents, ComeInLargerBatchesWithALargerTolerance) {
  EXPECT_EQ(expected_batch(1e4, 0.0, 2), 1.0);
  EXPECT_NEAR(expected_batch(1e4, 0.01, 2), 4.0, 1e-12);
  EXPECT_NEAR(expected_batch(1e4, 0.05, 2), 20.0, 1e-12);
  EXPECT_NEAR(expected_batch(8000.0, 0.01, 3), 6.4, 1e-12);
}

}  // namespace
}  // namespace perilink

#include "model/expected_events.hpp"

#include <gtest/gtest.h>

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
  EXPECT_NEAR(*expected_events(plate), 6.0, 1e-9);
  for (double& x : plate.particles.positions) x *= -3.0;
  EXPECT_NEAR(*expected_events(plate), 6.0, 1e-9);
}

TEST(ExpectedEvents, CountEverySegment) {
  Network plate = long_plate();
  plate.laws = {BondLaw::saw_tooth({{1.0, 1.0}, {0.5, 1.5}, {0.25, 2.0}})};
  EXPECT_EQ(count_segments(plate.laws[0]), 3);
  EXPECT_NEAR(*expected_events(plate), 18.0, 1e-9);
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
  EXPECT_NEAR(*expected_events(plate), 6.0, 1e-9);
  plate.critical_stretch.assign(plate.critical_stretch.size(), infinity);
  EXPECT_FALSE(expected_events(plate));
}

TEST(ExpectedEvents, FollowWeakInterfaces) {
  Network plate = long_plate();
  plate.interfaces = {{.count = 7, .strength = {.segments = 4}}};
  EXPECT_EQ(expected_events(plate), 28.0);
}

TEST(ExpectedEvents, AreUnknownForBodiesThatCrackInManyPlaces) {
  Network plate = long_plate();
  plate.first_slip_spring = plate.num_elements() - 1;
  EXPECT_FALSE(expected_events(plate));
}

TEST(ExpectedEvents, ComeInLargerBatchesWithALargerTolerance) {
  EXPECT_EQ(expected_batch(1e4, 0.0), 1.0);
  EXPECT_NEAR(expected_batch(8000.0, 0.01), 5.4, 1e-12);
  EXPECT_NEAR(expected_batch(8000.0, 0.05), 27.0, 1e-12);
}

}  // namespace
}  // namespace perilink

#include <gtest/gtest.h>

#include <vector>

#include "assembly/stiffness.hpp"
#include "network/unknowns.hpp"

namespace perilink {
namespace {

TEST(Unknowns, CountTheFreeAxesInTheOrderOfTheParticles) {
  const Unknowns unknowns =
      number_unknowns(2, {0, 1, 1, 1, 0, 0}, {0.0, 0.5, -0.25, 0.0, 0.0, 0.0});
  EXPECT_EQ(unknowns.count, 3);
  EXPECT_EQ(unknowns.number, (std::vector<Index>{0, no_index, no_index, no_index, 1, 2}));
  EXPECT_EQ(unknowns.at(2, 1), 2);
  EXPECT_EQ(unknowns.owners(), (std::vector<Index>{0, 2, 2}));
}

TEST(Unknowns, ExpandPutsPrescribedValuesBack) {
  const Unknowns unknowns = number_unknowns(2, {0, 1, 1, 0}, {0.0, 0.5, -0.25, 0.0});
  const std::vector<double> solution = {7.0, 8.0};
  EXPECT_EQ(unknowns.expand(solution), (std::vector<double>{7.0, 0.5, -0.25, 8.0}));
}

/// A particle with two neighbours: a bond with a hinge at it does not turn it, nor does a truss.
TEST(RotatingParticles, AreNotThoseWithHingesOnly) {
  Network network;
  network.bonds.first = {0, 0, 1};
  network.bonds.second = {1, 2, 2};
  network.bonds.lengths = {1.0, 1.0, 1.0};
  network.bending = {1.0, 0.0, 1.0};
  network.particles.volumes.assign(3, 1.0);
  EXPECT_EQ(rotating_particles(network), (std::vector<std::uint8_t>{1, 1, 1}));
  network.hinged = {first_end, 0, 0};
  EXPECT_EQ(rotating_particles(network), (std::vector<std::uint8_t>{0, 1, 1}));
  network.hinged = {0, 0, second_end};
  EXPECT_EQ(rotating_particles(network), (std::vector<std::uint8_t>{1, 1, 0}));
}

}  // namespace
}  // namespace perilink

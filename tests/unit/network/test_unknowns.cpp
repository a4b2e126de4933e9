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

}  // namespace
}  // namespace perilink

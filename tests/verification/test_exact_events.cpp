#include <gtest/gtest.h>

#include "compare.hpp"
#include "problems/block.hpp"

namespace perilink::verification {
namespace {

/// The study's claim at its smallest size: 5 000 unknowns, every event until collapse.
TEST(ExactEvents, BreakTheBondsThatAFreshFactorBreaks) {
  const Agreement a = compare_routes(columns_5k, FactorRoute::refactorize, 1000, 1000);

  EXPECT_EQ(a.ending, "collapsed");
  EXPECT_GT(a.compared, 500);
  EXPECT_EQ(a.mismatches, 0);
  EXPECT_LT(a.load_factor_difference, 1e-9);
  EXPECT_LT(a.energy_error, 1e-9);
}

}  // namespace
}  // namespace perilink::verification

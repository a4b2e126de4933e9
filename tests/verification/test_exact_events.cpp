#include <gtest/gtest.h>

#include <string>

#include "compare.hpp"
#include "problems/block.hpp"

namespace perilink::verification {
namespace {

class ExactEvents : public testing::TestWithParam<std::string> {};

/// The study's claim at its smallest size: 5 000 unknowns, every event until collapse.
TEST_P(ExactEvents, BreakTheBondsThatAFreshFactorBreaks) {
  const Agreement a =
      compare_routes(make_block(columns_5k, GetParam()), FactorRoute::refactorize, 1000, 1000);

  EXPECT_EQ(a.ending, "collapsed");
  EXPECT_GT(a.compared, 500);
  EXPECT_EQ(a.mismatches, 0);
  EXPECT_LT(a.load_factor_difference, 1e-9);
  EXPECT_LT(a.energy_error, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Surface, ExactEvents, testing::Values("calibrated", "none"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace perilink::verification

// The study of the same name as a test.

#include <gtest/gtest.h>

#include <stdexcept>

#include "stability.hpp"

namespace perilink::verification {
namespace {

class ExplicitStability : public testing::TestWithParam<MovingBody> {};

TEST_P(ExplicitStability, StepsUpToTheCriticalOneAreStable) {
  for (const double factor : {0.9, 0.99}) {
    const ExplicitResult result = run_at(GetParam(), factor, true);
    EXPECT_EQ(result.termination, Termination::completed) << result.reason;
    EXPECT_TRUE(is_finite(result.last));
    EXPECT_EQ(result.last.broken_bonds + result.last.cracked_particles > 0, GetParam().cracks);
  }
}

TEST_P(ExplicitStability, LargerOnesAreRefused) {
  EXPECT_THROW(run_at(GetParam(), 1.01, true), std::invalid_argument);
}

/// The bound is at most a half too low, so twice the step is unstable whatever the body.
TEST_P(ExplicitStability, MotionThatGrowsIsNoticed) {
  const ExplicitResult result = run_at(GetParam(), 2.0, false);
  EXPECT_EQ(result.termination, Termination::failed);
  EXPECT_NE(result.reason.find("too large"), std::string::npos) << result.reason;
  EXPECT_TRUE(is_finite(result.last)) << "what has overflowed is not a row";
}

INSTANTIATE_TEST_SUITE_P(Bodies, ExplicitStability, testing::ValuesIn(moving_bodies()),
                         [](const auto& body) {
                           return body.param.name + (body.param.cracks ? "_cracks" : "_elastic");
                         });

}  // namespace
}  // namespace perilink::verification

// The study of the same name as a test: the block, loaded within 20 periods.

#include <gtest/gtest.h>

#include "comparison.hpp"

namespace perilink::verification {
namespace {

TEST(ExplicitAgainstImplicit, TheBlockBearsTheSame) {
  const Specimen block = read_specimen("block", PERILINK_STUDY_DIR "/block.toml");
  const Outcome implicit = run_implicit(block);
  const Outcome moved = run_explicit(block, implicit, 1.3, 20.0, 1);
  // The study finds 0.14 % at this speed, on the way to zero; the acceptance is 2 %.
  EXPECT_NEAR(moved.peak_load, implicit.peak_load, 0.02 * implicit.peak_load);
  EXPECT_NEAR(moved.peak_displacement, implicit.peak_displacement,
              0.02 * implicit.peak_displacement);
  EXPECT_GT(crack_overlap(block.network, moved, implicit), 0.3);
  // Round-off of eight thousand steps.
  EXPECT_LT(moved.surplus, 1e-10);
}

}  // namespace
}  // namespace perilink::verification

#include "analysis/dynamics/bonds/free_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace perilink {
namespace {

/// By hand: mass 2, velocity 3, forces 4 * 0.5 - 1 = 1, no damping, dt = 0.1.
TEST(FreeMotion, FollowsNewton) {
  std::vector<double> v{3.0}, u{10.0};
  const MotionWork work =
      move_freely({0.1, 0.5, 0.0}, std::vector{4.0}, std::vector{1.0}, std::vector{2.0}, v, u);
  EXPECT_NEAR(v[0], 3.05, 1e-15);
  EXPECT_NEAR(u[0], 10.305, 2e-15);
  EXPECT_NEAR(work.external, 2.0 * 0.1 * 3.025, 1e-15);  // over the mean velocity
  EXPECT_EQ(work.damping, 0.0);
}

/// For any step, kinetic energy changes by the work of all forces over the mean velocity.
TEST(FreeMotion, KeepsEnergy) {
  constexpr int count = 37;  // no multiple of a processor's vectors
  const MotionStep step{0.3, 0.7, 0.9};
  std::vector<double> load, inner, mass, before, u(count, 0.0);
  for (int k = 0; k < count; ++k) {
    load.push_back(std::sin(k));
    inner.push_back(std::cos(3.0 * k));
    mass.push_back(1.0 + 0.1 * k);
    before.push_back(std::sin(5.0 * k));
  }
  std::vector<double> after = before;
  const MotionWork work = move_freely(step, load, inner, mass, after, u);
  double kinetic = 0.0, inward = 0.0;
  for (int k = 0; k < count; ++k) {
    kinetic += 0.5 * mass[k] * (after[k] * after[k] - before[k] * before[k]);
    inward += 0.5 * step.time_step * inner[k] * (after[k] + before[k]);
    EXPECT_NEAR(u[k], step.time_step * after[k], 1e-15);
  }
  // Round-off of sums of 37 terms of size ten.
  EXPECT_NEAR(kinetic, work.external - work.damping - inward, 1e-12);
  EXPECT_GT(work.damping, 0.0);
}

}  // namespace
}  // namespace perilink

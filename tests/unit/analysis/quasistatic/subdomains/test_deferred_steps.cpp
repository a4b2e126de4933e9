#include "analysis/quasistatic/subdomains/deferred_motion.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "analysis/quasistatic/subdomains/subdomain_factor.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

TEST(DeferredMotion, LeavesStepsOutUntilItIsAskedForThem) {
  const AnalysisBody body = make_block({{"cubic", Pattern::cubic, Surface::none}});
  const std::vector<double> secants = intact(body.network), no_ground;
  SubdomainFactor at_once(body.network, {.tolerance = 1e-12, .edge = 3}),
      later(body.network, {.tolerance = 1e-12, .edge = 3});
  std::vector<double> motion = body.unknowns.restrict(body.loads.forces), deferred;
  for (SubdomainFactor* subdomains : {&at_once, &later})
    subdomains->begin(body.unknowns, secants, no_ground);
  at_once.solve(motion, motion);
  const std::vector<double> start = deferred = motion;
  const DeferredMotion& steps = later.defer();
  for (const Index unknown : {5, 9}) {
    const SparseVector x{{unknown, unknown + 1}, {0.3, -0.2}};
    const double load = 0.1, pivot = at_once.pivot(x);
    at_once.downdate({&x, 1}, {&load, 1}, {&pivot, 1}, motion);
    later.pivot(x);
    later.downdate({&x, 1}, {&load, 1}, {&pivot, 1}, deferred);
  }
  EXPECT_EQ(deferred, start);
  EXPECT_TRUE(later.is_behind());
  EXPECT_EQ(steps.changes, 2);
  const std::vector<std::size_t> slots = body.unknowns.slots();
  double largest = 0.0;
  for (const double value : motion) largest = std::max(largest, std::abs(value));
  // While steps wait columns have errors of 1e-7, and these move the body by little.
  for (std::size_t k = 0; k < motion.size(); ++k) {
    EXPECT_NEAR(start[k] + steps.steps_at(slots[k], 1)[0], motion[k], 1e-9 * largest);
  }
  const std::array<double, 3> together = steps.steps_at(slots[0], 3);
  for (std::size_t a = 0; a < 3; ++a) {
    EXPECT_NEAR(together[a], steps.steps_at(slots[0] + a, 1)[0], 1e-15 * largest);
  }
  EXPECT_THROW(later.defer_no_more(), std::logic_error);
  later.catch_up(deferred);
  EXPECT_FALSE(later.is_behind());
  for (std::size_t k = 0; k < motion.size(); ++k) {
    EXPECT_NEAR(deferred[k], motion[k], 1e-9 * largest);
  }
}

}  // namespace
}  // namespace perilink

#include <gtest/gtest.h>

#include "calibration/calibration.hpp"
#include "support/calibration_problem.hpp"

namespace perilink {
namespace {

using namespace test;

/// Energies, floors, zeros, and one from the multipliers of the search for zeros, which does not go
/// astray: a fifth search would begin anew. 838 iterations; 1 097 where it began anew.
TEST(Calibration, OfACloudInSpaceStartsItsLastSearchFromTheOneBefore) {
  Problem problem = make_problem(box(Pattern::cubic, 0.125, {1, 1, 1}), 3.0, 0.3, false);
  const CalibrationInput input{problem.body.particles, problem.bonds, {{1.0, 1.0}}, {}};
  int searches = 0;
  CalibrationOptions options;
  options.on_search = [&](int, double) { ++searches; };
  const CalibrationReport report =
      calibrate_bonds(input, options, problem.body.facets, problem.stiffness);
  EXPECT_EQ(searches, 4);
  EXPECT_GT(report.dropped, 0);
  EXPECT_LT(report.residual_after, 1e-10);
  EXPECT_EQ(report.unmet, 0);
  EXPECT_LT(report.iterations, 950);
}

}  // namespace
}  // namespace perilink

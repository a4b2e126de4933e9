#include <gtest/gtest.h>

#include "calibration/calibration.hpp"
#include "calibration/calibration_equations.hpp"
#include "support/calibration_problem.hpp"

namespace perilink {
namespace {

using namespace test;

/// At a corner all bonds that lie in none of its three faces pull with one sign in the strain that
/// shears all of them, whose right side is zero: the diagonals of the cubes there, one with a
/// horizon of two spacings, seven with one of three, 17 with one of four. The others there carry
/// both signs in every equation that is zero.
TEST(CalibrationZeros, DropWhatMustVanishAtTheCornersOfACube) {
  for (const auto& [ratio, each] : {std::pair{2.0, 1}, {3.0, 7}, {4.0, 17}}) {
    const Problem problem = make_problem(box(Pattern::cubic, 0.2, {1, 1, 1}), ratio, 0.0, false);
    const CalibrationInput input{problem.body.particles,
                                 problem.bonds,
                                 {{1.0, 1.0}},
                                 std::vector<std::uint8_t>(problem.bonds.lengths.size(), 1)};
    CalibrationEquations equations(input, 0.02, problem.body.facets, problem.stiffness);
    EXPECT_TRUE(equations.drop_fixed_at_zero());
    EXPECT_EQ(equations.num_dropped(), 8 * each);
    equations.start_over();
    EXPECT_FALSE(equations.drop_fixed_at_zero());
    EXPECT_EQ(equations.num_dropped(), 8 * each);
  }
}

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

#include "calibration/calibration_cost.hpp"

#include <gtest/gtest.h>

#include "support/calibration_problem.hpp"

namespace perilink {
namespace {

CalibrationReport estimate(const CalibrationInput& input, bool moments) {
  BondStiffness stiffness;
  stiffness.axial.assign(static_cast<std::size_t>(input.bonds.size()), 1.0);
  if (moments) stiffness.bending = stiffness.axial;
  return expected_calibration(input, {}, stiffness);
}

TEST(CalibrationCost, CountsTheBondsThatMayChange) {
  const test::Problem square =
      test::make_problem(test::box(Pattern::rectangular, 1.0, {4, 4, 0}), 2.0, 0.0, false);
  CalibrationInput input{square.body.particles, square.bonds, {}, {}};
  EXPECT_EQ(estimate(input, false).free_bonds, square.bonds.size());
  EXPECT_FALSE(meets_few(input));
  input.free.assign(static_cast<std::size_t>(square.bonds.size()), 0);
  EXPECT_EQ(estimate(input, false).seconds, 0.0);
  input.free[3] = input.free[7] = 1;
  EXPECT_EQ(estimate(input, false).free_bonds, 2);
  EXPECT_TRUE(meets_few(input));
}

/// Factors of all equations grow faster than their number.
TEST(CalibrationCost, CloudsInThePlaneAreDearerPerBondTheLargerTheyAre) {
  const auto per_bond = [](double side) {
    const test::Problem body =
        test::make_problem(test::box(Pattern::rectangular, 1.0, {side, side, 0}), 2.0, 0.0, false);
    const CalibrationInput input{body.body.particles, body.bonds, {}, {}};
    const CalibrationReport report = estimate(input, false);
    return report.seconds / report.free_bonds;
  };
  EXPECT_GT(per_bond(16.0), 1.5 * per_bond(8.0));
}

TEST(CalibrationCost, MomentsAndSpaceAreDearer) {
  const test::Problem square =
      test::make_problem(test::box(Pattern::rectangular, 1.0, {4, 4, 0}), 2.0, 0.0, false);
  const test::Problem cube =
      test::make_problem(test::box(Pattern::cubic, 1.0, {4, 4, 4}), 2.0, 0.0, false);
  const auto per_bond = [](const test::Problem& body, bool moments) {
    const CalibrationInput input{body.body.particles, body.bonds, {}, {}};
    const CalibrationReport report = estimate(input, moments);
    return report.seconds / report.free_bonds;
  };
  EXPECT_GT(per_bond(square, true), per_bond(square, false));
  EXPECT_GT(per_bond(cube, false), per_bond(square, false));
}

}  // namespace
}  // namespace perilink

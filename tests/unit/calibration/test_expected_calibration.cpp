#include "calibration/expected_calibration.hpp"

#include <gtest/gtest.h>

#include "support/calibration_problem.hpp"

namespace perilink {
namespace {

TEST(ExpectedCalibration, CountsTheBondsThatMayChange) {
  const test::Problem square =
      test::make_problem(test::box(Pattern::rectangular, 1.0, {4, 4, 0}), 2.0, 0.0, false);
  CalibrationInput input{square.body.particles, square.bonds, {}, {}};
  EXPECT_EQ(expected_calibration(input, false).free_bonds, square.bonds.size());
  input.free.assign(static_cast<std::size_t>(square.bonds.size()), 0);
  EXPECT_EQ(expected_calibration(input, false).seconds, 0.0);
  input.free[3] = input.free[7] = 1;
  EXPECT_EQ(expected_calibration(input, false).free_bonds, 2);
}

TEST(ExpectedCalibration, MomentsAndSpaceTakeLongerPerBond) {
  const test::Problem square =
      test::make_problem(test::box(Pattern::rectangular, 1.0, {4, 4, 0}), 2.0, 0.0, false);
  const test::Problem cube =
      test::make_problem(test::box(Pattern::cubic, 1.0, {4, 4, 4}), 2.0, 0.0, false);
  const auto per_bond = [](const test::Problem& body, bool moments) {
    const CalibrationInput input{body.body.particles, body.bonds, {}, {}};
    const CalibrationReport report = expected_calibration(input, moments);
    return report.seconds / report.free_bonds;
  };
  EXPECT_GT(per_bond(square, true), per_bond(square, false));
  EXPECT_GT(per_bond(cube, false), per_bond(square, false));
}

}  // namespace
}  // namespace perilink

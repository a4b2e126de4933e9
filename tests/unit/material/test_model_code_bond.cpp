#include "material/model_code_bond.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace perilink {
namespace {

// fib Model Code 2010, Table 6.1-1, with f_cm = 36 MPa: 2.5 sqrt(36) = 15 MPa; slips in mm.
const ModelCodeBond good{36.0, 10.0};

TEST(ModelCodeBond, IsPulledOutOfGoodConditions) {
  const ForceCurve curve = model_code_curve(good);
  check_curve(curve);
  for (const double slip : {0.01, 0.1, 0.5, 1.0}) {
    EXPECT_NEAR(curve.force(slip), 15.0 * std::pow(slip, 0.4), 0.002 * 15.0) << slip;
  }
  EXPECT_NEAR(curve.force(1.5), 15.0, 1e-12);
  EXPECT_NEAR(curve.force(6.0), 15.0 - 0.6 * 15.0 * 4.0 / 8.0, 1e-9);
  EXPECT_NEAR(curve.force(30.0), 6.0, 1e-12);
  // The area up to s_1 is tau_max s_1 / 1.4.
  EXPECT_NEAR(curve.area(1.0), 15.0 / 1.4, 0.003 * 15.0 / 1.4);
}

TEST(ModelCodeBond, IsWeakerInOtherConditions) {
  ModelCodeBond other = good;
  other.conditions = BondConditions::other;
  const ForceCurve curve = model_code_curve(other);
  EXPECT_NEAR(curve.force(1.8), 7.5, 1e-12);
  EXPECT_NEAR(curve.force(3.6), 7.5, 1e-12);
  EXPECT_NEAR(curve.force(12.0), 3.0, 1e-12);
}

TEST(ModelCodeBond, SplitsBeforeItIsPulledOut) {
  ModelCodeBond split{25.0, 10.0, BondFailure::splitting};
  // 2.5 sqrt(25) = 12.5 is not reached: 7.0 (25 / 25)^0.25 at (7 / 12.5)^2.5 mm.
  const double slip = std::pow(7.0 / 12.5, 2.5);
  const ForceCurve alone = model_code_curve(split);
  check_curve(alone);
  EXPECT_NEAR(alone.force(slip), 7.0, 1e-9);
  EXPECT_NEAR(alone.points.back()[0], 1.2 * slip, 1e-12);
  EXPECT_EQ(alone.points.back()[1], 0.0);
  EXPECT_FALSE(alone.endless);
  split.failure = BondFailure::splitting_stirrups;
  const ForceCurve held = model_code_curve(split);
  EXPECT_NEAR(held.force(std::pow(8.0 / 12.5, 2.5)), 8.0, 1e-9);
  EXPECT_NEAR(held.force(5.0), 0.4 * 8.0, 1e-9);
}

TEST(ModelCodeBond, IsInTheUnitsOfTheCase) {
  ModelCodeBond metres = good;  // kN and m
  metres.megapascal = 1000.0;
  metres.millimetre = 1e-3;
  metres.mean_strength = 36000.0;
  metres.rib_spacing = 0.01;
  EXPECT_NEAR(model_code_curve(metres).force(1.5e-3), 15000.0, 1e-8);
}

}  // namespace
}  // namespace perilink

#include "calibration/bond_equations.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace perilink {
namespace {

/// Reads the rows back as the force on a particle in one strain, by the tensors that they stand
/// for, and compares with the force of a bond computed from its definition.
TEST(BondEquations, RowsHoldTheForcesOfEveryStrain) {
  const double xi = 1.7;
  const std::array<double, 2> n = {0.6, 0.8};
  const ForceRows rows{2, true};
  std::vector<double> axial(static_cast<std::size_t>(rows.count()));
  std::vector<double> shear(axial.size());
  rows.axial(xi, n, axial.data());
  rows.shear(xi, n, shear.data());
  const double eps[2][2] = {{0.3, -0.7}, {-0.7, 1.1}};
  const double en[2] = {eps[0][0] * n[0] + eps[0][1] * n[1], eps[1][0] * n[0] + eps[1][1] * n[1]};
  const double nen = n[0] * en[0] + n[1] * en[1];
  const auto force = [&](const std::vector<double>& row, int c) {
    // Components xxx, xxy, xyy, yyy of the third-order tensor, then the vector.
    const double third = eps[0][0] * row[c] + 2.0 * eps[0][1] * row[c + 1] + eps[1][1] * row[c + 2];
    return third + eps[c][0] * row[4] + eps[c][1] * row[5];
  };
  for (int c = 0; c < 2; ++c) {
    EXPECT_NEAR(force(axial, c), xi * nen * n[c], 1e-15);
    EXPECT_NEAR(force(shear, c), xi * (en[c] - nen * n[c]), 1e-15);
  }
  // Moment xi^2 n x (eps n) / 2 from the two components of nn without trace.
  const double moment = 0.5 * xi * xi * (n[0] * en[1] - n[1] * en[0]);
  EXPECT_NEAR(0.5 * shear[6] * (eps[1][1] - eps[0][0]) + shear[7] * eps[0][1], moment, 1e-15);
}

/// The boundary forces balance the stress (lambda tr(eps) + 2 mu eps) . A.
TEST(BondEquations, RightSideIsTheStressOnTheArea) {
  const ForceRows rows{2, true};
  const double lambda = 1.3, mu = 2.1;
  const Vector3 area = {0.4, -0.9, 0.0};
  std::vector<double> right(static_cast<std::size_t>(rows.count()));
  rows.right({lambda * area[0], lambda * area[1], 0}, {mu * area[0], mu * area[1], 0},
             right.data());
  const double eps[2][2] = {{0.3, -0.7}, {-0.7, 1.1}};
  for (int c = 0; c < 2; ++c) {
    const double force = eps[0][0] * right[c] + 2.0 * eps[0][1] * right[c + 1] +
                         eps[1][1] * right[c + 2] + eps[c][0] * right[4] + eps[c][1] * right[5];
    const double stress = lambda * (eps[0][0] + eps[1][1]) * area[c] +
                          2.0 * mu * (eps[c][0] * area[0] + eps[c][1] * area[1]);
    EXPECT_NEAR(force, -stress, 1e-14);
  }
}

/// A dilatation stretches bonds and turns none; a body of volume V stores (9 lambda + 6 mu) V / 2
/// in space.
TEST(BondEquations, LastRowHoldsTheEnergyOfADilatation) {
  for (const bool bending : {false, true}) {
    const ForceRows rows{3, bending, true};
    ASSERT_EQ(rows.count(), rows.balance() + 1);
    std::vector<double> axial(static_cast<std::size_t>(rows.count())), shear(axial.size());
    rows.axial(2.0, std::array<double, 3>{0.6, 0.0, 0.8}, axial.data());
    if (bending) rows.shear(2.0, std::array<double, 3>{0.6, 0.0, 0.8}, shear.data());
    EXPECT_DOUBLE_EQ(axial.back(), 2.0);
    EXPECT_EQ(shear.back(), 0.0);
  }
  EXPECT_DOUBLE_EQ(dilatation_modulus(3, 0.5, {2.0, 1.0}), 12.0);
}

TEST(BondEquations, CountTheIndependentComponents) {
  EXPECT_EQ((ForceRows{2, false}).count(), 4);
  EXPECT_EQ((ForceRows{3, false}).count(), 10);
  EXPECT_EQ((ForceRows{2, true}).count(), 8);
  EXPECT_EQ((ForceRows{3, true}).count(), 18);
  EXPECT_EQ((ModuliRows{2, false}).count(), 5);
  EXPECT_EQ((ModuliRows{3, false}).count(), 15);
  EXPECT_EQ((ModuliRows{2, true}).moduli(), 6);
  EXPECT_EQ((ModuliRows{3, true}).moduli(), 21);
  for (const int dim : {2, 3}) {
    for (const bool bending : {false, true}) {
      const ModuliRows rows{dim, bending};
      std::vector<double> right(static_cast<std::size_t>(rows.count()) + 1, -7.0);
      rows.right(1.0, {1.0, 1.0}, right.data());
      EXPECT_EQ(right.back(), -7.0);
      EXPECT_NE(right[right.size() - 2], -7.0);
    }
  }
}

}  // namespace
}  // namespace perilink

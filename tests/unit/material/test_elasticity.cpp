#include <gtest/gtest.h>

#include "material/elasticity.hpp"

namespace perilink {
namespace {

TEST(Elasticity, BondsFixPoissonsRatio) {
  EXPECT_DOUBLE_EQ(bond_poissons_ratio(Problem::plane_stress), 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(bond_poissons_ratio(Problem::plane_strain), 0.25);
  EXPECT_DOUBLE_EQ(bond_poissons_ratio(Problem::three_dimensional), 0.25);
}

TEST(Elasticity, ProblemsHaveADimension) {
  EXPECT_EQ(dimension_of(Problem::plane_stress), 2);
  EXPECT_EQ(dimension_of(Problem::plane_strain), 2);
  EXPECT_EQ(dimension_of(Problem::three_dimensional), 3);
}

/// Uniaxial stress E with the lateral strains of Poisson's ratio.
TEST(Elasticity, HookeConstantsGiveHookesLaw) {
  const double e = 30.0, nu = 0.2;
  const HookeConstants space = hooke_constants(Problem::three_dimensional, e, nu);
  EXPECT_NEAR(space.lambda * (1.0 - 2.0 * nu) + 2.0 * space.mu, e, 1e-13);
  EXPECT_NEAR(space.lambda * (1.0 - 2.0 * nu) - 2.0 * space.mu * nu, 0.0, 1e-13);
  const HookeConstants plane = hooke_constants(Problem::plane_stress, e, nu);
  EXPECT_NEAR(plane.lambda * (1.0 - nu) + 2.0 * plane.mu, e, 1e-13);
  EXPECT_NEAR(plane.lambda * (1.0 - nu) - 2.0 * plane.mu * nu, 0.0, 1e-13);
  EXPECT_EQ(hooke_constants(Problem::plane_strain, e, nu).lambda, space.lambda);
}

}  // namespace
}  // namespace perilink

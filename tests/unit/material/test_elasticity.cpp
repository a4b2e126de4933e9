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

}  // namespace
}  // namespace perilink

#include "material/strength/property_field.hpp"

#include <gtest/gtest.h>

#include <span>
#include <vector>

namespace perilink {
namespace {

constexpr double tiny_error = 1e-14;

/// Returns 1 + 2 x + y as a factor.
PropertyField sloping(VaryingProperty property) {
  return {property, {}, {1}, [](std::span<const double> x) { return 1.0 + 2.0 * x[0] + x[1]; }};
}

const std::vector<double> corners = {0.0, 0.0, 1.0, 0.0, 0.0, 2.0};

TEST(PropertyFields, AreTakenInTheMiddleOfPairs) {
  const std::vector<Index> first = {0, 0, 1, 1}, second = {1, 2, 2, 1};
  const std::vector<double> factors =
      factors_between(sloping(VaryingProperty::fracture_energy), corners, 2, first, second);
  const std::vector<double> expected = {2.0, 2.0, 3.0, 3.0};
  ASSERT_EQ(factors.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k)
    EXPECT_NEAR(factors[k], expected[k], tiny_error);
}

TEST(PropertyFields, OfTheModulusAreMultiplied) {
  const std::vector<Index> first = {0, 1}, second = {1, 2};
  const PropertyField slope = sloping(VaryingProperty::youngs_modulus);
  const PropertyField twice = {VaryingProperty::youngs_modulus, {}, {1}, [](auto) { return 2.0; }};
  const std::vector<PropertyField> fields = {slope, sloping(VaryingProperty::tensile_strength),
                                             twice};
  const std::vector<double> factors = modulus_between(fields, corners, 2, first, second);
  ASSERT_EQ(factors.size(), 2u);
  EXPECT_NEAR(factors[0], 4.0, tiny_error);
  EXPECT_NEAR(factors[1], 6.0, tiny_error);
  const std::vector<PropertyField> strength = {sloping(VaryingProperty::tensile_strength)};
  EXPECT_TRUE(modulus_between(strength, corners, 2, first, second).empty());
}

}  // namespace
}  // namespace perilink

#include "app/report/report_fields.hpp"

#include <gtest/gtest.h>

#include "support/cracked_field.hpp"

namespace perilink {
namespace {

VtuGrid grid_of_two() {
  VtuGrid grid;
  grid.points = {0, 0, 0, 1, 0, 0};
  grid.point_data = {{"displacement", 3, {1, 2, 0, 3, 4, 0}},
                     {"damage", 1, {0, 0.5}},
                     {"kind", 1, {0, 0}},
                     {"region", 1, {0, 1}},
                     {"principal_stress", 3, {5, -5, 0, 7, -8, 0}},
                     {"first_principal_direction", 3, {1, 0, 0, 1, 0, 0}},
                     {"stress", 6, {3, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0}},
                     {"velocity", 3, {3, 4, 0, 0, 0, 0}}};
  return grid;
}

TEST(ReportFields, EveryNumberOfAParticleIsOne) {
  const auto fields = fields_of(grid_of_two(), 2);
  std::vector<std::string> names;
  for (const ReportField& field : fields) names.push_back(field.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"displacement x", "displacement y", "damage", "material",
                                      "largest principal stress", "smallest principal stress",
                                      "von Mises stress", "velocity"}));
}

TEST(ReportFields, ValuesAreComponentsLengthsAndVonMises) {
  const VtuGrid grid = grid_of_two();
  const auto fields = fields_of(grid, 2);
  EXPECT_EQ(values_of_field(grid, fields[1]), (std::vector<float>{2, 4}));
  EXPECT_EQ(values_of_field(grid, fields[5]), (std::vector<float>{-5, -8}))
      << "of two in the plane";
  const auto mises = values_of_field(grid, fields[6]);
  EXPECT_FLOAT_EQ(mises[0], 3.0F) << "uniaxial";
  EXPECT_FLOAT_EQ(mises[1], 2.0F * std::sqrt(3.0F)) << "pure shear";
  EXPECT_EQ(values_of_field(grid, fields[7]), (std::vector<float>{5, 0}));
  EXPECT_TRUE(values_of_field(grid, {"", "spin", 0}).empty());
}

TEST(ReportFields, RangesLeaveOutliersOut) {
  std::vector<float> numbers(1000, 1.0F);
  numbers[3] = -100.0F;
  numbers[500] = 900.0F;
  numbers[501] = 2.0F;
  EXPECT_EQ(range_of(numbers).low, -100.0F);
  EXPECT_EQ(range_of(numbers).high, 900.0F);
  EXPECT_EQ(inner_range(numbers, 0.001).low, 1.0F);
  EXPECT_EQ(inner_range(numbers, 0.001).high, 2.0F);
  NumberRange range;
  EXPECT_GT(range.low, range.high) << "empty";
  range.include({0.0F, 0.0F});
  range.include({5.0F, 6.0F});
  EXPECT_EQ(range.low, 0.0F);
  EXPECT_EQ(range.high, 6.0F);
}

}  // namespace
}  // namespace perilink

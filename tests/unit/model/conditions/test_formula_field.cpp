#include "model/conditions/formula_field.hpp"

#include <gtest/gtest.h>

#include "support/strip_case.hpp"

namespace perilink {
namespace {

TEST(PositionField, GivesOneValuePerComponent) {
  const CaseFile input = test::strip_case();
  const std::vector<Expression> components = {Expression("x*y"), Expression(4.0)};
  const PositionField field(input, "loads[1].body_force", components);
  const std::vector<double> position = {2.0, 3.0};
  EXPECT_EQ(field.at(position), (Vector3{6.0, 4.0, 0.0}));
}

TEST(PositionField, RefusesValuesThatAreNotFiniteWithTheirPlace) {
  const CaseFile input = test::strip_case();
  const std::vector<Expression> components = {Expression("1/x")};
  const PositionField field(input, "loads[1].body_force", components);
  const std::vector<double> position = {0.0, 3.0};
  try {
    field.at(position);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.where().key, "loads[1].body_force");
    EXPECT_NE(std::string(error.what()).find("is inf at the position (0, 3)"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace perilink

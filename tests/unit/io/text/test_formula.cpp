#include "io/text/formula.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace perilink {
namespace {

double value(const std::string& text, std::array<double, 3> at = {2.0, 3.0, 5.0}) {
  return Formula(Expression(text), 3).at(at);
}

std::string refusal(const std::string& text, int dim = 3) {
  try {
    const Formula formula(Expression(text), dim);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Formula, FollowsTheRulesOfAlgebra) {
  EXPECT_EQ(value("1 - y^2/4"), 1.0 - 9.0 / 4.0);
  EXPECT_EQ(value("-x^2"), -4.0) << "powers bind before signs";
  EXPECT_EQ(value("2^3^2"), 512.0) << "powers bind to the right";
  EXPECT_EQ(value("x*y + z"), 11.0);
  EXPECT_EQ(value("1.5e-3"), 1.5e-3);
  EXPECT_EQ(value("x < y ? z : 0"), 5.0);
  EXPECT_EQ(value("(x == 2) + (y >= 3) + (z != 5)"), 2.0);
}

TEST(Formula, KnowsFunctionsAndConstants) {
  EXPECT_EQ(value("pi"), std::numbers::pi);
  EXPECT_EQ(value("e"), std::numbers::e);
  EXPECT_DOUBLE_EQ(
      value("sin(pi*x/3) + exp(y) + sqrt(z) + ln(z)"),
      std::sin(std::numbers::pi * 2.0 / 3.0) + std::exp(3.0) + std::sqrt(5.0) + std::log(5.0));
  for (const char* name :
       {"sin",   "cos",   "tan",  "asin", "acos", "atan",  "sinh", "cosh", "tanh", "asinh",
        "acosh", "atanh", "sqrt", "exp",  "ln",   "log10", "log2", "abs",  "sign", "rint"}) {
    EXPECT_EQ(refusal(std::string(name) + "(x)"), "accepted") << name;
  }
  EXPECT_DOUBLE_EQ(value("atan2(y, x) + log10(x) + log2(x)"),
                   std::atan2(3.0, 2.0) + std::log10(2.0) + 1.0);
  EXPECT_EQ(value("sum(x, y, z) + avg(x, z) + rint(2.6) + sign(-x)"), 10.0 + 3.5 + 3.0 - 1.0);
  EXPECT_EQ(value("x < y && y < z || x > z"), 1.0);
  EXPECT_EQ(value("max(x, y) + min(x, z) + abs(-x)"), 7.0);
}

TEST(Formula, OfANumberIsTheNumber) {
  const Formula formula(Expression(0.25), 2);
  const std::array<double, 2> position = {7.0, 8.0};
  EXPECT_EQ(formula.at(position), 0.25);
}

TEST(Formula, IsEvaluatedAgainAtEveryPosition) {
  const Formula formula(Expression("x - y"), 2);
  for (const double x : {1.0, -2.0, 3.5}) {
    const std::array<double, 2> position = {x, 1.0};
    EXPECT_EQ(formula.at(position), x - 1.0);
  }
}

/// Characters are counted from one.
TEST(Formula, SaysWhatIsWrongAndWhere) {
  EXPECT_THAT(refusal("1 + q"), testing::HasSubstr("\"q\" at character 5"));
  EXPECT_THAT(refusal("x + + "), testing::HasSubstr("character"));
  EXPECT_THAT(refusal("(x"), testing::HasSubstr("at character 3"));
  EXPECT_THAT(refusal("x = 3"), testing::HasSubstr("an equals sign at character 3"));
  EXPECT_THAT(refusal("1, 2"), testing::HasSubstr("2 values"));
  EXPECT_THAT(refusal("z", 2), testing::HasSubstr("\"z\" at character 1"));
  EXPECT_NE(refusal("_pi"), "accepted");
  EXPECT_NE(refusal("\"x\""), "accepted");
  EXPECT_NE(refusal("sin()"), "accepted");
  EXPECT_NE(refusal("x y"), "accepted");
}

TEST(Formula, MayLeaveTheNumbers) { EXPECT_TRUE(std::isinf(value("1/x", {0.0, 0.0, 0.0}))); }

TEST(Expression, IsZeroOnlyWhereANumberSaysSo) {
  EXPECT_TRUE(Expression(0.0).is_zero());
  EXPECT_FALSE(Expression("0*x").is_zero());
  EXPECT_TRUE(ExpressionVector().is_zero());
  ExpressionVector vector(Vector3{0.0, 0.0, 0.0});
  EXPECT_TRUE(vector.is_constant());
  vector[1] = Expression("x");
  EXPECT_FALSE(vector.is_constant());
  EXPECT_FALSE(vector.is_zero());
}

}  // namespace
}  // namespace perilink

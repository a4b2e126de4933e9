#include "io/formula.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace perilink {
namespace {

TEST(Formula, IsAFunctionOfThePosition) {
  const Formula formula(Expression("2*x - y^2/4 + sin(pi*z)"), 3);
  const std::vector<double> at = {1.5, 3.0, 0.5};
  EXPECT_DOUBLE_EQ(formula.at(at), 3.0 - 2.25 + 1.0);
}

TEST(Formula, OfANumberIsThatNumberEverywhere) {
  EXPECT_EQ(Formula(Expression(2.5), 2).at(std::vector<double>{7.0, 8.0}), 2.5);
}

TEST(Formula, RefusesWhatIsNoFormulaOfThisDimension) {
  for (const char* text : {"x +", "(x", "x y", "z", "sinus(x)", "x = 3", "x, y"}) {
    EXPECT_THROW(Formula(Expression(std::string(text)), 2), std::invalid_argument) << text;
  }
  EXPECT_NO_THROW(Formula(Expression("z"), 3));
}

TEST(Formula, MayLeaveTheNumbers) {
  EXPECT_TRUE(std::isinf(Formula(Expression("1/x"), 2).at(std::vector<double>{0.0, 0.0})));
}

}  // namespace
}  // namespace perilink

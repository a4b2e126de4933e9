#include "base/lanes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numeric>

namespace perilink {
namespace {

template <class Row>
class LongLanesOf : public testing::Test {};

/// As many numbers as a register holds, and more.
using Rows = testing::Types<LongLanes<float, 16, 16>, LongLanes<float, 16, 8>,
                            LongLanes<float, 16, 4>, LongLanes<double, 16, 2>>;
TYPED_TEST_SUITE(LongLanesOf, Rows);

TYPED_TEST(LongLanesOf, CalculateNumberByNumberWhereverTheyLie) {
  using Number = std::remove_cvref_t<decltype(TypeParam{}[0])>;
  std::array<Number, 40> numbers;
  std::iota(numbers.begin(), numbers.end(), Number{1});
  auto& first = reinterpret_cast<TypeParam&>(numbers[1]);                // 2, 3, ...
  const auto& second = reinterpret_cast<const TypeParam&>(numbers[19]);  // 20, 21, ...
  TypeParam sum = Number{3} * first;
  sum += second;
  const TypeParam difference = second - first;
  first -= second;
  first *= Number{0.5};
  for (std::size_t k = 0; k < 16; ++k) {
    const auto number = static_cast<Number>(k);
    EXPECT_EQ(sum[k], 26 + 4 * number);
    EXPECT_EQ(difference[k], 18);
    EXPECT_EQ(numbers[1 + k], -9);
  }
  EXPECT_EQ(numbers[0], 1);
  EXPECT_EQ(numbers[17], 18);
}

TEST(Lanes, AreAsManyAsARegisterHoldsAndNoMoreThanThereAre) {
  EXPECT_EQ(lanes_of<float>(16) * sizeof(float), std::min<std::size_t>(64, register_bytes));
  EXPECT_EQ(lanes_of<double>(1), 1U);
  EXPECT_EQ(lanes_of<double>(1000) * sizeof(double), register_bytes);
}

}  // namespace
}  // namespace perilink

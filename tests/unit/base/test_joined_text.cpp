#include "base/joined_text.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace perilink {
namespace {

TEST(JoinedText, SeparatesNumbersOfSixDigits) {
  const std::array<double, 3> numbers = {0.1 + 0.2, -1234567.0, 2.0};
  EXPECT_EQ(joined(numbers), "0.3, -1.23457e+06, 2");
}

TEST(JoinedText, SeparatesTexts) {
  EXPECT_EQ(joined(std::vector<std::string>{"a", "b"}), "a, b");
  EXPECT_EQ(joined(std::vector<std::string>{}), "");
}

}  // namespace
}  // namespace perilink

#include "app/plot/color_map.hpp"

#include <gtest/gtest.h>

#include <string>

namespace perilink {
namespace {

double luminance(const std::string& color) {
  const auto part = [&](std::size_t at) { return std::stoi(color.substr(at, 2), nullptr, 16); };
  return 0.2126 * part(1) + 0.7152 * part(3) + 0.0722 * part(5);
}

TEST(ColorMap, DarkensWithDamageAllTheWay) {
  for (int k = 0; k < 50; ++k) {
    EXPECT_GT(luminance(damage_color(k / 50.0)), luminance(damage_color((k + 1) / 50.0))) << k;
  }
}

TEST(ColorMap, KeepsToItsEnds) {
  EXPECT_EQ(damage_color(-1.0), damage_color(0.0));
  EXPECT_EQ(damage_color(2.0), damage_color(1.0));
}

}  // namespace
}  // namespace perilink

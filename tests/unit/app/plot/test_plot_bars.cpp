#include "app/plot/plot_bars.hpp"

#include <gtest/gtest.h>

#include <string>

#include "base/error.hpp"

namespace perilink {
namespace {

CsvTable two_bars() {
  return {{"bar", "distance", "axial_stress", "bond_stress"},
          {{1, 5, 10, -1}, {1, 15, 20, 1}, {2, 5, -30, 0.5}},
          false};
}

int count_of(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST(PlotBars, DrawsBothStressesOfEveryBar) {
  const std::string svg = draw_bars(two_bars(), "bars.csv", "row 7", {"Beam", "N", "mm"}).str();
  EXPECT_EQ(count_of(svg, "<path"), 4);
  for (const char* text : {">Beam<", ">row 7<", ">axial stress (N/mm²)<", ">bond stress (N/mm²)<",
                           ">distance along the bar (mm)<", ">bar<", ">1<", ">2<"}) {
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  }
  EXPECT_EQ(draw_bars(two_bars(), "", "", {"", "", ""}).str().find("N/mm²"), std::string::npos);
}

TEST(PlotBars, BarsBeyondTheColoursAreDashedAndALongLegendIsLeftOut) {
  CsvTable many = two_bars();
  many.rows.clear();
  for (double bar = 1; bar <= 9; ++bar) many.rows.push_back({bar, 1, 2, 3});
  const std::string nine = draw_bars(many, "", "", {"", "", ""}).str();
  EXPECT_NE(nine.find(">9<"), std::string::npos);
  EXPECT_EQ(count_of(nine, "stroke-dasharray"), 9) << "three in both frames and in the legend";
  for (double bar = 10; bar <= 13; ++bar) many.rows.push_back({bar, 1, 2, 3});
  EXPECT_EQ(draw_bars(many, "", "", {"", "", ""}).str().find(">bar<"), std::string::npos);
}

TEST(PlotBars, TablesThatNoRunWritesAreRefused) {
  CsvTable table = two_bars();
  table.rows[0][2] = 1e200;
  EXPECT_THROW(draw_bars(table, "bars.csv", "", {"", "", ""}), FileError);
  table.columns[3] = "bond";
  EXPECT_THROW(draw_bars(table, "bars.csv", "", {"", "", ""}), FileError);
}

}  // namespace
}  // namespace perilink

#include "app/compare/plot_comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pugixml.hpp>
#include <string>

namespace perilink {
namespace {

using testing::HasSubstr;
using testing::Not;

RunResult drawn_result(const std::string& name, const std::string& title, int rows) {
  RunResult result;
  result.name = name;
  result.labels = {title, "kN", "m"};
  result.units = "kN, m";
  for (int k = 1; k <= rows; ++k) {
    StepRecord record;
    record.step = k;
    record.load_factor = record.load = 1.0 + k % 7;
    record.displacement = record.load * (1.0 + 0.01 * k);
    record.strain_energy = 0.5 * record.load * record.displacement;
    record.broken_bonds = k;
    result.records.push_back(record);
  }
  return result;
}

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

TEST(PlotComparison, DrawsBothCurvesWithTheirNames) {
  const std::string svg =
      draw_comparison(drawn_result("coarse", "Beam <1>", 30), drawn_result("fine", "Beam <2>", 30))
          .str();
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(svg.c_str()));
  EXPECT_THAT(svg, HasSubstr("coarse and fine"));
  EXPECT_THAT(svg, HasSubstr("coarse: Beam &lt;1&gt;, peak 7 kN at"));
  EXPECT_THAT(svg, HasSubstr("fine: Beam &lt;2&gt;, peak 7 kN at"));
  EXPECT_THAT(svg, HasSubstr("displacement (m)"));
  // A curve and its sample in the legend.
  EXPECT_EQ(count(svg, "fill=\"none\" stroke=\"#0072b2\" stroke-width=\"2\""), 2);
  EXPECT_EQ(count(svg, "fill=\"none\" stroke=\"#d55e00\" stroke-width=\"2\""), 2);
  EXPECT_THAT(svg, Not(HasSubstr("stroke-opacity=\"0.35\"")));
}

TEST(PlotComparison, ATitleOfBothIsTheHeading) {
  const std::string svg =
      draw_comparison(drawn_result("coarse", "Beam", 30), drawn_result("fine", "Beam", 30)).str();
  EXPECT_EQ(count(svg, "Beam"), 1);
  EXPECT_THAT(svg, HasSubstr("coarse, peak"));
}

TEST(PlotComparison, LongTitlesGiveWay) {
  const std::string title(200, 'x');
  const std::string svg =
      draw_comparison(drawn_result("coarse", title, 30), drawn_result("fine", "Beam", 30)).str();
  EXPECT_EQ(count(svg, title), 0);
  EXPECT_THAT(svg, HasSubstr("coarse, peak"));
}

TEST(PlotComparison, ManyRowsHaveAnEnvelope) {
  const std::string svg =
      draw_comparison(drawn_result("coarse", "a", 300), drawn_result("fine", "b", 30)).str();
  EXPECT_EQ(count(svg, "stroke-opacity=\"0.35\""), 1);
  RunResult over_time = drawn_result("dynamic", "c", 300);
  for (StepRecord& record : over_time.records) record.broken_bonds /= 4;
  EXPECT_EQ(count(draw_comparison(over_time, drawn_result("fine", "b", 30)).str(),
                  "stroke-opacity=\"0.35\""),
            0);
}

TEST(PlotComparison, AxesHaveNoUnitsWhereTheResultsDiffer) {
  RunResult other = drawn_result("fine", "b", 30);
  other.units = "N, mm";
  const std::string svg = draw_comparison(drawn_result("coarse", "a", 30), other).str();
  EXPECT_THAT(svg, HasSubstr(">displacement<"));
  EXPECT_THAT(svg, HasSubstr(">load<"));
}

}  // namespace
}  // namespace perilink

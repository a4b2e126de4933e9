#include "app/plot/plot_convergence.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <regex>

namespace perilink {
namespace {

using testing::HasSubstr;
using testing::Not;

ConvergencePlot sample() {
  ConvergencePlot plot;
  plot.title = "Bar <1>";
  plot.cost_label = "unknowns";
  plot.error_label = "relative error";
  plot.lines = {{"first", {{100, 0.1}, {400, 0.025}, {1600, 0.00625}}, 2.0},
                {"second", {{100, 0.2}, {400, 0.1}}, std::nullopt}};
  return plot;
}

/// Returns the numbers of all attributes of a name, for example "cx" of circles.
std::vector<double> attributes(const std::string& text, const std::string& name) {
  const std::regex pattern(" " + name + "=\"([-0-9.]+)\"");
  std::vector<double> found;
  for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at) {
    found.push_back(std::stod((*at)[1]));
  }
  return found;
}

TEST(PlotConvergence, NamesLinesOrdersAndAxes) {
  const std::string text = draw_convergence(sample()).str();
  for (const char* part :
       {"Bar &lt;1&gt;", "unknowns", "relative error", ">first: order 2.00<", ">second<"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
}

TEST(PlotConvergence, EqualFactorsAreEqualDistances) {
  ConvergencePlot plot = sample();
  plot.lines.resize(1);
  const std::string text = draw_convergence(plot).str();
  // The line's three marks, then the legend's.
  const std::vector<double> x = attributes(text, "cx");
  const std::vector<double> y = attributes(text, "cy");
  ASSERT_EQ(x.size(), 4u);
  EXPECT_NEAR(x[1] - x[0], x[2] - x[1], 0.02);  // on the grid of 1/100 px
  EXPECT_NEAR(y[1] - y[0], y[2] - y[1], 0.02);
  EXPECT_GT(x[1], x[0]);
  EXPECT_GT(y[1], y[0]) << "smaller errors lie lower";
}

TEST(PlotConvergence, PointsThatHaveNoLogarithmAreLeftOut) {
  ConvergencePlot plot = sample();
  plot.lines.resize(1);
  plot.lines[0].points.push_back({6400, 0.0});
  plot.lines[0].points.push_back({0.0, 0.1});
  plot.lines[0].points.push_back({6400, std::nan("")});
  EXPECT_EQ(draw_convergence(plot).str(), [] {
    ConvergencePlot same = sample();
    same.lines.resize(1);
    return draw_convergence(same).str();
  }());
}

TEST(PlotConvergence, NothingToDrawLeavesAxesAndLegend) {
  ConvergencePlot plot = sample();
  for (ConvergenceLine& line : plot.lines) line.points.clear();
  const std::string text = draw_convergence(plot).str();
  EXPECT_THAT(text, HasSubstr(">second<"));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  EXPECT_THAT(text, Not(HasSubstr("inf")));
}

TEST(PlotConvergence, LinesDifferInColourOrDashes) {
  ConvergencePlot plot = sample();
  plot.lines.assign(14, plot.lines[0]);
  const std::string text = draw_convergence(plot).str();
  const std::regex stroke("<path (fill=\"none\" stroke=[^>]*) d=");
  std::map<std::string, int> styles;
  for (std::sregex_iterator at(text.begin(), text.end(), stroke), end; at != end; ++at) {
    ++styles[(*at)[1]];
  }
  EXPECT_EQ(styles.size(), 14u);
  for (const auto& [style, count] : styles) EXPECT_EQ(count, 2) << style << ": line and legend";
}

}  // namespace
}  // namespace perilink

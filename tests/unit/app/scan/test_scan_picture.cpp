#include "app/scan/scan_picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/scan/scan_table.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;
using testing::Not;

std::vector<ScanResult> with_numbers(const std::string& name, const std::vector<double>& values) {
  std::vector<ScanResult> results(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    results[k].status = "completed";
    results[k].numbers = {{name, values[k]}};
  }
  return results;
}

ScanFile scan_with(const std::string& values) {
  return parse_scan("case = \"a.toml\"\ntitle = \"T\"\n[values]\n" + values, "");
}

TEST(ScanPicture, TheFirstKeyIsTheAxisAndOthersGiveLines) {
  const ScanPlot plot = scan_plot(scan_with("a = [2, 1]\nb = [5, 6]\n"),
                                  with_numbers("peak_load", {10, 20, 30, 40}), "kN, m");
  EXPECT_EQ(plot.x_label, "a");
  EXPECT_EQ(plot.y_label, "peak load (kN)");
  ASSERT_EQ(plot.lines.size(), 2u);
  EXPECT_EQ(plot.lines[1].name, "b = 6");
  ASSERT_EQ(plot.lines[1].points.size(), 2u);
  EXPECT_EQ(plot.lines[1].points[0].x, 1.0);
  EXPECT_EQ(plot.lines[1].points[0].y, 40.0);
  EXPECT_EQ(plot.lines[1].points[1].y, 20.0);
}

TEST(ScanPicture, KeysOfWordsGiveLines) {
  const ScanPlot plot = scan_plot(scan_with("a = [\"x\", \"y\"]\nb = [5, 6, 7]\n"),
                                  with_numbers("strain_energy", {1, 2, 3, 4, 5, 6}), "kN, m");
  EXPECT_EQ(plot.x_label, "b");
  EXPECT_EQ(plot.y_label, "strain energy");
  ASSERT_EQ(plot.lines.size(), 2u);
  EXPECT_EQ(plot.lines[0].name, "a = x");
}

TEST(ScanPicture, WithoutNumbersTheMembersAreTheAxis) {
  const ScanPlot plot =
      scan_plot(scan_with("a = [\"x\", \"y\"]\n"), with_numbers("peak_load", {10, 20}), "");
  EXPECT_EQ(plot.x_label, "member");
  ASSERT_EQ(plot.lines.size(), 2u);
  EXPECT_EQ(plot.lines[1].name, "a = y");
  EXPECT_EQ(plot.lines[1].points.at(0).x, 2.0);
  EXPECT_THAT(draw_scan(plot).str(), Not(HasSubstr(">1.5<")));
}

TEST(ScanPicture, LongListsGiveOneLineOverTheMembers) {
  const std::string lists = "a = [[1000000, 2000000, 3000000, 4000000, 5000000], [1, 2]]\n";
  const ScanPlot plot = scan_plot(scan_with(lists), with_numbers("peak_load", {1, 2}), "");
  ASSERT_EQ(plot.lines.size(), 1u);
  EXPECT_EQ(plot.lines[0].name, "");
  EXPECT_EQ(plot.lines[0].points.size(), 2u);
}

TEST(ScanPicture, MembersWithoutResultAreLeftOut) {
  const ScanFile scan = scan_with("a = [1, 2, 3]\n");
  std::vector<ScanResult> results = with_numbers("peak_load", {1, 2, 3});
  results[1] = {};
  EXPECT_EQ(scan_plot(scan, results, "").lines[0].points.size(), 2u);
  const std::string text = draw_scan(scan_plot(scan, results, "")).str();
  EXPECT_THAT(text, HasSubstr(">T<"));
  EXPECT_THAT(text, HasSubstr("peak load"));
  EXPECT_THAT(draw_scan(scan_plot(scan, std::vector<ScanResult>(3), "")).str(),
              Not(HasSubstr("nan")));
}

/// Four values give 1 + log2(4) = 3 bins, here of width 2: [1, 3), [3, 5), [5, 7].
TEST(ScanPicture, SeedsGiveAHistogram) {
  ScanFile scan = parse_scan("case = \"a.toml\"\nseeds = 4\n", "");
  give_seeds(scan, parse_toml("[[random]]\n", ""));
  const ScanPlot plot = scan_plot(scan, with_numbers("peak_load", {1, 2, 4, 7}), "kN, m");
  EXPECT_EQ(plot.x_label, "peak load (kN)");
  EXPECT_EQ(plot.y_label, "members");
  ASSERT_EQ(plot.lines.size(), 1u);
  EXPECT_EQ(plot.lines[0].mean, 3.5);
  std::vector<double> heights;
  for (std::size_t k = 1; k + 1 < plot.lines[0].points.size(); k += 4) {
    EXPECT_EQ(plot.lines[0].points[k - 1].y, 0.0) << "bins have edges";
    EXPECT_EQ(plot.lines[0].points[k].y, plot.lines[0].points[k + 1].y);
    heights.push_back(plot.lines[0].points[k].y);
  }
  EXPECT_THAT(heights, testing::ElementsAre(2.0, 1.0, 1.0));
  EXPECT_EQ(plot.lines[0].points.back().x, 7.0);
  const std::string text = draw_scan(plot).str();
  EXPECT_THAT(text, HasSubstr("4 seeds: mean 3.5, standard deviation 2.646"));
  EXPECT_THAT(text, HasSubstr("fill-opacity"));
  const std::string same =
      draw_scan(scan_plot(scan, with_numbers("peak_load", {5, 5, 5, 5}), "")).str();
  EXPECT_THAT(same, Not(HasSubstr("nan")));
  EXPECT_THAT(draw_scan(scan_plot(scan, std::vector<ScanResult>(4), "")).str(),
              Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace perilink

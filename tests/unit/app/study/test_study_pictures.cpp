#include "app/study/study_pictures.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace perilink {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

StudyMember member(std::size_t series, Index unknowns, double error, double order) {
  StudyMember result;
  result.series = series;
  result.unknowns = unknowns;
  result.errors = {error};
  result.orders = {order};
  result.seconds.set_up = 1.0;
  result.seconds.analysis = 0.5 * unknowns;
  return result;
}

struct Sample {
  StudyFile study = parse_study(
      "title = \"T\"\ncase = \"a.toml\"\n[vary]\nspacing = [2, 1]\n[error]\nquantity = "
      "\"peak_load\"\nreference = \"finest\"\n",
      "study.toml");
  std::vector<StudySeries> series = {{"first", {}}, {"second", {}}};
  std::vector<StudyMember> members = {member(0, 10, 0.4, none), member(0, 20, 0.1, 2.0),
                                      member(0, 40, 0.0, none), member(1, 10, 0.3, none)};
};

TEST(StudyPictures, ALinePerSeriesWithTheFinestOrder) {
  Sample sample;
  sample.members.push_back(member(1, 0, 0.0, none));
  sample.members.back().failure = "no";
  const ConvergencePlot plot =
      study_picture(sample.study, sample.series, sample.members, 0, Cost::unknowns);
  ASSERT_EQ(plot.lines.size(), 2u);
  EXPECT_EQ(plot.lines[0].name, "first");
  ASSERT_EQ(plot.lines[0].points.size(), 3u);
  EXPECT_EQ(plot.lines[0].points[1].cost, 20.0);
  EXPECT_EQ(plot.lines[0].points[1].error, 0.1);
  EXPECT_EQ(plot.lines[0].order, 2.0);
  EXPECT_EQ(plot.lines[1].points.size(), 1u) << "failed members are no points";
  EXPECT_FALSE(plot.lines[1].order.has_value());
  EXPECT_EQ(plot.title, "T");
}

TEST(StudyPictures, SecondsAreThoseOfTheWholeMember) {
  const Sample sample;
  const ConvergencePlot plot =
      study_picture(sample.study, sample.series, sample.members, 0, Cost::seconds);
  EXPECT_EQ(plot.lines[0].points[0].cost, 6.0);
}

}  // namespace
}  // namespace perilink

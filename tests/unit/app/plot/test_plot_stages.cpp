#include "app/plot/plot_stages.hpp"

#include <gtest/gtest.h>

#include <string>

#include "app/plot/plot_curve.hpp"

namespace perilink {
namespace {

StepRecord staged_row(Index stage, double displacement, double load) {
  StepRecord record;
  record.stage = stage;
  record.displacement = displacement;
  record.load = load;
  return record;
}

const std::vector<StepRecord> rows = {staged_row(1, 1.0, 5.0), staged_row(2, 2.0, 8.0),
                                      staged_row(2, 3.0, 4.0), staged_row(3, 0.5, 0.0)};

PlotLabels labels() {
  PlotLabels result{"Beam", "N", "mm"};
  result.stages = {{"weight", "weight"}, {"push", "push"}, {"unload", "push"}};
  return result;
}

TEST(PlotStages, GoOnWhereTheirLoadsWere) {
  const std::vector<StagePath> stages = paths_of_stages(rows, labels());
  ASSERT_EQ(stages.size(), 3U);
  EXPECT_EQ(stages[0].points.size(), 2U);  // from the origin
  EXPECT_EQ(stages[0].points[0].load, 0.0);
  EXPECT_EQ(stages[1].points.size(), 2U) << "other loads have other axes";
  EXPECT_EQ(stages[1].points[0].load, 8.0);
  ASSERT_EQ(stages[2].points.size(), 2U);
  EXPECT_EQ(stages[2].points[0].displacement, 3.0);
  EXPECT_EQ(stages[2].points[0].load, 4.0);
  EXPECT_EQ(stages[2].name, "unload");
}

TEST(PlotStages, HistoriesWithoutThemHaveNone) {
  EXPECT_TRUE(paths_of_stages(std::vector<StepRecord>{staged_row(0, 1.0, 5.0)}, labels()).empty());
}

TEST(PlotStages, ThePictureNamesThemInTheirColours) {
  const std::string svg = draw_load_displacement(rows, labels()).str();
  for (const char* text : {">weight<", ">push<", ">unload<", "#0072b2", "#d55e00", "#009e73"}) {
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  }
  const std::string nameless = draw_load_displacement(rows, {"Beam", "N", "mm"}).str();
  EXPECT_NE(nameless.find(">stage 2<"), std::string::npos);
}

}  // namespace
}  // namespace perilink

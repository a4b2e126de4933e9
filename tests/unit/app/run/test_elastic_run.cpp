// A run with type = "elastic" is made by make_elastic_run().

#include <gtest/gtest.h>

#include "support/strip_case.hpp"
#include "support/whole_run.hpp"

namespace perilink {
namespace {

CaseFile elastic_case(CaseFile input = test::strip_case()) {
  input.analysis.type = AnalysisType::elastic;
  return input;
}

TEST(ElasticRun, IsOneRowAtLoadFactorOne) {
  const test::WholeRun run(elastic_case());
  const CsvTable table = run.history();
  ASSERT_EQ(table.rows.size(), 1u);
  const auto value = [&](const char* name) { return table.rows[0][table.column(name)]; };
  EXPECT_EQ(value("step"), 1.0);
  EXPECT_EQ(value("load_factor"), 1.0);
  EXPECT_EQ(value("load"), 12.0);
  EXPECT_EQ(value("broken_bonds"), 0.0);
  // Clapeyron: half the load times the displacement that is conjugate to it.
  EXPECT_DOUBLE_EQ(0.5 * value("load") * value("displacement"), value("strain_energy"));
  EXPECT_EQ(run.summary.json["status"], "completed");
  EXPECT_EQ(run.summary.json["factorizations"], 1);
  EXPECT_EQ(run.summary.json["initial_stiffness"], value("load") / value("displacement"));
}

TEST(ElasticRun, WritesItsFieldsWithStresses) {
  const test::WholeRun run(elastic_case());
  ASSERT_EQ(run.series().size(), 1u);
  const VtuGrid grid = run.fields(0);
  EXPECT_NE(grid.find_point_data("stress"), nullptr);
  EXPECT_EQ(grid.field("thickness", -1.0), 2.0);
}

TEST(ElasticRun, TimesItsPhases) {
  const test::WholeRun run(elastic_case());
  for (const char* phase : {"calibration", "assembly", "factorization", "solve"}) {
    EXPECT_GT(run.summary.json["seconds"][phase].get<double>(), 0.0) << phase;
  }
}

/// Platens that both move press with the same force, the load of the row.
TEST(ElasticRun, TellsTheForcesOfItsPlaces) {
  CaseFile input = elastic_case();
  input.loads.clear();
  input.supports[0].fix = {true, false, false};
  DisplacementSection platen;
  platen.region = "upper end";
  platen.value[1] = -0.2;
  input.displacements.push_back(platen);
  platen.region = "lower end";
  platen.value[1] = 0.1;
  input.displacements.push_back(platen);
  const test::WholeRun run(input);
  const auto& json = run.summary.json;
  const double load = json["peak_load"];
  EXPECT_NEAR(json["peak_displacement"], 0.3, 1e-12);
  ASSERT_EQ(json["places"].size(), 2u);
  EXPECT_EQ(json["places"][0]["name"], "upper end");
  // Round-off of sums over some hundred bonds.
  EXPECT_NEAR(json["places"][0]["force"][1], -load, 1e-10 * load);
  EXPECT_NEAR(json["places"][1]["force"][1], load, 1e-10 * load);
}

/// The middle of the strip, 40 long, is stretched or sheared.
TEST(ElasticRun, DoubtsStrainsAndRotationsAboveATenth) {
  const auto warnings = [](int axis, double value) {
    CaseFile input = elastic_case();
    input.loads.clear();
    DisplacementSection driven;
    driven.region = "upper end";
    driven.value[0] = driven.value[1] = 0.0;
    driven.value[axis] = value;
    input.displacements.push_back(driven);
    return test::WholeRun(input).summary.json["warnings"];
  };
  for (const int axis : {0, 1}) {
    EXPECT_TRUE(warnings(axis, 2.0).empty());
    const auto found = warnings(axis, 8.0);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NE(found[0].get<std::string>().find("by more than a tenth"), std::string::npos);
  }
}

}  // namespace
}  // namespace perilink

// A run of a lattice is made by make_lattice_run().

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "model/from_case/lattice_case.hpp"
#include "support/program_cases.hpp"
#include "support/whole_run.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;

TEST(LatticeRun, WritesARowOfHistoryForEveryRow) {
  const test::WholeRun run(test::lattice_bar_case());
  const CsvTable table = run.history();
  EXPECT_EQ(static_cast<Index>(table.rows.size()), run.run->files().rows());
  EXPECT_GE(table.rows.size(), 20u);
  EXPECT_EQ(table.rows.back()[0], run.summary.json["steps"]);
  double peak = 0.0;
  const int load = table.column("load");
  for (const auto& row : table.rows) peak = std::max(peak, std::abs(row[load]));
  EXPECT_EQ(std::abs(run.summary.json["peak_load"].get<double>()), peak);
  EXPECT_GT(run.summary.json["peak_displacement"], 0.0);
}

TEST(LatticeRun, WritesFieldsAtTheBeginningAtTheTimesAndAtTheEnd) {
  CaseFile input = parse_case(test::lattice_bar_case(), "");
  input.output.fields_times = {0.5, 0.50001, 1.0};
  const test::WholeRun run(input);
  const ExplicitCase built = build_explicit_case(input);
  const std::vector<PvdEntry> files = run.series();
  ASSERT_EQ(files.size(), 3u) << "two times within one row are one file, and so is the end";
  EXPECT_EQ(files[0].time, 0.0);
  EXPECT_EQ(files[0].file, "fields_000000.vtu");
  EXPECT_NEAR(files[1].time, 0.5, 4.0 * built.options.time_step) << "a row of four steps";
  EXPECT_GE(files[1].time, 0.5 * (1.0 - 1e-9));
  EXPECT_NEAR(files[2].time, 1.0, built.options.time_step);
  for (std::size_t k = 0; k < files.size(); ++k) {
    const VtuGrid grid = run.fields(k);
    EXPECT_EQ(grid.field("time", -1.0), files[k].time);
    EXPECT_EQ(static_cast<Index>(grid.points.size()), 3 * built.model.lattice.particles());
  }
}

TEST(LatticeRun, ReactionsAreGaugesAndEndIt) {
  CaseFile input = parse_case(test::lattice_bar_case(), "");
  GaugeSection pull, hold;
  pull.name = "pull";
  pull.reaction = "upper end";
  hold.name = "hold";
  hold.reaction = "lower end";
  pull.axis = hold.axis = 1;
  input.gauges = {pull, hold};
  const test::WholeRun whole(input);
  const std::vector<double> load = whole.history("load"), held = whole.history("hold");
  const std::vector<double> pulled = whole.history("pull"), reaction = whole.history("reaction");
  for (std::size_t k = 0; k < load.size(); ++k) {
    EXPECT_NEAR(held[k], reaction[k], 1e-12);
    EXPECT_NEAR(pulled[k], load[k], 1e-9);
  }
  input.stop.gauge = "hold";
  input.stop.below = 0.5 * held.back();
  const test::WholeRun run(input);
  EXPECT_EQ(run.summary.json["status"], "completed");
  EXPECT_THAT(run.summary.json["reason"].get<std::string>(), HasSubstr("the gauge \"hold\" is -"));
  EXPECT_LT(run.history("hold").size(), held.size());
}

/// The last state is that of the last row, not of a step after it.
TEST(LatticeRun, TheLastFieldsShowTheDrivenDisplacement) {
  const test::WholeRun run(test::lattice_bar_case());
  double largest = 0.0;
  for (const double u :
       run.fields(run.series().size() - 1).find_point_data("displacement")->values) {
    largest = std::max(largest, u);
  }
  EXPECT_NEAR(largest, 0.02, 1e-12);
}

TEST(LatticeRun, TellsWhatItWas) {
  const test::WholeRun run(test::lattice_bar_case());
  const ExplicitCase built = build_explicit_case(run.input);
  const auto& json = run.summary.json;
  EXPECT_EQ(json["status"], "completed");
  EXPECT_EQ(json["steps"], built.options.steps());
  EXPECT_EQ(json["particles"], built.model.lattice.particles());
  EXPECT_EQ(json["bonds"], built.bonds);
  EXPECT_EQ(json["time_step"], built.options.time_step);
  EXPECT_EQ(json["critical_time_step"], built.critical_time_step);
  EXPECT_FALSE(json.contains("yielded_particles"));
  EXPECT_FALSE(json.contains("fundamental_period")) << "nothing asks for it";
  const double steps = static_cast<double>(built.options.steps()) * built.model.lattice.particles();
  EXPECT_EQ(json["particle_steps_per_second"], 0.5 * steps) << "in two seconds";
  for (const char* part : {"completed", "peak load", "particle-steps/s", "balance error",
                           "cracked particles", "216 particles"}) {
    EXPECT_THAT(run.summary.text, HasSubstr(part));
  }
}

TEST(LatticeRun, TheEnergiesBalance) {
  const test::WholeRun run(test::lattice_bar_case());
  const auto energy = [&](const char* key) { return run.summary.json[key].get<double>(); };
  const double work = energy("external_work");
  EXPECT_GT(work, 0.0);
  EXPECT_NEAR(energy("kinetic_energy") + energy("strain_energy") + energy("damped_energy") +
                  energy("dissipated_energy"),
              work, energy("energy_error") * work * 1.001);
}

TEST(LatticeRun, MeasuresItsGauges) {
  const std::string gauge = "[[gauges]]\nname = \"top\"\nat = [0.5, 2, 0.5]\naxis = \"y\"\n";
  const CsvTable table = test::WholeRun(test::lattice_bar_case() + gauge).history();
  const int top = table.column("top"), driven = table.column("displacement");
  ASSERT_GE(top, 0);
  for (const auto& row : table.rows) EXPECT_NEAR(row[top], row[driven], 1e-15);
}

}  // namespace
}  // namespace perilink

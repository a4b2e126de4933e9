#include "app/run/damage_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <set>

#include "io/fields/vtu.hpp"
#include "support/strip_case.hpp"
#include "support/temporary_directory.hpp"
#include "support/whole_run.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;

/// A run that breaks the elements that a test names, one after another.
class DamageRunTest : public testing::Test, protected StateSource {
 protected:
  DamageRunTest() : input_(test::strip_case()), model_(build_model(input_)) {
    secants_.assign(static_cast<std::size_t>(model_.network.num_elements()), 1.0);
    displacement_.assign(model_.loads.forces.size(), 0.0);
  }
  StepState state() override {
    ++looks_;
    return {model_.network, secants_, displacement_};
  }
  std::unique_ptr<DamageRun> make_run() {
    auto run = std::make_unique<DamageRun>(input_, 1, true);
    run->open(work_.path(), true);
    files_ = &run->files();
    return run;
  }

  /// A row in the present state, at whose load `next` fails.
  void row(DamageRun& observer, Index next) {
    ++record_.step;
    record_.element = next;
    observer.add_row(record_, *this);
  }
  void fail(Index element) {
    secants_[element] = 0.0;
    ++record_.broken_bonds;
  }
  /// Rows of a run by events in which these elements fail, one per row.
  void run(DamageRun& observer, const std::vector<Index>& elements) {
    for (const Index element : elements) {
      row(observer, element);
      fail(element);
    }
    row(observer, 99);
    observer.end(record_, *this);
    files_->finish();
  }
  std::vector<std::string> series() const {
    std::vector<std::string> files;
    for (const PvdEntry& entry : read_pvd((work_ / "fields.pvd").string())) {
      files.push_back(entry.file);
    }
    return files;
  }
  std::set<std::string> field_files() const {
    std::set<std::string> files;
    for (const auto& entry : fs::directory_iterator(work_.path())) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with("fields_")) files.insert(name);
    }
    return files;
  }
  /// Ends of the broken bonds of a field file, in its order.
  std::vector<std::pair<Index, Index>> broken_bonds(const std::string& file) const {
    const VtuGrid grid = read_vtu((work_ / file).string());
    const std::vector<double>& broken_at = grid.find_cell_data("broken_at")->values;
    std::vector<std::pair<Index, Index>> ends;
    for (std::size_t cell = 0; cell < grid.types.size(); ++cell) {
      if (broken_at[cell] == 0.0) continue;
      EXPECT_EQ(broken_at[cell], static_cast<double>(ends.size() + 1));
      const auto end = static_cast<std::size_t>(grid.offsets[cell]);
      ends.emplace_back(grid.connectivity[end - 2], grid.connectivity[end - 1]);
    }
    return ends;
  }
  std::pair<Index, Index> ends_of(Index element) const {
    return {model_.network.bonds.first[element], model_.network.bonds.second[element]};
  }

  test::TemporaryDirectory work_;
  CaseFile input_;
  Model model_;
  std::vector<double> secants_;
  std::vector<double> displacement_;
  StepRecord record_;
  int looks_ = 0;
  RunFiles* files_ = nullptr;
};

TEST_F(DamageRunTest, FieldsAreWrittenAtTheCountsAskedForAndFirstAndLast) {
  input_.output.fields_at = {2, 4, 50};
  const auto observer = make_run();
  run(*observer, {7, 3, 11, 5, 2});
  EXPECT_THAT(series(), ElementsAre("fields_000001.vtu", "fields_000003.vtu", "fields_000005.vtu",
                                    "fields_000006.vtu"));
  const std::vector<std::string> listed = series();
  EXPECT_EQ(field_files(), std::set<std::string>(listed.begin(), listed.end()));
  EXPECT_GT(files_->seconds_writing(), 0.0);
}

TEST_F(DamageRunTest, FieldsAreWrittenAfterEverySoManyBreaks) {
  input_.output.fields_at = {3};
  input_.output.fields_every = 2;
  const auto observer = make_run();
  run(*observer, {7, 3, 11, 5});
  EXPECT_THAT(series(), ElementsAre("fields_000001.vtu", "fields_000003.vtu", "fields_000004.vtu",
                                    "fields_000005.vtu"));
}

TEST_F(DamageRunTest, BrokenBondsKeepTheOrderOfBreaking) {
  const auto observer = make_run();
  run(*observer, {70, 3, 110, 5});
  EXPECT_THAT(broken_bonds("fields_000005.vtu"),
              ElementsAre(ends_of(70), ends_of(3), ends_of(110), ends_of(5)));
  EXPECT_TRUE(broken_bonds("fields_000001.vtu").empty());
}

TEST_F(DamageRunTest, EventsAreFollowedWithoutLookingAtTheBody) {
  const auto observer = make_run();
  run(*observer, {70, 3, 110, 5});
  EXPECT_EQ(looks_, 2) << "the first and the last field file";
}

TEST_F(DamageRunTest, BreaksWithinALoadStepAreOrderedByNumber) {
  input_.analysis.control = LoadControl::steps;
  const auto observer = make_run();
  row(*observer, no_index);
  for (const Index element : {70, 3}) fail(element);
  row(*observer, 3);
  fail(20);
  row(*observer, 20);
  observer->end(record_, *this);
  EXPECT_THAT(broken_bonds("fields_000003.vtu"), ElementsAre(ends_of(3), ends_of(70), ends_of(20)));
}

TEST_F(DamageRunTest, ALoadStepThatPassesACountWritesTheNextOne) {
  input_.analysis.control = LoadControl::steps;
  input_.output.fields_at = {2, 3, 5};
  const auto observer = make_run();
  row(*observer, no_index);
  for (const Index element : {4, 9, 13, 20}) fail(element);
  row(*observer, 20);
  row(*observer, no_index);  // nothing broke
  for (const Index element : {30, 31, 32}) fail(element);
  row(*observer, 32);
  fail(40);
  row(*observer, 40);
  EXPECT_THAT(series(), ElementsAre("fields_000001.vtu", "fields_000002.vtu", "fields_000004.vtu"));
  observer->end(record_, *this);
  EXPECT_EQ(series().back(), "fields_000005.vtu");
}

TEST_F(DamageRunTest, YieldingBreaksNothing) {
  RebarSection bar;
  bar.points = {{22.0, 5.0, 0.0}, {22.0, 75.0, 0.0}};
  bar.bond.type = RebarBond::concrete;
  bar.youngs_modulus = 29000.0;
  bar.area = 3.0;
  bar.yield_strength = 60.0;
  input_.rebar.push_back(bar);
  model_ = build_model(input_);
  secants_.assign(static_cast<std::size_t>(model_.network.num_elements()), 1.0);
  displacement_.assign(model_.loads.forces.size(), 0.0);
  const auto observer = make_run();
  row(*observer, 17);
  fail(17);
  row(*observer, model_.network.first_bar_element + 2);
  ++record_.yield_events;
  row(*observer, 8);
  fail(8);
  row(*observer, 99);
  observer->end(record_, *this);
  EXPECT_THAT(broken_bonds("fields_000004.vtu"), ElementsAre(ends_of(17), ends_of(8)));
}

TEST_F(DamageRunTest, EveryRowGoesToTheHistory) {
  const auto observer = make_run();
  run(*observer, {7, 3, 11});
  const std::vector<StepRecord> rows =
      history_records(read_csv((work_ / "history.csv").string()), "history.csv");
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[2].element, 11);
  EXPECT_EQ(rows[3].broken_bonds, 3);
}

TEST_F(DamageRunTest, ARunWithoutRowsLeavesNoFields) {
  const auto observer = make_run();
  observer->end(record_, *this);
  files_->finish();
  EXPECT_TRUE(field_files().empty());
  EXPECT_FALSE(fs::exists(work_ / "fields.pvd"));
}

constexpr const char* end_and_hold = R"(
[[gauges]]
name = "end"
region = "upper end"
axis = "y"
[[gauges]]
name = "hold"
reaction = "lower end"
axis = "y"
)";

TEST(GaugedDamageRun, ReactionsBalanceTheLoad) {
  const test::WholeRun run(std::string(test::strip_text) + end_and_hold);
  const std::vector<double> hold = run.history("hold"), load = run.history("load");
  for (std::size_t k = 0; k < load.size(); ++k) EXPECT_NEAR(hold[k], -load[k], 1e-9 * load[k]);
}

TEST(GaugedDamageRun, EndsAtTheValueOfAGauge) {
  CaseFile input = parse_case(std::string(test::strip_text) + end_and_hold, "");
  const std::vector<double> whole = test::WholeRun(input).history("end");
  input.stop.gauge = "end";
  const std::size_t row = whole.size() / 2;
  const double largest = *std::max_element(whole.begin(), whole.begin() + row);
  input.stop.above = largest + 1e-9;
  const auto expected = std::find_if(whole.begin(), whole.end(),
                                     [&](double value) { return value >= *input.stop.above; });
  ASSERT_NE(expected, whole.end());
  const test::WholeRun run(input);
  EXPECT_EQ(run.history("end"), std::vector<double>(whole.begin(), expected + 1));
  EXPECT_EQ(run.summary.json["status"], "completed");
  EXPECT_THAT(run.summary.json["reason"].get<std::string>(),
              testing::StartsWith("the gauge \"end\" is "));
}

TEST(GaugedDamageRun, AStageEndsAtTheValueOfAGauge) {
  const test::WholeRun run(std::string(test::strip_text) + end_and_hold + R"(
[[stages]]
name = "pull"
gauge = "hold"
below = -0.1
[[stages]]
name = "unload"
loads = "pull"
to = 0
)");
  EXPECT_EQ(run.history("stage").back(), 2.0);
  EXPECT_THAT(run.summary.json["stages"][0]["reason"].get<std::string>(),
              testing::StartsWith("the gauge \"hold\" is -"));
}

/// The strip pulled by events, unloaded, and pulled again; a gauge follows its upper end.
TEST(StagedDamageRun, WritesColumnsGaugesAndStages) {
  const test::WholeRun run(std::string(test::strip_text) + R"(
[[gauges]]
name = "end"
region = "upper end"
axis = "y"

[[stages]]
name = "pull"
broken_bonds = 3

[[stages]]
name = "unload"
loads = "pull"
to = 0

[[stages]]
name = "again"
loads = "pull"
broken_bonds = 5
)");
  const CsvTable history = run.history();
  const auto stage = static_cast<std::size_t>(history.column("stage"));
  const auto gauge = static_cast<std::size_t>(history.column("end"));
  const auto displacement = static_cast<std::size_t>(history.column("displacement"));
  ASSERT_GT(history.rows.size(), 6u);
  for (const std::vector<double>& row : history.rows) {
    // One place is loaded, and shares its force by volume: its mean deflection, to round-off.
    EXPECT_NEAR(row[gauge], row[displacement], 1e-9);
  }
  EXPECT_EQ(history.rows.back()[stage], 3.0);
  const auto& stages = run.summary.json["stages"];
  ASSERT_EQ(stages.size(), 3u);
  EXPECT_EQ(stages[0]["name"], "pull");
  EXPECT_EQ(stages[0]["status"], "completed");
  EXPECT_EQ(stages[1]["load_factor"], 0.0);
  EXPECT_EQ(stages[2]["reason"], "5 bonds are broken");
  EXPECT_FALSE(run.summary.json.contains("smoothed_peak_load"));
}

}  // namespace
}  // namespace perilink

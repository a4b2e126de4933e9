#include "app/run/run_files.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "base/error.hpp"
#include "support/cracked_field.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

CaseFile case_of(AnalysisType type) {
  CaseFile input;
  input.analysis.type = type;
  input.output.fields_times = {2.0, 2.5};
  return input;
}

/// Times of the rows whose fields are due, of rows at whole times.
std::vector<double> due_times(const CaseFile& input) {
  const test::TemporaryDirectory work;
  RunFiles files(input, work.path(), true);
  std::vector<double> due;
  ExplicitRecord record;
  for (; record.time < 5.0; record.time += 1.0) {
    files.add_row(record, {});
    if (files.fields_are_due(record.time)) due.push_back(record.time);
  }
  EXPECT_EQ(files.rows(), 5);
  return due;
}

TEST(RunFiles, FieldsAreDueAtTheFirstRowAndTheTimesOfTheCase) {
  EXPECT_EQ(due_times(case_of(AnalysisType::explicit_)), (std::vector<double>{0.0, 2.0, 3.0}));
  EXPECT_EQ(due_times(case_of(AnalysisType::relaxation)),
            (std::vector<double>{0.0, 1.0, 2.0, 3.0, 4.0}));
}

TEST(RunFiles, FieldsAreDueWhereAValueIsFirstReached) {
  CaseFile input;
  input.output.fields_at_displacement = {1.0, 3.0};
  input.gauges.resize(2);
  input.gauges[0].name = "opening";
  input.gauges[1].name = "side";
  input.gauges[1].fields_at = {-0.5, 0.25};
  const test::TemporaryDirectory work;
  std::optional<RunFiles> files(std::in_place, input, work.path(), true);
  struct Row {
    double displacement, side;
    bool due;
  };
  // Displacements count by size; gauges by their sign; what was reached before counts no more.
  for (const Row& row :
       {Row{0.5, 0.0, false}, Row{-1.0, 0.1, true}, Row{0.9, 0.2, false}, Row{1.5, -0.6, true},
        Row{1.2, 0.25, true}, Row{2.0, -0.7, false}, Row{4.0, 0.3, true}, Row{4.0, 0.3, false}}) {
    const RunFiles::State saved = files->save();
    files.reset();
    files.emplace(input, work.path(), true, saved);
    StepRecord record;
    record.displacement = row.displacement;
    files->add_row(record, std::vector<double>{9.0, row.side});
    EXPECT_EQ(files->reaches_value(), row.due) << row.displacement << " " << row.side;
  }
}

TEST(RunFiles, AStateIsWrittenOnce) {
  const test::TemporaryDirectory work;
  const CaseFile input = case_of(AnalysisType::explicit_);
  RunFiles files(input, work.path(), true);
  EXPECT_FALSE(files.has_fields());
  int made = 0;
  for (const Index step : {7, 7, 9}) {
    files.write_fields(step, 0.5 * step, [&] {
      ++made;
      return test::make_cracked_field({}, true);
    });
  }
  EXPECT_EQ(made, 2);
  EXPECT_TRUE(files.has_fields());
  const std::vector<PvdEntry> series = read_pvd((work / "fields.pvd").string());
  ASSERT_EQ(series.size(), 2u);
  EXPECT_EQ(series[1].file, "fields_000009.vtu");
  EXPECT_EQ(series[1].time, 4.5);
  EXPECT_GT(files.seconds_writing(), 0.0);
}

/// Loads of explicit runs vibrate: one row below half of the peak is not failure.
TEST(RunFiles, BeginAgainWithoutFormerRowsAndFields) {
  const test::TemporaryDirectory work;
  const CaseFile input = case_of(AnalysisType::explicit_);
  RunFiles files(input, work.path(), true);
  files.add_row(ExplicitRecord{}, {});
  files.write_fields(7, 0.5, [] { return test::make_cracked_field({}, true); });
  files.begin_again();
  EXPECT_EQ(files.rows(), 0);
  EXPECT_FALSE(files.has_fields());
  EXPECT_FALSE(std::filesystem::exists(work / "fields_000007.vtu"));
  EXPECT_FALSE(std::filesystem::exists(work / "fields.pvd"));
  files.add_row(ExplicitRecord{}, {});
  files.finish();
  const std::string text = test::read_text(work / "history.csv");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2) << text;
}

TEST(RunFiles, FollowThePeaksOfRunsOverTime) {
  const test::TemporaryDirectory work;
  for (const AnalysisType type : {AnalysisType::explicit_, AnalysisType::relaxation}) {
    const CaseFile input = case_of(type);
    RunFiles files(input, work.path(), true);
    ExplicitRecord record;
    record.broken_bonds = 1;
    for (const double load : {10.0, 1.0, 12.0}) {
      ++record.step;
      record.displacement += 1.0;
      record.load = load;
      files.add_row(record, {});
    }
    EXPECT_EQ(files.peaks().highest().load, 12.0);
    EXPECT_EQ(files.peaks().gave_way(), input.analysis.type == AnalysisType::relaxation);
  }
}

TEST(RunFiles, ADirectoryThatIsNotThereIsRefused) {
  const CaseFile input;
  EXPECT_THROW(RunFiles(input, "/no/such/folder", true), FileError);
}

TEST(RunFiles, CountWhatTheBodyHasOf) {
  ExplicitRecord record;
  record.broken_bonds = 3;
  record.cracked_particles = 4;
  CaseFile input;
  EXPECT_EQ(cracks_text(input, record), "3 broken bonds");
  input.body.model = BodyModel::lattice;
  EXPECT_EQ(cracks_text(input, record), "4 cracked particles");
}

}  // namespace
}  // namespace perilink

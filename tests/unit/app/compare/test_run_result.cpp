#include "app/compare/run_result.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "support/cracked_field.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string history = "step,load,displacement,kinetic_energy\n1,3,0.1,0\n2,2,0.3,0.25\n";

class RunResults : public testing::Test {
 protected:
  RunResults() { fs::create_directories(place()); }
  fs::path place() const { return directory_ / "beam"; }
  void write(const std::string& name, const std::string& text) const {
    test::write_text(place() / name, text);
  }
  RunResult read() const { return read_run_result(place().string()); }
  std::string refusal() const {
    try {
      read();
    } catch (const FileError& error) {
      return error.what();
    }
    return "accepted";
  }

  test::TemporaryDirectory directory_;
};

TEST_F(RunResults, IsReadAsARunLeavesIt) {
  write("history.csv", history);
  write("summary.json", R"({"title": "Beam", "units": "kN, m", "status": "completed",
                            "horizon": 7, "seconds": {"analysis": 1.5}})");
  write_vtu((place() / "last.vtu").string(), test::make_cracked_field({}, true));
  write_pvd((place() / "fields.pvd").string(), {{0.0, "missing.vtu"}, {4.0, "last.vtu"}});
  const RunResult result = read();
  EXPECT_EQ(result.name, "beam");
  EXPECT_EQ(result.labels.title, "Beam");
  EXPECT_EQ(result.units, "kN, m");
  EXPECT_EQ(result.status, "completed");
  EXPECT_FALSE(read_run_numbers(place().string()).body.has_value());
  ASSERT_EQ(result.records.size(), 2u);
  EXPECT_EQ(result.records[1].displacement, 0.3);
  EXPECT_EQ(number_of(result.last_row, "kinetic_energy"), 0.25);
  EXPECT_TRUE(std::isnan(number_of(result.last_row, "damped_energy")));
  EXPECT_EQ(number_of(result.summary, "seconds.analysis"), 1.5);
  EXPECT_EQ(result.horizon, 7.0);
  EXPECT_TRUE(result.notes.empty());

  // 25 by 8 particles without the ghosts and the bar; two columns of four are cracked, each of 2 x
  // 2 since the file gives no volumes.
  ASSERT_TRUE(result.body.has_value());
  EXPECT_EQ(result.body->damage.size(), 200u);
  EXPECT_EQ(result.body->positions.size(), 400u);
  EXPECT_EQ(crack_overlap(*result.body, *result.body, 7.0).volume_a, 32.0);
}

TEST_F(RunResults, ColumnsThatNoRunHasAreGauges) {
  write("history.csv", "step,time,load,displacement,tip\n1,0,3,0.1,7\n2,1,2,0.3,8\n");
  const RunResult result = read();
  EXPECT_EQ(result.gauges, (NamedNumbers{{"tip", 8.0}}));
  EXPECT_EQ(result.gauges_at_peak, (NamedNumbers{{"tip", 7.0}}));
}

TEST_F(RunResults, VolumesAreThoseOfTheFile) {
  write("history.csv", history);
  VtuGrid grid = test::make_cracked_field({}, false);
  grid.point_data.push_back({"volume", 1, std::vector<double>(200, 0.5)});
  write_vtu((place() / "last.vtu").string(), grid);
  write_pvd((place() / "fields.pvd").string(), {{4.0, "last.vtu"}});
  EXPECT_EQ(read().body->volumes, std::vector<double>(200, 0.5));
}

TEST_F(RunResults, AKilledRunIsReadWithANote) {
  write("history.csv", history + "3,1.5,0.");
  write_vtu((place() / "last.vtu").string(), test::make_cracked_field({}, false));
  write_pvd((place() / "fields.pvd").string(), {{4.0, "last.vtu"}});
  const RunResult result = read();
  EXPECT_EQ(result.records.size(), 2u);
  EXPECT_EQ(result.horizon, 4.0) << "twice the spacing: the broken bonds are one long";
  ASSERT_EQ(result.notes.size(), 2u);
  EXPECT_THAT(result.notes[0], HasSubstr("ends within a row"));
  EXPECT_THAT(result.notes[1], HasSubstr("summary.json"));
  write("summary.json", R"({"status": "running"})");
  EXPECT_THAT(read().notes.at(1), HasSubstr("unfinished or killed"));
}

TEST_F(RunResults, DamagedFilesAreRefused) {
  for (const char* row : {"3,inf,1,0\n", "3,1,nan,0\n", "3,1,,0\n", "3,1,1\n", "1,1,1,1\n"}) {
    write("history.csv", history + row);
    EXPECT_THAT(refusal(), HasSubstr("history.csv:")) << row;
  }
  write("history.csv", history);
  for (const char* summary : {"", "{", "[]", R"({"title": 7})", R"({"status": [1]})"}) {
    write("summary.json", summary);
    EXPECT_THAT(refusal(), HasSubstr("the file is damaged")) << summary;
  }
}

TEST_F(RunResults, WithoutAHorizonTheLongestBrokenBondStandsForIt) {
  write("history.csv", history);
  VtuGrid grid = test::make_cracked_field({}, false);
  test::append_line(grid, 0, 3, 1.0);
  write_vtu((place() / "last.vtu").string(), grid);
  write_pvd((place() / "fields.pvd").string(), {{4.0, "last.vtu"}});
  EXPECT_EQ(read().horizon, 6.0) << "three spacings";
}

TEST_F(RunResults, AnInterruptedRunIsReadWithItsReasonAndDoubts) {
  write("history.csv", history);
  write("summary.json", R"({"status": "interrupted", "reason": "a signal came",
                            "warnings": ["the peak is borne by what is crushed"]})");
  const RunResult result = read();
  ASSERT_EQ(result.notes.size(), 3u);
  EXPECT_THAT(result.notes[0], HasSubstr("interrupted (a signal came)"));
  EXPECT_EQ(result.notes[1], "warning: the peak is borne by what is crushed");
  EXPECT_THAT(result.notes[2], HasSubstr("no field file"));
}

TEST_F(RunResults, WhatIsNoResultIsRefused) {
  EXPECT_THAT(refusal(), HasSubstr("it has no history.csv (perilink run"));
  write("study.toml", "");
  EXPECT_THAT(refusal(), HasSubstr("perilink converge"));
  write("history.csv", "step,load\n1,2\n");
  EXPECT_THAT(refusal(), HasSubstr("no column 'displacement'"));
  write("history.csv", "step,load,displacement\n");
  EXPECT_THAT(refusal(), HasSubstr("has no row"));
  fs::remove_all(place());
  EXPECT_THAT(refusal(), HasSubstr("there is no such directory"));
  test::write_text(place(), "");
  EXPECT_THAT(refusal(), HasSubstr("is not a directory"));
}

}  // namespace
}  // namespace perilink

#include "results/history_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

class HistoryFileTest : public ::testing::Test {
 protected:
  test::TemporaryDirectory temporary_;
  std::string directory_ = temporary_.path().string();
};

std::vector<StepRecord> read_history(const std::string& path) {
  return history_records(read_csv(path), path);
}

StepRecord make_record() {
  StepRecord record;
  record.step = 3;
  record.broken_bonds = 2;
  record.yield_events = 1;
  record.load_factor = 1.0 / 3.0;
  record.load = 100000.0;
  record.displacement = 0.1;
  record.strain_energy = 4.0;
  record.dissipated_energy = 5.0;
  record.external_work = 9.0;
  record.released_energy = 5.5;
  record.residual = 1e-13;
  record.factorizations = 2;
  record.element = 17;
  record.seconds = 0.25;
  return record;
}

ExplicitRecord moving_record() {
  ExplicitRecord record;
  record.step = 200;
  record.time = 0.125;
  record.load_factor = 1.0 / 3.0;
  record.load = 60e3;
  record.support_reaction = -59e3;
  record.displacement = 1e-4;
  record.cracked_particles = 12;
  record.energy = {1.0, 2.0, 3.0, 4.0, 5.0, 15.5};
  return record;
}

TEST_F(HistoryFileTest, RecordsComeBackWithoutTheClock) {
  {
    HistoryFile file(directory_, {});
    file.append(make_record());
  }
  const std::vector<StepRecord> back = read_history(directory_ + "/history.csv");
  ASSERT_EQ(back.size(), 1u);
  const StepRecord expected = make_record();
  EXPECT_EQ(back[0].step, expected.step);
  EXPECT_EQ(back[0].broken_bonds, expected.broken_bonds);
  EXPECT_EQ(back[0].yield_events, expected.yield_events);
  EXPECT_EQ(back[0].load_factor, expected.load_factor);
  EXPECT_EQ(back[0].load, expected.load);
  EXPECT_EQ(back[0].displacement, expected.displacement);
  EXPECT_EQ(back[0].strain_energy, expected.strain_energy);
  EXPECT_EQ(back[0].dissipated_energy, expected.dissipated_energy);
  EXPECT_EQ(back[0].external_work, expected.external_work);
  EXPECT_EQ(back[0].released_energy, expected.released_energy);
  EXPECT_EQ(back[0].residual, expected.residual);
  EXPECT_EQ(back[0].factorizations, expected.factorizations);
  EXPECT_EQ(back[0].element, expected.element);
  EXPECT_EQ(back[0].seconds, 0.0);  // the clock goes to timing.csv
  const CsvTable timing = read_csv(directory_ + "/timing.csv");
  EXPECT_EQ(timing.rows, (std::vector<std::vector<double>>{{3.0, 0.25}}));
}

TEST_F(HistoryFileTest, ColumnsAreTheAgreedOnes) {
  { HistoryFile file(directory_, {}); }
  EXPECT_EQ(read_csv(directory_ + "/history.csv").columns,
            (std::vector<std::string>{"step", "broken_bonds", "load_factor", "load", "displacement",
                                      "strain_energy", "dissipated_energy", "external_work",
                                      "released_energy", "yield_events", "residual",
                                      "factorizations", "element"}));
}

TEST_F(HistoryFileTest, GaugesAreFurtherColumns) {
  {
    CaseFile input;
    input.gauges.resize(2);
    input.gauges[0].name = "mouth";
    input.gauges[1].name = "top";
    HistoryFile file(directory_, input);
    const std::vector<double> values = {0.1, -2.0};
    file.append(make_record(), values);
  }
  const CsvTable table = read_csv(directory_ + "/history.csv");
  ASSERT_EQ(table.columns.size(), history_columns({}).size() + 2);
  EXPECT_EQ(table.columns.back(), "top");
  EXPECT_EQ(table.rows[0][table.column("mouth")], 0.1);
  EXPECT_EQ(table.rows[0][table.column("top")], -2.0);
  EXPECT_EQ(read_history(directory_ + "/history.csv")[0].load, 100000.0);
}

TEST_F(HistoryFileTest, RunsOverTimeHaveTheirOwnColumns) {
  CaseFile input;
  input.analysis.type = AnalysisType::explicit_;
  input.body.model = BodyModel::lattice;
  {
    HistoryFile file(directory_, input);
    file.append(moving_record());
  }
  const CsvTable table = read_csv(directory_ + "/history.csv");
  EXPECT_EQ(table.columns, history_columns(input));
  EXPECT_EQ(table.columns, (std::vector<std::string>{
                               "step", "time", "load_factor", "load", "reaction", "displacement",
                               "cracked_particles", "kinetic_energy", "strain_energy",
                               "damped_energy", "dissipated_energy", "external_work"}));
  EXPECT_EQ(table.rows, (std::vector<std::vector<double>>{{200.0, 0.125, 1.0 / 3.0, 60e3, -59e3,
                                                           1e-4, 12.0, 1.0, 2.0, 7.0, 5.0, 15.5}}));
  const CsvTable timing = read_csv(directory_ + "/timing.csv");
  EXPECT_EQ(timing.columns, (std::vector<std::string>{"step", "seconds"}));
  ASSERT_EQ(timing.rows.size(), 1u);
  EXPECT_EQ(timing.rows[0][0], 200.0);
  EXPECT_GE(timing.rows[0][1], 0.0);
  input.body.model = BodyModel::bond_based;
  for (const AnalysisType type : {AnalysisType::explicit_, AnalysisType::relaxation}) {
    input.analysis.type = type;
    EXPECT_EQ(history_columns(input)[6], "broken_bonds") << "bonds break, and not particles";
  }
}

TEST_F(HistoryFileTest, FlushedRowsAreInTheFile) {
  HistoryFile file(directory_, {});
  file.append(make_record());
  file.finish();
  EXPECT_EQ(read_history(directory_ + "/history.csv").size(), 1u);
}

TEST_F(HistoryFileTest, NumbersThatNoRunWritesAreRefused) {
  const std::string path = directory_ + "/other.csv";
  for (const char* rows : {"1.5,1,2\n", "-7,1,2\n", "1e300,1,2\n", "2,1,2\n2,1,2\n",
                           "3,1,2\n1,1,2\n", "1,1e300,2\n"}) {
    std::ofstream(path) << "step,displacement,load\n" << rows;
    EXPECT_THROW(read_history(path), FileError) << rows;
  }
  std::ofstream(path) << "displacement,broken_bonds,load\n1,0,2\n1,3,2\n";
  EXPECT_EQ(read_history(path).at(1).broken_bonds, 3) << "columns in any order";
}

TEST_F(HistoryFileTest, TablesWithoutLoadAreRefused) {
  const std::string path = directory_ + "/other.csv";
  std::ofstream(path) << "step,displacement\n1,2\n";
  EXPECT_THROW(read_history(path), FileError);
  EXPECT_THROW(HistoryFile("/no/such/folder", {}), FileError);
}

TEST_F(HistoryFileTest, StagesHaveColumns) {
  StepRecord record = make_record();
  record.stage = 2;
  record.at_constant_load = 1;
  record.side_change = 1;
  {
    CaseFile input;
    input.stages.resize(2);
    HistoryFile file(directory_, input);
    file.append(record);
  }
  const CsvTable table = read_csv(directory_ + "/history.csv");
  ASSERT_EQ(table.columns.size(), 16u);
  EXPECT_EQ(table.columns[13], "stage");
  EXPECT_EQ(table.columns[14], "avalanche");
  const StepRecord back = read_history(directory_ + "/history.csv").at(0);
  EXPECT_EQ(back.stage, 2);
  EXPECT_EQ(back.at_constant_load, 1);
  EXPECT_EQ(back.side_change, 1);
}

}  // namespace
}  // namespace perilink

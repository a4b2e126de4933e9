#include "app/results/explicit_history.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/error.hpp"
#include "io/text/csv.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

ExplicitRecord make_record() {
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

TEST(ExplicitHistory, WritesEveryColumnOfARow) {
  const test::TemporaryDirectory work;
  {
    ExplicitHistory history(work.path().string(), CrackCount::cracked_particles);
    history.append(make_record());
  }
  const CsvTable table = read_csv((work / "history.csv").string());
  EXPECT_EQ(table.columns, explicit_history_columns(CrackCount::cracked_particles));
  EXPECT_EQ(table.columns, (std::vector<std::string>{
                               "step", "time", "load_factor", "load", "reaction", "displacement",
                               "cracked_particles", "kinetic_energy", "strain_energy",
                               "damped_energy", "dissipated_energy", "external_work"}));
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0], (std::vector<double>{200.0, 0.125, 1.0 / 3.0, 60e3, -59e3, 1e-4, 12.0,
                                                1.0, 2.0, 7.0, 5.0, 15.5}));
}

TEST(ExplicitHistory, KeepsTheClockInAFileOfItsOwn) {
  const test::TemporaryDirectory work;
  ExplicitHistory history(work.path().string(), CrackCount::cracked_particles);
  history.append(make_record());
  history.finish();
  const CsvTable timing = read_csv((work / "timing.csv").string());
  EXPECT_EQ(timing.columns, (std::vector<std::string>{"step", "seconds"}));
  ASSERT_EQ(timing.rows.size(), 1u);
  EXPECT_EQ(timing.rows[0][0], 200.0);
  EXPECT_GE(timing.rows[0][1], 0.0);
}

TEST(ExplicitHistory, OfADirectoryThatIsNotThereIsRefused) {
  const test::TemporaryDirectory work;
  EXPECT_THROW(ExplicitHistory((work / "nowhere").string(), CrackCount::broken_bonds), FileError);
}

}  // namespace
}  // namespace perilink

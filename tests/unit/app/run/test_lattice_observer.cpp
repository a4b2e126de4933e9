#include "app/run/lattice_observer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "io/fields/vtu.hpp"
#include "io/text/csv.hpp"
#include "support/program_cases.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

class ExplicitObserverTest : public testing::Test {
 protected:
  ExplicitObserverTest()
      : input_(parse_case(test::lattice_bar_case(), "")), built_(build_explicit_case(input_)) {}

  /// Runs the case to its end.
  void run(ExplicitRunObserver& observer) {
    ExplicitState state(built_.model);
    run_explicit_analysis(built_.model, state, built_.options, observer);
    observer.finish();
  }
  std::vector<PvdEntry> series() const { return read_pvd((work_ / "fields.pvd").string()); }

  test::TemporaryDirectory work_;
  CaseFile input_;
  ExplicitCase built_;
};

TEST_F(ExplicitObserverTest, WritesARowOfHistoryForEveryRow) {
  ExplicitRunObserver observer(input_, built_, work_.path(), true);
  run(observer);
  const CsvTable table = read_csv((work_ / "history.csv").string());
  EXPECT_EQ(static_cast<Index>(table.rows.size()), observer.rows());
  EXPECT_GE(observer.rows(), 20);
  EXPECT_EQ(table.rows.back()[0], built_.steps);
  double peak = 0.0;
  const int load = table.column("load");
  for (const auto& row : table.rows) peak = std::max(peak, std::abs(row[load]));
  EXPECT_EQ(std::abs(observer.peaks().highest().load), peak);
  EXPECT_GT(observer.peaks().highest().displacement, 0.0);
}

TEST_F(ExplicitObserverTest, WritesFieldsAtTheBeginningAtTheTimesAndAtTheEnd) {
  input_.output.fields_times = {0.5, 0.50001, 1.0};
  ExplicitRunObserver observer(input_, built_, work_.path(), true);
  run(observer);
  const std::vector<PvdEntry> files = series();
  ASSERT_EQ(files.size(), 3u) << "two times within one row are one file, and so is the end";
  EXPECT_EQ(files[0].time, 0.0);
  EXPECT_EQ(files[0].file, "fields_000000.vtu");
  EXPECT_NEAR(files[1].time, 0.5, 4.0 * built_.time_step) << "a row of four steps";
  EXPECT_GE(files[1].time, 0.5 * (1.0 - 1e-9));
  EXPECT_NEAR(files[2].time, 1.0, built_.time_step);
  for (const PvdEntry& entry : files) {
    const VtuGrid grid = read_vtu((work_ / entry.file).string());
    EXPECT_EQ(grid.field("time", -1.0), entry.time);
    EXPECT_EQ(static_cast<Index>(grid.points.size()), 3 * built_.model.lattice.particles());
  }
}

/// The last state is that of the last row, not of a step after it.
TEST_F(ExplicitObserverTest, TheLastFieldsShowTheDrivenDisplacement) {
  ExplicitRunObserver observer(input_, built_, work_.path(), true);
  run(observer);
  const VtuGrid grid = read_vtu((work_ / series().back().file).string());
  double largest = 0.0;
  for (const double u : grid.find_point_data("displacement")->values) {
    largest = std::max(largest, u);
  }
  EXPECT_NEAR(largest, 0.02, 1e-12);
}

}  // namespace
}  // namespace perilink

#include "results/history_columns.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace perilink {
namespace {

TEST(HistoryColumns, AreFoundByTheirNames) {
  ASSERT_NE(find_history_column("freed_energy"), nullptr);
  EXPECT_STREQ(find_history_column("freed_energy")->unit, "F L");
  ASSERT_NE(find_history_column("kinetic_energy"), nullptr) << "of histories over time";
  EXPECT_TRUE(find_history_column("kinetic_energy")->begins_at_zero);
  EXPECT_FALSE(find_history_column("residual")->begins_at_zero);
  EXPECT_EQ(find_history_column("deflection"), nullptr) << "a gauge";
}

/// Columns of both kinds of histories have one unit, as reports show them together.
TEST(HistoryColumns, OfOneNameHaveOneUnit) {
  for (const HistoryColumn& column : columns_of(ExplicitRecord{})) {
    EXPECT_STREQ(find_history_column(column.name)->unit, column.unit) << column.name;
    EXPECT_EQ(find_history_column(column.name)->begins_at_zero, column.begins_at_zero)
        << column.name;
  }
}

TEST(HistoryColumns, ReadWhatTheyWrite) {
  std::set<std::string> names;
  for (const RowColumn<StepRecord>& column : columns_of(StepRecord{})) {
    EXPECT_TRUE(names.insert(column.name).second) << column.name;
    StepRecord row;
    column.set(row, 7.0);
    EXPECT_EQ(column.get(row), 7.0) << column.name;
    EXPECT_EQ(column.counts, [&] {
      column.set(row, 1.5);
      return column.get(row) == 1.0;
    }()) << column.name;
  }
}

}  // namespace
}  // namespace perilink

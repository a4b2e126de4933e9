#include "app/progress.hpp"

#include <gtest/gtest.h>

namespace perilink {
namespace {

TEST(Progress, DurationsAreRoundedBeforeTheyAreSplit) {
  EXPECT_EQ(format_duration(-1.0), "0 s");
  EXPECT_EQ(format_duration(0.0), "0 s");
  EXPECT_EQ(format_duration(3.4), "3 s");
  EXPECT_EQ(format_duration(59.4), "59 s");
  EXPECT_EQ(format_duration(59.6), "1 min 00 s");
  EXPECT_EQ(format_duration(130.0), "2 min 10 s");
  EXPECT_EQ(format_duration(3599.6), "1 h 00 min");
  EXPECT_EQ(format_duration(3900.0), "1 h 05 min");
  EXPECT_EQ(format_duration(100.0 * 3600.0), "100 h 00 min");
}

TEST(Progress, SaysNothingInItsFirstSecondsNorWhenQuiet) {
  StepRecord record;
  record.broken_bonds = 5;
  testing::internal::CaptureStderr();
  for (const bool quiet : {true, false}) {
    Progress progress(quiet, 10, std::nullopt);
    for (int k = 0; k < 100; ++k) progress.update(record);
    progress.finish();
    progress.finish();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace perilink

#include "base/build_info.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace perilink {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(BuildInfo, VersionHasThreeNumbers) {
  EXPECT_THAT(program_version(), ContainsRegex("^[0-9]+\\.[0-9]+\\.[0-9]+$"));
}

TEST(BuildInfo, CommitIsAHashOrUnknown) {
  EXPECT_THAT(program_commit(), ContainsRegex("^([0-9a-f]{12,}|unknown)$"));
}

TEST(BuildInfo, SummaryStartsWithTheVersionAndNamesEveryLibrary) {
  const std::string summary = build_summary();

  EXPECT_EQ(summary.rfind("perilink " + program_version() + "\n", 0), 0u);
  EXPECT_THAT(summary, ContainsRegex("CHOLMOD +[0-9]+\\.[0-9]+\\.[0-9]+\n"));
  EXPECT_THAT(summary, ContainsRegex("METIS +[0-9]+\\.[0-9]+\\.[0-9]+\n"));
  EXPECT_THAT(summary, ContainsRegex("Eigen +[0-9]+\\.[0-9]+\\.[0-9]+\n"));
  EXPECT_THAT(summary, ContainsRegex("BLAS +(/|not loaded)"));
  EXPECT_THAT(summary, ContainsRegex("MPI +(yes|no)"));
  EXPECT_THAT(summary, ContainsRegex("gmsh +([0-9]+\\.[0-9]+\\.[0-9]+|no)"));
}

TEST(BuildInfo, NothingWasLeftUnfilled) { EXPECT_THAT(build_summary(), Not(HasSubstr("@"))); }

}  // namespace
}  // namespace perilink

#include "base/error.hpp"

#include <gtest/gtest.h>

namespace perilink {
namespace {

TEST(InputError, NamesFileLineKeyFaultAndRemedy) {
  const InputError error({"beam.toml", 12, "body.horizon"}, "is 5, less than the spacing 12.5",
                         "give at least 12.5");

  EXPECT_STREQ(error.what(),
               "beam.toml:12: body.horizon: is 5, less than the spacing 12.5\n"
               "  give at least 12.5");
  EXPECT_EQ(error.where().line, 12);
  EXPECT_EQ(error.where().key, "body.horizon");
}

TEST(InputError, LeavesOutWhatIsNotKnown) {
  EXPECT_STREQ(InputError({"beam.toml", 0, ""}, "is empty", "").what(), "beam.toml: is empty");
}

TEST(InputError, NamesTheOptionThatGaveTheValue) {
  EXPECT_STREQ(InputError({"beam.toml", -1, "body.spacing"}, "is -1", "give 1").what(),
               "--set body.spacing: is -1\n  give 1");
}

TEST(Error, EveryKindIsAnErrorOfTheProgram) {
  EXPECT_THROW(throw InputError({}, "", ""), Error);
  EXPECT_THROW(throw SolverError(""), Error);
  EXPECT_THROW(throw FileError(""), Error);
}

}  // namespace
}  // namespace perilink

#include "app/process/console.hpp"

#include <gtest/gtest.h>

namespace perilink {
namespace {

TEST(Console, ShowsPrintableText) {
  testing::internal::CaptureStderr();
  complain("a file \x1b[31m.toml");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "perilink: a file \\x1b[31m.toml\n");
  testing::internal::CaptureStdout();
  say("Title \x07\n");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "Title \\x07\n");
}

}  // namespace
}  // namespace perilink

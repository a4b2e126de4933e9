#include "io/case/sections/case_elements.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/case_texts.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;

const std::string calibrated =
    replaced(small_case, "[body]\n", "[body]\nsurface = \"calibrated\"\n");

TEST(CaseElements, AreReadWithTheirDefaults) {
  const CaseFile input = parse_case(calibrated + "[elements]\nspacings = 4\n", "case.toml");
  ASSERT_TRUE(input.elements);
  EXPECT_EQ(input.elements->spacings, 4);
  EXPECT_EQ(input.elements->order, 2);
  EXPECT_FALSE(input.elements->buffer_zone);
  EXPECT_FALSE(parse_case(small_case, "case.toml").elements);
}

TEST(CaseElements, AreWrittenAndReadBack) {
  const std::string text = write_case(parse_case(
      calibrated + "[elements]\nsize = 0.5\norder = 1\nparticles = [\"body\"]\nhalo = 2.0\n",
      "case.toml"));
  EXPECT_THAT(text, HasSubstr("[elements]"));
  EXPECT_EQ(write_case(parse_case(text, "case.toml")), text);
}

TEST(CaseElements, AreRefusedWhereTheyMeanNothing) {
  const auto message = [&](const std::string& more) {
    return message_of(calibrated + "[elements]\n" + more);
  };
  EXPECT_THAT(message(""), HasSubstr("spacings"));
  EXPECT_THAT(message("spacings = 1\n"), HasSubstr("elements.spacings"));
  EXPECT_THAT(message("spacings = 4\nsize = 2\n"), HasSubstr("size"));
  EXPECT_THAT(message("spacings = 4\norder = 3\n"), HasSubstr("elements.order"));
  EXPECT_THAT(message("spacings = 4\nalert = 0\n"), HasSubstr("greater than zero"));
  EXPECT_THAT(message("spacings = 4\nregions = [\"nowhere\"]\n"), HasSubstr("nowhere"));
  EXPECT_THAT(
      message_of(replaced(calibrated, "\"calibrated\"", "\"none\"") + "[elements]\nspacings = 4\n"),
      HasSubstr("calibrated bonds"));
}

}  // namespace
}  // namespace perilink

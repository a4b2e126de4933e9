#include "io/case/case_overrides.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "io/case/case_file.hpp"
#include "support/strip_case.hpp"

namespace perilink {
namespace {

CaseFile strip_with(const std::vector<TomlValue>& keys) {
  return parse_case(test::strip_text, "strip.toml", keys);
}

TEST(CaseOverrides, TakeThePlaceOfTheKey) {
  EXPECT_EQ(strip_with({body_key("spacing", 5.0)}).body.spacing, 5.0);
  EXPECT_EQ(strip_with({}).body.spacing, 10.0);
}

TEST(CaseOverrides, TakeThePlaceOfKeysThatSayTheSame) {
  const CaseFile columns = strip_with({body_key("columns", 9)});
  EXPECT_EQ(columns.body.columns, 9);
  EXPECT_FALSE(columns.body.spacing.has_value());
  const CaseFile ratio = strip_with({body_key("horizon_ratio", 2.0)});
  EXPECT_EQ(ratio.body.horizon_ratio, 2.0);
  EXPECT_FALSE(ratio.body.horizon.has_value());
}

TEST(CaseOverrides, LinearElementsDropAllKeysOfBonds) {
  const std::string text = std::string(test::strip_text) + "[analysis]\ntype = \"elastic\"\n";
  const CaseFile input =
      parse_case(text, "strip.toml", {body_key("method", std::string("linear_elements"))});
  EXPECT_EQ(input.body.method, BodyMethod::linear_elements);
  EXPECT_FALSE(input.body.horizon.has_value());
}

TEST(CaseOverrides, AreCheckedAsTheFileIs) {
  EXPECT_THROW(strip_with({body_key("surface", "golden")}), InputError);
  EXPECT_THROW(strip_with({body_key("columns", 1)}), InputError);
  // The horizon of the file, 31, is less than this spacing.
  EXPECT_THROW(strip_with({body_key("spacing", 40.0)}), InputError);
}

TEST(CaseOverrides, NameNoLineOfTheCase) {
  try {
    strip_with({body_key("spacing", -1.0)});
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.where().key, "body.spacing");
    EXPECT_EQ(error.where().line, 0);
  }
}

TEST(CaseOverrides, DoNotMakeUpAMissingTable) {
  EXPECT_THROW(parse_case("title = \"a\"\n", "a.toml", {body_key("spacing", 1.0)}), InputError);
}

}  // namespace
}  // namespace perilink

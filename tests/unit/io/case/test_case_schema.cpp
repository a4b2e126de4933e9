#include "io/case/case_schema.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "io/case/case_keys.hpp"
#include "support/case_texts.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(CaseSchema, MeasuresEditDistance) {
  EXPECT_EQ(edit_distance("horizon", "horizon"), 0);
  EXPECT_EQ(edit_distance("horizn", "horizon"), 1);
  EXPECT_EQ(edit_distance("horizonn", "horizon"), 1);
  EXPECT_EQ(edit_distance("horizan", "horizon"), 1);
  EXPECT_EQ(edit_distance("hroizon", "horizon"), 1) << "exchanged letters are one slip";
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
}

TEST(CaseSchema, SuggestsTheNearestWord) {
  EXPECT_EQ(suggest("horizn", {"spacing", "horizon"}),
            "did you mean `horizon`? Allowed: spacing, horizon");
  EXPECT_EQ(suggest("CMOD", {"load", "cmod"}), "did you mean `cmod`? Allowed: load, cmod");
  EXPECT_EQ(suggest("qqqq", {"spacing", "horizon"}), "Allowed: spacing, horizon");
  EXPECT_EQ(suggest("q", {"x", "y"}), "Allowed: x, y") << "every letter is one slip from another";
}

TEST(CaseSchema, CutsLongLists) {
  const std::vector<std::string_view> many(50, "region");
  EXPECT_THAT(suggest("q", many), HasSubstr("and 30 more"));
  EXPECT_EQ(suggest(std::string(100000, 'a'), {"b"}), "Allowed: b");
}

TEST(CaseSchema, RefusesEveryKeyThatItLacks) {
  for (const TableSchema& table : case_schema()) {
    if (table.name.empty() || table.list) continue;
    const std::string text = std::string("[") + std::string(table.name) + "]\nno_such_key = 1\n";
    EXPECT_THAT(message_of(text), HasSubstr(std::string(table.name) + ".no_such_key"));
  }
}

TEST(CaseSchema, TellsWhereAMisplacedKeyBelongs) {
  EXPECT_THAT(message_of("spacing = 1"), HasSubstr("`spacing` belongs to [body]"));
  EXPECT_THAT(message_of("spaxing = 1"), Not(HasSubstr("belongs")));
}

}  // namespace
}  // namespace perilink

#include "io/text/toml_tree.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "base/error.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;

TEST(TomlTree, KeepsValuesAndLines) {
  const TomlValue root =
      parse_toml("b = 1\na = 2.5\n\n[t]\nx = [true, \"\u00fc\"]\nd = 1979-05-27\n", "");
  ASSERT_EQ(root.entries.size(), 3u);
  EXPECT_EQ(root.entries[0].key, "b") << "the order of the file, not of the alphabet";
  EXPECT_EQ(root.find("b")->integer, 1);
  EXPECT_EQ(root.find("b")->number, 1.0);
  EXPECT_EQ(root.find("a")->kind, TomlValue::Kind::number);
  EXPECT_EQ(root.find("a")->line, 2);
  const TomlValue* table = root.find("t");
  ASSERT_NE(table, nullptr);
  EXPECT_EQ(table->find("x")->line, 5);
  EXPECT_TRUE(table->find("x")->items.at(0).boolean);
  EXPECT_EQ(table->find("x")->items.at(1).text, "\u00fc");
  EXPECT_EQ(table->find("d")->kind, TomlValue::Kind::date);
  EXPECT_EQ(table->find("y"), nullptr);
}

TEST(TomlTree, NamesTheLineOfAFault) {
  for (const char* text :
       {"a = 1\nb = ", "a = 1\na = 2", "\n[= 1]", "\n[,]", "\na = \"\xff\"", "\n\x01"}) {
    try {
      parse_toml(text, "case.toml");
      FAIL() << text;
    } catch (const InputError& error) {
      EXPECT_EQ(error.where().file, "case.toml");
      EXPECT_THAT(error.where().line, testing::AnyOf(0, 2)) << text;
    }
  }
}

TEST(TomlTree, DescribesValues) {
  const TomlValue root =
      parse_toml("a = [1]\nb = {}\nc = \"x\"\nd = -2\ne = 0.5\nf = false\ng = nan", "");
  const char* const expected[] = {"an array of 1 value", "a table",        "the text \"x\"",
                                  "the integer -2",      "the number 0.5", "the boolean false",
                                  "the number nan"};
  for (std::size_t i = 0; i < root.entries.size(); ++i) {
    EXPECT_EQ(describe(root.entries[i]), expected[i]);
  }
}

TEST(TomlTree, WritesValuesThatReadBack) {
  for (const char* text : {"1", "1.0", "-2.5e-09", "true", "[]", "[1, [\"a\"]]", "nan", "inf",
                           "\"a \\\"b\\\" \\\\ \\u000a\"", "{\"b c\" = {\"d\" = [2.0]}}"}) {
    EXPECT_EQ(toml_text(parse_toml(std::string("a = ") + text, "").entries.at(0)), text);
  }
}

TEST(TomlTree, QuotesAnyTextOnOneShortLine) {
  EXPECT_EQ(quoted("a\nb"), "\"a\\x0ab\"");
  EXPECT_EQ(quoted("\u00fc"), "\"\u00fc\"");
  EXPECT_LE(quoted(std::string(1000, 'a')).size(), 70u);
  EXPECT_THAT(quoted(std::string(1000, 'a')), HasSubstr("...\""));
}

}  // namespace
}  // namespace perilink

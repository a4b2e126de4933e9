#include "io/text/toml_guard.hpp"

#include <gtest/gtest.h>

#include <string>

#include "base/error.hpp"

namespace perilink {
namespace {

int refused_line(const std::string& text) {
  try {
    guard_toml(text, "case.toml");
  } catch (const InputError& error) {
    return error.where().line;
  }
  return 0;
}

TEST(TomlGuard, LeavesAsciiAlone) {
  const std::string text = "a = \"b # \\\" c\" # d \"\n[x]\r\ny = 'z\\'\nw = [1.5, {v = 2}]\n";
  EXPECT_EQ(guard_toml(text, ""), text);
}

TEST(TomlGuard, EscapesCharactersBeyondAsciiInStrings) {
  EXPECT_EQ(guard_toml("a = \"\u00fc\u20ac\U0001F600\"", ""),
            "a = \"\\U000000FC\\U000020AC\\U0001F600\"");
}

TEST(TomlGuard, BlanksCharactersBeyondAsciiInComments) {
  EXPECT_EQ(guard_toml("# \u00fc \"\na = 1", ""), "# ?? \"\na = 1");
}

TEST(TomlGuard, DropsByteOrderMark) {
  EXPECT_EQ(guard_toml("\xEF\xBB\xBF"
                       "a = 1",
                       ""),
            "a = 1");
}

TEST(TomlGuard, RefusesWhatTheParserCannotBeTrustedWith) {
  EXPECT_EQ(refused_line("a = 1\n\u00fc = 2"), 2);
  EXPECT_EQ(refused_line("a = 1\n\nb = '\u00fc'"), 3);
  EXPECT_EQ(refused_line("a = \"\\\u00fc\""), 1);
  EXPECT_EQ(refused_line("a = \"\"\"b\"\"\""), 1);
  EXPECT_EQ(refused_line("a = '''b'''"), 1);
  EXPECT_EQ(refused_line("a = \"b\\\nc\""), 1);
  EXPECT_EQ(refused_line("a = b\"c\""), 1);
}

TEST(TomlGuard, RefusesDeepNesting) {
  for (const int depth : {17, 100000}) {
    const auto count = static_cast<std::size_t>(depth);
    EXPECT_EQ(refused_line("\na = " + std::string(count, '[')), 2);
    EXPECT_EQ(refused_line("\n[" + std::string(count, '.') + "]"), 2);
  }
  EXPECT_EQ(refused_line("a = [[[[1.5, 2.5], [3.5]]]]\n"), 0);
  std::string long_list = "a = [";
  for (int i = 0; i < 1000; ++i) long_list += "0.5, ";
  EXPECT_EQ(refused_line(long_list + "]"), 0) << "decimal points are no levels";
}

}  // namespace
}  // namespace perilink

#include "base/plain_text.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace perilink {
namespace {

TEST(PlainText, LettersOfAllLanguagesStay) {
  const std::string text = "Balken \xc3\x9f, \xe6\xa2\x81, \xf0\x9f\xa7\xb1\tm\xc2\xb3\n";
  EXPECT_EQ(printable(text), text);
}

TEST(PlainText, WhatSteersATerminalIsWrittenOut) {
  EXPECT_EQ(printable("\x1b[31mred\x07"), "\\x1b[31mred\\x07");
  EXPECT_EQ(printable("\r\x7f"), "\\x0d\\x7f");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\x9b31m")
      << "the same in one character beyond ASCII";
  EXPECT_EQ(printable("a\xe2\x80\xae"
                      "b"),
            "a\\u202eb")
      << "turns the text around";
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\x00b");
}

TEST(PlainText, WhatIsNoUtf8IsWrittenOut) {
  EXPECT_EQ(printable("\xff"), "\\xff");
  EXPECT_EQ(printable("\xc3"), "\\xc3") << "cut off";
  EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf") << "longer than need be";
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "half a character of UTF-16";
  EXPECT_EQ(printable("\xef\xbf\xbf"), "\\uffff") << "XML allows none";
}

TEST(JoinedText, SeparatesNumbersOfSixDigits) {
  const std::array<double, 3> numbers = {0.1 + 0.2, -1234567.0, 2.0};
  EXPECT_EQ(joined(numbers), "0.3, -1.23457e+06, 2");
}

TEST(CountedText, OnlyOneIsSingular) {
  EXPECT_EQ(counted(1, "bond"), "1 bond");
  EXPECT_EQ(counted(0, "bond"), "0 bonds");
  EXPECT_EQ(counted(12, "yield event"), "12 yield events");
  EXPECT_EQ(counted(1, "entry", "entries"), "1 entry");
  EXPECT_EQ(counted(2, "entry", "entries"), "2 entries");
}

TEST(JoinedText, SeparatesTexts) {
  EXPECT_EQ(joined(std::vector<std::string>{"a", "b"}), "a, b");
  EXPECT_EQ(joined(std::vector<std::string>{}), "");
}

}  // namespace
}  // namespace perilink

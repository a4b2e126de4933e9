#include "io/text/toml_writer.hpp"

#include <gtest/gtest.h>

#include "io/text/toml_tree.hpp"

namespace perilink {
namespace {

TEST(TomlWriter, WhatIsWrittenReadsBack) {
  TomlWriter out;
  out.write("text", "a \"b\" \\ c");
  out.write("number", 0.1);
  out.write("flag", true);
  out.write("nothing", std::optional<double>());
  out.header("[table]");
  out.write("list", std::vector<std::string>{"x", "y"});
  const TomlValue root = parse_toml(out.take(), "a.toml");
  EXPECT_EQ(root.find("text")->text, "a \"b\" \\ c");
  EXPECT_EQ(root.find("number")->number, 0.1);
  EXPECT_TRUE(root.find("flag")->boolean);
  EXPECT_EQ(root.find("nothing"), nullptr);
  ASSERT_NE(root.find("table"), nullptr);
  EXPECT_EQ(root.find("table")->find("list")->items[1].text, "y");
}

}  // namespace
}  // namespace perilink

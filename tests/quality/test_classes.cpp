// Classes stay small enough to be understood: limits on what they hold, beside those on lines.

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "quality/class_extents.hpp"
#include "quality/source_tree.hpp"

namespace perilink::quality {
namespace {

constexpr int most_members = 25, most_functions = 30, most_booleans = 3;

std::string whole(const std::filesystem::path& file) {
  std::string text;
  for (const std::string& line : read_lines(file)) text += line + '\n';
  return text;
}

TEST(Classes, AreWithinTheLimitsOnState) {
  std::set<std::string> seen;
  for (const auto& file : cpp_files("src")) {
    if (file.extension() != ".hpp") continue;
    const ClassScanner scanner(whole(file));
    for (const auto& [name, extent] : scanner.classes()) {
      seen.insert(name);
      EXPECT_LE(extent.members, most_members) << shown(file) << ": members of " << name;
      EXPECT_LE(extent.functions, most_functions) << shown(file) << ": functions of " << name;
      EXPECT_LE(extent.booleans, most_booleans) << shown(file) << ": booleans of " << name;
    }
  }
  EXPECT_GT(seen.size(), 100u) << "the scanner has lost the classes";
}

TEST(Classes, ScannerCountsDeclarations) {
  const ClassScanner scanner(
      "namespace n {\n"
      "class A : public B {\n"
      " public:\n"
      "  A(int a, int b = {});\n"
      "  bool is() const { return x_ > 0; }\n"
      "  struct Part {\n    double y = 0.0, z{1.0};\n  };\n"
      "  static constexpr int most = 3;\n"
      "  using Map = std::map<int, int>;\n"
      " private:\n"
      "  std::map<int, std::vector<int>> map_;\n"
      "  bool first_ = false, second_ = true;\n"
      "  double d_[2] = {1.0, 2.0};\n"
      "};\n"
      "template <class T>\nvoid f(T) {}\n"
      "}\n");
  const std::map<std::string, ClassExtent>& classes = scanner.classes();
  ASSERT_EQ(classes.count("A"), 1u);
  EXPECT_EQ(classes.at("A").functions, 2);
  EXPECT_EQ(classes.at("A").booleans, 2);
  EXPECT_EQ(classes.at("A").members, 4);
  EXPECT_EQ(classes.at("Part").members, 2);
}

}  // namespace
}  // namespace perilink::quality

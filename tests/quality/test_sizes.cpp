// Files, functions and folders stay small enough to be read in one go.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <ostream>
#include <string>

#include "quality/function_lengths.hpp"
#include "quality/source_tree.hpp"

namespace perilink::quality {
namespace {

constexpr std::size_t longest_file = 400;
constexpr int longest_function = 60;
constexpr int largest_folder = 26;

std::string join(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

std::vector<std::filesystem::path> all_cpp_files() {
  std::vector<std::filesystem::path> files;
  for (const char* folder : {"src", "tests", "verification"}) {
    const auto more = cpp_files(folder);
    files.insert(files.end(), more.begin(), more.end());
  }
  return files;
}

TEST(Sizes, FilesAreUnder400Lines) {
  for (const auto& file : all_cpp_files()) {
    EXPECT_LT(read_lines(file).size(), longest_file) << shown(file);
  }
}

TEST(Sizes, FunctionsOfTheProgramAreUnder60Lines) {
  int seen = 0;
  for (const auto& file : cpp_files("src")) {
    for (const FunctionExtent& function : find_functions(join(read_lines(file)))) {
      ++seen;
      EXPECT_LT(function.length(), longest_function)
          << shown(file) << ":" << function.first_line << ": " << function.header;
    }
  }
  EXPECT_GT(seen, 100) << "the scanner has lost the functions";
}

TEST(Sizes, FoldersOfTheProgramHoldAtMost26Files) {
  std::map<std::string, int> counts;
  for (const auto& file : cpp_files("src")) ++counts[shown(file.parent_path())];
  for (const auto& [folder, count] : counts) EXPECT_LE(count, largest_folder) << folder;
}

TEST(Sizes, EveryHeaderIsGuardedByPragmaOnce) {
  for (const auto& file : all_cpp_files()) {
    if (file.extension() != ".hpp") continue;
    const auto lines = read_lines(file);
    EXPECT_EQ(std::count(lines.begin(), lines.end(), "#pragma once"), 1) << shown(file);
  }
}

struct Snippet {
  const char* name;
  const char* text;
  std::vector<int> lengths;  // lengths of its functions, in order
};

/// Without this CTest lists the snippets by their bytes.
void PrintTo(const Snippet& snippet, std::ostream* stream) { *stream << snippet.name; }

class FunctionScannerTest : public ::testing::TestWithParam<Snippet> {};

TEST_P(FunctionScannerTest, FindsFunctionsAndTheirLengths) {
  std::vector<int> lengths;
  for (const auto& function : find_functions(GetParam().text)) lengths.push_back(function.length());
  EXPECT_EQ(lengths, GetParam().lengths);
}

INSTANTIATE_TEST_SUITE_P(
    Snippets, FunctionScannerTest,
    ::testing::Values(
        Snippet{"oneLine", "int f() { return 1; }", {1}},
        Snippet{"declarationOnly", "int f();\nstruct S { int a{0}; };", {}},
        Snippet{"nestedBlocks", "namespace a {\nvoid f() {\n  if (x) {\n  }\n}\n}", {4}},
        Snippet{"headerOverTwoLines", "int f(int a,\n      int b) {\n  return 0;\n}", {4}},
        Snippet{"memberInitialisers", "A::A(int x)\n    : a_{x}, b_(x) {\n  g();\n}", {4}},
        Snippet{"members", "class A : public B {\n  int f() const {\n  }\n  int a{3};\n};", {2}},
        Snippet{"defaultArgument", "int f(A a = {}, B b = {1}) {\n\n}", {3}},
        Snippet{"bracesInText", "int f() {\n  g(\"}\", '}');  // }\n  /* } */\n}", {4}},
        Snippet{"digitSeparator", "int f() {\n  return 1'000;\n}\nint g() { return '}'; }", {3, 1}},
        Snippet{"namesWithDigits", "int f2(A b3c) {\n  g(u8'{');\n}", {3}},
        Snippet{"rawText", "auto t = R\"(int f() {)\";\nint g() {\n}", {2}},
        Snippet{"lambda", "int f() {\n  auto g = [](int) {\n  };\n}", {4}},
        Snippet{"templates", "template <class T>\nint f(T) {\n}", {3}},
        Snippet{"enumeration", "enum class E : int { a, b };\nint f() {}", {1}},
        Snippet{"directive", "#define X(a) {\nint f() {\n}", {2}},
        Snippet{"table", "const int t[] = {g(1), {2}};\nint f() {}", {1}}),
    [](const auto& snippet) { return std::string(snippet.param.name); });

}  // namespace
}  // namespace perilink::quality

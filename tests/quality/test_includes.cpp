// Dependencies between modules point one way, libraries stay behind the module that wraps them, and
// no two types have one name.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "quality/source_tree.hpp"

namespace perilink::quality {
namespace {

// docs/developers/architecture.md lists the modules.
const std::map<std::string, std::set<std::string>>& allowed_modules() {
  static const std::map<std::string, std::set<std::string>> table = {
      {"base", {}},
      {"material", {"base"}},
      {"solver", {"base"}},
      {"discretization", {"base"}},
      {"calibration", {"base", "solver", "discretization"}},
      {"network", {"base", "material", "discretization", "calibration"}},
      {"assembly", {"base", "material", "discretization", "network"}},
      {"analysis", {"base", "material", "solver", "discretization", "network", "assembly"}},
      {"io", {"base", "material", "solver", "discretization"}},
      {"results", {"base", "material", "discretization", "network", "assembly", "analysis", "io"}},
      {"model",
       {"base", "material", "solver", "discretization", "calibration", "network", "assembly",
        "analysis", "io", "results"}},
      {"app",
       {"base", "material", "solver", "discretization", "calibration", "network", "assembly",
        "analysis", "io", "results", "model"}},
      {"perilink.hpp",
       {"base", "discretization", "assembly", "analysis", "io", "results", "model", "app"}},
      {"python", {"perilink.hpp"}},
  };
  return table;
}

struct Confinement {
  std::regex header;
  std::set<std::string> places;  // files below which it may be included, from src/
};

const std::vector<Confinement>& confined_headers() {
  static const std::vector<Confinement> table = {
      {std::regex("^(suitesparse/)?cholmod.*\\.h$"), {"solver/"}},
      {std::regex("^metis\\.h$"), {"solver/"}},
      {std::regex("^(cblas|lapacke?)\\.h$"), {"solver/"}},
      {std::regex("^mpi.*\\.h$"), {"solver/ranks/"}},
      {std::regex("^nanoflann\\.hpp$"), {"discretization/neighbor_search.cpp"}},
      {std::regex("^toml\\+\\+/.*"), {"io/"}},
      {std::regex("^pugi(xml|config)\\.hpp$"), {"io/"}},
      {std::regex("^muParser.*\\.h$"), {"io/text/formula.cpp"}},
      {std::regex("^zlib\\.h$"), {"io/"}},
      {std::regex("^cereal/.*"), {"io/checkpoint/"}},
      {std::regex("^gmshc?\\.h(_cwrap)?$"), {"io/"}},
      {std::regex("^CLI/.*"), {"app/"}},
      {std::regex("^pybind11/.*"), {"python/"}},
      {std::regex("^nlohmann/.*"), {"app/", "model/", "results/"}},
  };
  return table;
}

struct Include {
  std::filesystem::path file;
  int line;
  std::string header;
  bool quoted;  // "header" as against <header>

  std::string place() const { return shown(file) + ":" + std::to_string(line); }
  std::string place_in_src() const {
    return file.lexically_relative(project_root() / "src").generic_string();
  }
  std::string module() const { return place_in_src().substr(0, place_in_src().find('/')); }
};

std::vector<Include> all_includes() {
  static const std::regex directive("^\\s*#\\s*include\\s*([<\"])([^>\"]+)[>\"]");
  std::vector<Include> includes;
  for (const auto& file : cpp_files("src")) {
    int number = 0;
    for (const std::string& line : read_lines(file)) {
      ++number;
      std::smatch match;
      if (!std::regex_search(line, match, directive)) continue;
      includes.push_back({file, number, match[2], match[1] == "\""});
    }
  }
  return includes;
}

/// Who includes whom, of files or of their folders.
using Graph = std::map<std::string, std::set<std::string>>;

Graph graph_of(const std::function<std::string(const std::string&)>& node_of) {
  Graph graph;
  for (const Include& include : all_includes()) {
    const std::string from = node_of(include.place_in_src()), to = node_of(include.header);
    if (include.quoted && from != to) graph[from].insert(to);
  }
  return graph;
}

/// The way round a circle, "a -> b -> a"; empty where there is none.
std::string circle_in(const Graph& graph) {
  std::set<std::string> done;
  std::vector<std::string> way;
  std::string circle;
  const std::function<void(const std::string&)> follow = [&](const std::string& node) {
    if (!circle.empty() || done.count(node) > 0) return;
    const auto met = std::find(way.begin(), way.end(), node);
    if (met != way.end()) {
      for (auto step = met; step != way.end(); ++step) circle += *step + " -> ";
      circle += node;
      return;
    }
    way.push_back(node);
    if (graph.count(node) > 0) {
      for (const std::string& next : graph.at(node)) follow(next);
    }
    way.pop_back();
    done.insert(node);
  };
  for (const auto& [node, targets] : graph) follow(node);
  return circle;
}

std::string folder_of(const std::string& file) { return file.substr(0, file.rfind('/')); }

TEST(Includes, EveryModuleIsInTheTable) {
  for (const auto& entry : std::filesystem::directory_iterator(project_root() / "src")) {
    if (!entry.is_directory()) continue;
    EXPECT_EQ(allowed_modules().count(entry.path().filename()), 1u)
        << shown(entry.path()) << ": a new module needs a row here and in architecture.md";
  }
}

TEST(Includes, ModulesIncludeOnlyWhatTheTableAllows) {
  for (const Include& include : all_includes()) {
    if (!include.quoted) continue;
    const std::string target = include.header.substr(0, include.header.find('/'));
    ASSERT_EQ(allowed_modules().count(target), 1u)
        << include.place() << ": \"" << include.header << "\" is no module/file of src";
    if (target == include.module()) continue;
    EXPECT_EQ(allowed_modules().at(include.module()).count(target), 1u)
        << include.place() << ": " << include.module() << " may not include " << include.header;
  }
}

TEST(Includes, OwnHeadersAreQuotedAndExist) {
  for (const Include& include : all_includes()) {
    if (!include.quoted) {
      const std::string folder = include.header.substr(0, include.header.find('/'));
      EXPECT_EQ(allowed_modules().count(folder), 0u) << include.place() << ": use quotes";
      continue;
    }
    const auto source = project_root() / "src" / include.header;
    const bool exists = std::filesystem::exists(source) ||
                        std::filesystem::exists(source.string() + ".in");  // made by CMake
    EXPECT_TRUE(exists) << include.place() << ": " << include.header;
  }
}

TEST(Includes, FilesGoRoundInNoCircle) {
  EXPECT_EQ(circle_in(graph_of([](const std::string& file) { return file; })), "");
}

// A source and its header count as one: whoever reads definitions goes round in no circle either.
TEST(Includes, SourcesWithTheirHeadersGoRoundInNoCircle) {
  EXPECT_EQ(
      circle_in(graph_of([](const std::string& file) { return file.substr(0, file.rfind('.')); })),
      "");
}

TEST(Includes, FoldersGoRoundInNoCircle) { EXPECT_EQ(circle_in(graph_of(folder_of)), ""); }

TEST(Includes, LibrariesStayBehindTheirModule) {
  for (const Include& include : all_includes()) {
    for (const Confinement& rule : confined_headers()) {
      if (!std::regex_match(include.header, rule.header)) continue;
      EXPECT_TRUE(std::any_of(
          rule.places.begin(), rule.places.end(),
          [&](const std::string& place) { return include.place_in_src().starts_with(place); }))
          << include.place() << ": " << include.header << " belongs in src/"
          << *rule.places.begin();
    }
  }
}

/// Types that a source defines outside functions and anonymous namespaces, with their namespaces.
/// clang-format puts their first lines, and those of namespaces, at the begin of a line.
std::vector<std::string> shared_types(const std::vector<std::string>& lines) {
  const std::regex opens(R"((?:inline )?namespace ?([\w:]*) ?\{.*)"),
      closes(R"(\}  // namespace.*)");
  // Not declarations ("class A;"), nor functions and variables ("struct A f() {").
  const std::regex type(
      R"((?:class|struct|union|enum(?: class)?) (\w+)(?: final)?(?:|(?: :| \{).*))");
  std::vector<std::string> open, found;
  std::smatch name;
  for (const std::string& line : lines) {
    if (std::regex_match(line, name, opens)) open.push_back(name[1]);
    if (std::regex_match(line, closes)) open.pop_back();
    const bool anonymous = std::find(open.begin(), open.end(), "") != open.end();
    if (anonymous || !std::regex_match(line, name, type)) continue;
    std::string whole;
    for (const std::string& space : open) whole += space + "::";
    found.push_back(whole + name[1].str());
  }
  return found;
}

// The linker keeps one destructor, or one inline function, for types of one name, and both use it.
TEST(Types, HaveNamesOfTheirOwn) {
  std::map<std::string, std::string> places;
  for (const auto& file : cpp_files("src")) {
    for (const std::string& type : shared_types(read_lines(file))) {
      const auto [first, is_new] = places.emplace(type, shown(file));
      EXPECT_TRUE(is_new) << shown(file) << ": " << type << " is a type of " << first->second;
    }
  }
  EXPECT_EQ(places["perilink::LineFile"], "src/base/files.hpp");
}

TEST(Types, AreFoundWhereOthersSeeThem) {
  EXPECT_EQ(shared_types({"namespace a {", "class Declared;", "struct A {", "  struct Inner {};",
                          "};", "namespace {", "class Hidden {};", "}  // namespace",
                          "class B final : public A {", "};", "enum class C { one };",
                          "}  // namespace a", "namespace b::c {", "struct A", "    : D {};",
                          "}  // namespace b::c"}),
            (std::vector<std::string>{"a::A", "a::B", "a::C", "b::c::A"}));
}

}  // namespace
}  // namespace perilink::quality

// The user's page of results names every file, column, field and key that a run writes.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/commands/commands.hpp"
#include "app/commands/plot_command.hpp"
#include "io/fields/vtu.hpp"
#include "io/text/csv.hpp"
#include "quality/source_tree.hpp"
#include "results/history_columns.hpp"
#include "support/temporary_directory.hpp"

namespace perilink::quality {
namespace {

namespace fs = std::filesystem;

constexpr const char* square = R"([[regions]]
name = "square"
x = [0, 1]
y = [0, 1]

[[regions]]
name = "left side"
x = [0, 0]
y = [0, 1]

[[regions]]
name = "right side"
x = [1, 1]
y = [0, 1]

[[materials]]
region = "square"
youngs_modulus = 100
poissons_ratio = 0.2
fracture_energy = 0.001

[[supports]]
region = "left side"
fix = ["x", "y"]

[[displacements]]
region = "right side"
x = 0.04
)";

/// Between them these write everything: micropolar bonds that break beside a bar, elastic ones and
/// linear elements.
const std::vector<std::string> heads = {
    R"([body]
spacing = 0.25
horizon_ratio = 2
model = "micropolar"

[stop]
broken_bonds = 3

[[rebar]]
from = [0, 0.5]
to = [1, 0.5]
youngs_modulus = 1000
area = 0.01
)",
    R"([body]
spacing = 0.25
horizon_ratio = 2
model = "micropolar"

[analysis]
type = "elastic"
)",
    R"([body]
spacing = 0.25
method = "linear_elements"

[analysis]
type = "elastic"
)"};

/// Explicit analyses write files of their own: of a body that may break and of an elastic one.
std::string explicit_case(const std::string& strength) {
  return R"([body]
model = "lattice"
spacing = 0.125

[analysis]
type = "explicit"
duration = 0.5
rows = 10

[[regions]]
name = "square"
x = [0, 1]
y = [0, 1]

[[regions]]
name = "right side"
x = [0.9, 1]
y = [0, 1]

[[materials]]
region = "square"
youngs_modulus = 100
poissons_ratio = 0.2
density = 1
)" + strength +
         R"(
[[displacements]]
region = "right side"
x = 0.01
)";
}

std::vector<std::string> cases() {
  std::vector<std::string> texts;
  for (const std::string& head : heads) texts.push_back(head + square);
  texts.push_back(explicit_case("fracture_energy = \"infinite\"\n"));
  texts.push_back(explicit_case("fracture_energy = 1000\ntensile_strength = 1\n"));
  return texts;
}

std::string page() {
  std::string text;
  for (const std::string& line : read_lines(project_root() / "docs/outputs.md")) {
    text += line + "\n";
  }
  return text;
}

/// The part of the page below a heading, down to the next one.
std::string section(const std::string& heading) {
  const std::string text = page();
  const std::size_t begin = text.find("\n## " + heading);
  return begin == std::string::npos ? ""
                                    : text.substr(begin, text.find("\n## ", begin + 1) - begin);
}

void expect_named(const std::string& text, const std::string& name, const std::string& what) {
  EXPECT_NE(text.find("`" + name + "`"), std::string::npos)
      << "docs/outputs.md does not name the " << what << " `" << name << "`";
}

/// Returns the unit that a table of the page gives for a name; tables list names and their units as
/// "| `load`, `displacement` | F, L |", or one unit for all.
std::string unit_in(const std::string& text, const std::string& name) {
  const std::size_t at = text.find("`" + name + "`");
  const std::size_t line = text.rfind('\n', at) + 1, bar = text.find(" |", at);
  const auto commas = std::count(text.begin() + line, text.begin() + at, ',');
  const std::size_t end = text.find('|', bar + 2);
  std::string units = text.substr(bar + 2, end - bar - 2);
  for (auto k = commas; k > 0 && units.find(", ") != std::string::npos; --k) {
    units.erase(0, units.find(", ") + 2);
  }
  units = units.substr(0, units.find(", "));
  const std::size_t first = units.find_first_not_of(' '), last = units.find_last_not_of(' ');
  const bool none = first == std::string::npos || units.substr(first, last - first + 1) == "–";
  return none ? "" : units.substr(first, last - first + 1);
}

void expect_keys(const std::string& text, const nlohmann::json& object) {
  for (const auto& [key, value] : object.items()) {
    expect_named(text, key, "key of summary.json");
    if (value.is_object()) expect_keys(text, value);
  }
}

void expect_fields(const std::string& text, const fs::path& file) {
  const VtuGrid grid = read_vtu(file.string());
  EXPECT_FALSE(grid.point_data.empty());
  for (const VtuArray& array : grid.point_data) expect_named(text, array.name, "field of points");
  for (const VtuArray& array : grid.cell_data) expect_named(text, array.name, "field of cells");
  for (const auto& [name, value] : grid.field_data) expect_named(text, name, "datum of a file");
}

class Outputs : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const fs::path input = work_ / "case.toml";
    std::ofstream(input) << GetParam();
    RunOptions run;
    run.case_path = input.string();
    run.directory = results().string();
    run.quiet = true;
    run.threads = 1;
    ASSERT_EQ(run_case(run), exit_done);
    PlotOptions plot;
    plot.directory = results().string();
    testing::internal::CaptureStdout();
    plot_results(plot);
    testing::internal::GetCapturedStdout();
  }
  fs::path results() const { return work_ / "results"; }

  test::TemporaryDirectory work_;
};

TEST_P(Outputs, EveryFileIsDocumented) {
  const std::string text = page();
  for (const auto& entry : fs::directory_iterator(results())) {
    std::string name = entry.path().filename().string();
    if (name.ends_with(".vtu")) name = "fields_000010.vtu";
    if (name.starts_with("bars_")) name = "bars_000010.csv";
    if (name.starts_with("cracks_")) name = "cracks_000010.csv";
    if (name.starts_with("reactions_")) name = "reactions_000010.csv";
    if (name.starts_with("fields_") && name.ends_with(".svg")) name = "fields_000010.svg";
    expect_named(text, name, "file");
  }
}

TEST_P(Outputs, EveryColumnIsDocumented) {
  for (const std::string& column : read_csv((results() / "history.csv").string()).columns) {
    expect_named(section("history.csv"), column, "column of history.csv");
    ASSERT_NE(find_history_column(column), nullptr) << column;
    EXPECT_EQ(unit_in(section("history.csv"), column), find_history_column(column)->unit) << column;
  }
  for (const std::string& column : read_csv((results() / "timing.csv").string()).columns) {
    expect_named(page(), column, "column of timing.csv");
  }
}

TEST_P(Outputs, EveryFieldIsDocumented) {
  int files = 0;
  for (const auto& entry : fs::directory_iterator(results())) {
    if (entry.path().extension() != ".vtu") continue;
    ++files;
    expect_fields(section("Fields"), entry.path());
  }
  EXPECT_GT(files, 0);
}

TEST_P(Outputs, EveryKeyOfTheSummaryIsDocumented) {
  std::ifstream file(results() / "summary.json");
  const nlohmann::json summary = nlohmann::json::parse(file);
  EXPECT_GT(summary.size(), 20u);
  expect_keys(section("summary.json"), summary);
}

INSTANTIATE_TEST_SUITE_P(Cases, Outputs, testing::ValuesIn(cases()));

}  // namespace
}  // namespace perilink::quality

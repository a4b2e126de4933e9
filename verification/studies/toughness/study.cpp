// What long cracks cost: strips of every lattice, and whole cases with each rule of critical
// stretches.
//
//   toughness table   measures the rows of src/network/crack_cost.cpp, writes result_table.csv, and
//                     goes on where an earlier run has ended
//   toughness cases   clamped strips and double cantilevers as cases, writes result.csv
//   toughness clouds  clamped strips of tetrahedra, writes result_clouds.csv
//
// Exit status 1 when a case misses its acceptance. Some minutes each; the table takes hours.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "bodies.hpp"
#include "io/case/case_words.hpp"
#include "problems/program.hpp"
#include "problems/result.hpp"
#include "strip.hpp"

namespace perilink::verification {
namespace {

constexpr const char* table_file = "result_table.csv";

/// Prints and keeps lines.
class Table {
 public:
  explicit Table(const std::string& heading) { add(heading); }
  void add(const std::string& line) {
    fmt::print("{}", line);
    std::fflush(stdout);
    text += line;
  }
  std::string text;
};

struct Series {
  Pattern pattern;
  std::vector<double> horizon_ratios;  ///< one for each number of neighbours
};

/// Lines that an earlier run has measured.
std::vector<std::string> lines_of(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

/// \param measured  lines of an earlier run: those of these strips go over to the table
void measure_strips(Table& table, Strip strip, std::vector<std::string>& measured) {
  const bool space = strip.pattern == Pattern::cubic || strip.pattern == Pattern::face_centred;
  // High enough to hold the cracks that wind at short horizons, in the plane at three heights.
  const std::vector<double> heights =
      space ? std::vector<double>{2.6} : std::vector<double>{3.0, 4.0, 5.0};
  for (const double height : heights) {
    strip.half_height = std::max(height, (7.0 + height) / strip.horizon_ratio);
    const std::string key =
        fmt::format("{},{:.3f},{:.4f},{},{},{:.1f},", word_of(strip.pattern), strip.horizon_ratio,
                    strip.lame_ratio,
                    strip.growth[0] == 0   ? "y"
                    : strip.growth[1] == 0 ? "x"
                                           : "diagonal",
                    strip.calibrated ? "calibrated" : "none", strip.half_height);
    const auto known = std::find_if(measured.begin(), measured.end(),
                                    [&](const std::string& line) { return line.starts_with(key); });
    if (known != measured.end()) {
      table.add(*known + "\n");
      measured.erase(known);
      continue;
    }
    const StripCost cost = measure_crack_cost(strip);
    table.add(fmt::format("{}{:.4f},{:.4f},{},{}\n", key, cost.dissipated, cost.released,
                          cost.events, cost.unknowns));
    std::string text = table.text;  // with what a run that is ended here would lose
    for (const std::string& line : measured) text += line + "\n";
    write_result(PERILINK_STUDY_DIR, text, table_file);
  }
}

void measure_table() {
  std::vector<std::string> measured = lines_of(std::string(PERILINK_STUDY_DIR) + "/" + table_file);
  if (!measured.empty()) measured.erase(measured.begin());  // the heading
  Table table(
      "pattern,horizon_ratio,lame_ratio,direction,surface,half_height,dissipated_over_GF,released_"
      "over_GF,events,unknowns\n");
  const std::vector<Series> plane = {
      {Pattern::rectangular, {1.707, 2.0, 2.532, 2.914, 3.0, 3.384, 3.803, 4.0}},
      {Pattern::hexagonal, {1.866, 2.0, 2.823, 3.0, 3.535, 3.803, 4.0}}};
  for (const Series& series : plane) {
    for (const double ratio : series.horizon_ratios) {
      for (const double lame : {1.0, 6.0 / 7.0, 0.5, 0.0}) {
        Strip strip;
        strip.pattern = series.pattern;
        strip.horizon_ratio = ratio;
        strip.lame_ratio = lame;
        measure_strips(table, strip, measured);
      }
    }
  }
  const std::vector<Series> space = {{Pattern::cubic, {1.573, 2.0, 2.343, 3.0}},
                                     {Pattern::face_centred, {1.573, 1.866, 2.0, 2.343, 3.0}}};
  for (const Series& series : space) {
    for (const double ratio : series.horizon_ratios) {
      for (const double lame : {1.0, 6.0 / 7.0, 0.5, 0.0}) {
        Strip strip;
        strip.pattern = series.pattern;
        strip.horizon_ratio = ratio;
        strip.lame_ratio = lame;
        strip.beside = 1.2;
        strip.front = 2;
        strip.skipped = 5;
        strip.counted = 8;
        if (series.pattern == Pattern::face_centred) {
          strip.growth = {4, 0};
          strip.front = 1;
          strip.skipped = 3;
          strip.counted = 5;
        }
        measure_strips(table, strip, measured);
      }
    }
  }
  for (const double ratio : {2.0, 3.0, 4.0}) {  // other directions, other surfaces
    Strip strip;
    strip.horizon_ratio = ratio;
    strip.calibrated = false;
    measure_strips(table, strip, measured);
    strip.calibrated = true;
    strip.growth = {2, 2};
    measure_strips(table, strip, measured);
    strip.pattern = Pattern::hexagonal;
    strip.growth = {0, 4};
    measure_strips(table, strip, measured);
  }
  write_result(PERILINK_STUDY_DIR, table.text, table_file);
}

/// One body by every rule.
bool measure_cases_of(Table& table, const std::string& name, CrackedBody body, bool strip) {
  bool good = true;
  const std::string heading = body.heading;
  for (const char* rule : {"lattice", "dissipated"}) {
    body.heading = fmt::format("{}critical_stretch = \"{}\"\n", heading, rule);
    const PathEnergy energy = strip ? measure_clamped_strip(body) : measure_double_cantilever(body);
    table.add(fmt::format("{},{},{},{},{},{:.4f},{:.4f},{}\n", strip ? "strip" : "cantilever", name,
                          body.horizon_ratio, body.spacing, rule, energy.dissipated,
                          energy.released, energy.events));
    const bool counts = std::string(rule) == "dissipated" && strip && body.horizon_ratio >= 3.0;
    good = good && (!counts || std::abs(energy.dissipated - 1.0) <= 0.03);
  }
  return good;
}

bool measure_cases() {
  Table table(
      "body,lattice,horizon_ratio,spacing,rule,dissipated_over_GF,released_over_GF,events\n");
  CrackedBody square, hexagons, frames, cubes;
  hexagons.heading = "pattern = \"hexagonal\"\n";
  hexagons.row = std::sqrt(0.75);
  frames.heading = "model = \"micropolar\"\n";
  frames.of_material = "poissons_ratio = 0.2\n";
  frames.rotates = true;
  CrackedBody hexagonal_frames = frames;
  hexagonal_frames.heading += hexagons.heading;
  hexagonal_frames.row = hexagons.row;
  bool good = true;
  for (const auto& [name, shape] : {std::pair{"rectangular", square},
                                    {"hexagonal", hexagons},
                                    {"rectangular micropolar", frames},
                                    {"hexagonal micropolar", hexagonal_frames}}) {
    CrackedBody body = shape;
    for (const double ratio : {2.0, 2.5, 3.0, 3.015, 3.1, 3.5, 4.0}) {
      body.horizon_ratio = ratio;
      good = measure_cases_of(table, name, body, true) && good;
    }
    body.horizon_ratio = 3.0;
    for (const double spacing : {0.5, 0.02}) {
      body.spacing = spacing;
      good = measure_cases_of(table, name, body, true) && good;
    }
    body.spacing = 1.0;
    body.half_height = 6.0;
    measure_cases_of(table, name, body, false);
  }
  cubes.heading = "problem = \"three_dimensional\"\n";
  cubes.space = true;
  cubes.half_height = 2.0;
  cubes.grown = 6;
  good = measure_cases_of(table, "cubic", cubes, true) && good;
  for (const double ratio : {5.0, 6.0}) {
    square.horizon_ratio = ratio;
    good = measure_cases_of(table, "rectangular", square, true) && good;
  }
  write_result(PERILINK_STUDY_DIR, table.text, "result.csv");
  return good;
}

bool measure_unstructured() {
  Table table("algorithm,seed,rule,dissipated_over_GF,released_over_GF,events\n");
  const auto geometry = std::filesystem::temp_directory_path() / "toughness_cloud.geo";
  double sum = 0.0;
  constexpr std::pair<int, int> meshes[] = {{1, 1}, {10, 1}, {10, 2}};
  for (const char* rule : {"continuum", "dissipated"}) {
    sum = 0.0;
    for (const auto& [algorithm, seed] : meshes) {
      const PathEnergy energy =
          measure_strip_of_tetrahedra(geometry.string(), algorithm, seed, rule);
      table.add(fmt::format("{},{},{},{:.4f},{:.4f},{}\n", algorithm, seed, rule, energy.dissipated,
                            energy.released, energy.events));
      sum += energy.dissipated;
    }
  }
  std::filesystem::remove(geometry);
  write_result(PERILINK_STUDY_DIR, table.text, "result_clouds.csv");
  return std::abs(sum / std::size(meshes) - 1.0) <= 0.03;
}

}  // namespace
}  // namespace perilink::verification

bool perilink::verification::run_program(const std::vector<std::string>& arguments) {
  const std::string what = arguments.empty() ? "cases" : arguments[0];
  if (what == "clouds") return measure_unstructured();
  if (what != "table") return measure_cases();
  measure_table();
  return true;
}

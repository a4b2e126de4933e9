#include "app/compare/run_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/plot/plot_body.hpp"
#include "app/plot/plot_curve.hpp"
#include "base/error.hpp"
#include "base/plain_text.hpp"
#include "io/fields/vtu.hpp"
#include "io/text/csv.hpp"
#include "results/history_file.hpp"
#include "results/result_directory.hpp"
#include "results/summary_file.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

void read_summary(const fs::path& directory, RunResult& result) {
  const auto json = read_summary_file(directory);
  if (!json) {
    result.notes.emplace_back(
        "unfinished or killed: no summary.json; the rows so far are compared");
    return;
  }
  const auto text = [&](const char* key) { return summary_text(*json, key, directory); };
  result.units = text("units");
  result.status = text("status");
  result.reason = text("reason");
  if (result.status == "running") {
    result.notes.emplace_back("unfinished or killed; the rows so far are compared");
  } else if (result.status == "interrupted" || result.status == "failed") {
    result.notes.push_back(
        fmt::format("{} ({}); the rows so far are compared", result.status, result.reason));
  }
  if (const auto warnings = json->find("warnings"); warnings != json->end()) {
    for (const auto& warning : *warnings) {
      if (warning.is_string())
        result.notes.push_back("warning: " + printable(warning.get<std::string>()));
    }
  }
  for (const auto& [name, value] : json->items()) {
    const std::string key = printable(name);
    if (value.is_number()) result.summary.emplace_back(key, value.get<double>());
    if (key != "seconds" || !value.is_object()) continue;
    for (const auto& [phase, seconds] : value.items()) {
      if (!seconds.is_number()) continue;
      result.summary.emplace_back("seconds." + printable(phase), seconds);
    }
  }
}

CsvTable read_rows(const fs::path& directory, RunResult& result) {
  const std::string path = (directory / "history.csv").string();
  const CsvTable table = read_csv(path);
  result.records = history_records(table, path);
  if (result.records.empty()) {
    throw FileError(path + ": has no row; nothing can be compared");
  }
  if (table.cut_off) result.notes.push_back(cut_off_note);
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const std::string& name = table.columns[c];
    result.last_row.emplace_back(name, table.rows.back()[c]);
    if (find_history_column(name) != nullptr) continue;
    result.gauges.push_back(result.last_row.back());
  }
  return table;
}

double least_horizon(const PlotBody& body) {
  double longest = 2.0 * body.spacing;
  for (const auto& [i, j] : body.broken_bonds) {
    const Vector3 &from = body.positions[i], &to = body.positions[j];
    longest = std::max(longest, std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]));
  }
  return longest;
}

/// Returns the solid particles of a field file. In files without volumes each has a lattice cell.
CrackPattern solid_part(const PlotBody& body, const VtuGrid& grid) {
  const VtuArray* volumes = grid.find_point_data("volume");
  if (volumes != nullptr && volumes->values.size() != body.positions.size()) volumes = nullptr;
  const double cell = std::pow(body.spacing, body.dim) * grid.field("thickness", 1.0);
  CrackPattern pattern;
  pattern.dim = body.dim;
  for (Index i = 0; i < body.size(); ++i) {
    const std::size_t at = static_cast<std::size_t>(i);
    if (body.kind[at] != 0) continue;
    for (std::size_t a = 0; a < static_cast<std::size_t>(body.dim); ++a) {
      pattern.positions.push_back(body.positions[at][a]);
    }
    pattern.damage.push_back(body.damage[at]);
    pattern.volumes.push_back(volumes != nullptr ? volumes->values[at] : cell);
  }
  return pattern;
}

void read_last_fields(const fs::path& directory, RunResult& result) {
  std::vector<PvdEntry> entries;
  if (fs::exists(directory / "fields.pvd")) entries = read_pvd((directory / "fields.pvd").string());
  if (entries.empty()) {
    result.notes.emplace_back("no field file: cracks cannot be compared");
    return;
  }
  const std::string path = (directory / entries.back().file).string();
  const VtuGrid grid = read_vtu(path);
  const PlotBody body = read_body(grid, path);
  result.body = solid_part(body, grid);
  const double horizon = number_of(result.summary, "horizon");
  result.horizon = horizon > 0.0 ? horizon : least_horizon(body);
}

}  // namespace

double number_of(const NamedNumbers& numbers, const std::string& name) {
  const auto found = std::find_if(numbers.begin(), numbers.end(),
                                  [&](const auto& entry) { return entry.first == name; });
  return found == numbers.end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
}

std::size_t RunResult::peak_number() const {
  const double load = number_of(summary, "peak_load");
  const double displacement = number_of(summary, "peak_displacement");
  const auto row = std::ranges::find_if(records, [&](const StepRecord& record) {
    return record.load == load && record.displacement == displacement;
  });
  return row == records.end() ? peak_row(records) : static_cast<std::size_t>(row - records.begin());
}

Index row_of_choice(const std::string& directory, const std::string& choice) {
  if (choice != "peak" && choice != "last") return std::atoi(choice.c_str());
  const RunResult result = read_run_numbers(directory);
  return choice == "last" ? result.records.back().step : result.peak().step;
}

RunResult read_run_numbers(const std::string& directory) {
  require_result(directory);
  RunResult result;
  result.directory = directory;
  result.name = directory_name(directory);
  result.labels = read_labels(directory);
  const CsvTable table = read_rows(directory, result);
  read_summary(directory, result);
  for (const auto& [name, value] : result.gauges) {
    const auto column = static_cast<std::size_t>(table.column(name));
    result.gauges_at_peak.emplace_back(name, table.rows[result.peak_number()][column]);
  }
  return result;
}

RunResult read_run_result(const std::string& directory) {
  RunResult result = read_run_numbers(directory);
  read_last_fields(directory, result);
  return result;
}

}  // namespace perilink

#include "app/report/report_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/compare/run_result.hpp"
#include "app/plot/plot_curve.hpp"
#include "app/report/report_body.hpp"
#include "app/report/report_rows.hpp"
#include "app/report/report_words.hpp"
#include "app/scan/scan_table.hpp"
#include "base/error.hpp"
#include "base/files.hpp"
#include "base/plain_text.hpp"
#include "io/text/csv.hpp"
#include "io/text/input_text.hpp"
#include "results/history_file.hpp"
#include "results/result_directory.hpp"
#include "results/summary_file.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A run while its report is made.
struct ReportedRun {
  fs::path directory;
  Json summary;    ///< summary.json; without one an empty object
  TomlValue root;  ///< case.toml; without one an empty table
  UnitNames units;
  PlotLabels labels;
  Json json;  ///< what the report shows
};

void note(ReportedRun& run, const std::string& text) { run.json["notes"].push_back(text); }

/// Reads the case that the run wrote. A report without it is better than none.
void read_case(ReportedRun& run, ReportStreams& streams) {
  const std::string path = (run.directory / "case.toml").string();
  if (!fs::exists(path)) return note(run, "case.toml is missing, so the case is not described");
  try {
    const std::string text = read_input_text(path);
    run.root = parse_toml(text, path);
    run.json["case"] = streams.add(printable(text));
  } catch (const Error& error) {
    note(run, fmt::format("the case cannot be read: {}", error.what()));
  }
}

void read_summary(ReportedRun& run) {
  const auto summary = read_summary_file(run.directory);
  run.summary = summary ? *summary : Json::object();
  run.labels = read_labels(run.directory);
  run.units = UnitNames::of(summary ? summary_text(*summary, "units", run.directory) : "");
  const std::string status = summary ? summary_text(*summary, "status", run.directory) : "unknown";
  const std::string values = scanned_values(run.directory);
  run.json["directory"] = printable(directory_name(run.directory));
  run.json["name"] = values.empty() ? run.json["directory"].get<std::string>() : printable(values);
  run.json["title"] = printable(run.labels.title);
  run.json["analysis"] = run.labels.analysis;
  run.json["status"] = status;
  run.json["is_running"] = status == "running";
  run.json["length_unit"] = run.units.length;
  run.json["unit_names"] = summary ? summary_text(*summary, "units", run.directory) : "";
  run.json["notes"] = Json::array();
  if (!summary) {
    note(run, "the run was killed or is not finished: it has no summary.json");
  } else if (status == "running") {
    note(run, "the run is not finished, or it was killed; the report shows the rows so far");
  }
}

/// Returns the row of the peak in the summary, else that of the largest |load|.
std::size_t peak_of(const ReportedRun& run, const std::vector<StepRecord>& records) {
  RunResult result;
  result.records = records;
  for (const auto& [name, value] : run.summary.items()) {
    if (value.is_number()) result.summary.emplace_back(name, value.get<double>());
  }
  return result.peak_number();
}

/// Returns the place of the first row from a chosen one on (row_of_choice).
std::size_t place_of(const std::string& choice, const std::vector<StepRecord>& records,
                     std::size_t peak) {
  if (choice == "peak") return peak;
  const Index step = choice == "last" ? records.back().step : std::atoi(choice.c_str());
  const auto row = std::ranges::lower_bound(records, step, {}, &StepRecord::step);
  return std::min(static_cast<std::size_t>(row - records.begin()), records.size() - 1);
}

/// Adds the rows of the history. \param first  row that is shown first
/// \return row of the peak, or its time, as in fields.pvd
double add_rows(ReportedRun& run, ReportStreams& streams, const std::string& first) {
  const std::string path = (run.directory / "history.csv").string();
  const CsvTable table = read_csv(path);
  const std::vector<StepRecord> records = history_records(table, path);
  if (table.cut_off) note(run, cut_off_note);
  std::vector<double> loads;
  for (const StepRecord& record : records) loads.push_back(record.load);
  const std::vector<std::size_t> shown = shown_rows(loads, most_report_rows);
  Json& rows = run.json["rows"];
  rows["all"] = records.size();
  rows["shown"] = shown.size();
  rows["stream"] = streams.add(text_of_rows(read_regular_file(path), shown));
  rows["columns"] = Json::array();
  for (const std::string& column : table.columns) {
    const HistoryColumn* known = find_history_column(column);
    rows["columns"].push_back({{"name", printable(column)},
                               {"unit", unit_of_column(column, run.root, run.units)},
                               {"begins_at_zero", known == nullptr || known->begins_at_zero},
                               {"is_gauge", known == nullptr}});
  }
  if (records.empty()) {
    note(run, "history.csv has no row yet");
    return 0.0;
  }
  const std::vector<CurvePoint> events = event_path_of(records, run.labels);
  if (events.size() > events_for_envelope && records.front().stage == 0) {
    for (const CurvePoint& at : smooth_envelope(events, envelope_window(events.size()))) {
      rows["envelope"].push_back({at.displacement, at.load});
    }
  }
  const std::size_t peak = peak_of(run, records);
  rows["peak"] = {records[peak].displacement, records[peak].load};
  rows["start"] = std::ranges::lower_bound(shown, place_of(first, records, peak)) - shown.begin();
  const int time = std::max(table.column("time"), table.column("step"));
  return time < 0 ? 0.0 : table.rows[peak][static_cast<std::size_t>(time)];
}

/// Points of pre-cracks, for the picture of the body.
Json cracks_of(const TomlValue& root) {
  Json cracks = Json::array();
  const TomlValue* list = root.find("cracks");
  for (const TomlValue& crack : list == nullptr ? std::vector<TomlValue>{} : list->items) {
    const TomlValue* points = crack.find("points");
    if (points == nullptr) points = crack.find("corners");
    if (points == nullptr) continue;  // a group of the mesh
    Json line = Json::array();
    for (const TomlValue& point : points->items) {
      Json at = Json::array();
      for (const TomlValue& coordinate : point.items) at.push_back(coordinate.number);
      line.push_back(std::move(at));
    }
    cracks.push_back(std::move(line));
  }
  return cracks;
}

/// Replaces every text of a summary by a printable one.
Json printable_json(const Json& value) {
  if (value.is_string()) return printable(value.get<std::string>());
  if (!value.is_structured()) return value;
  Json result = value.is_array() ? Json::array() : Json::object();
  for (const auto& [key, item] : value.items()) {
    if (value.is_array()) {
      result.push_back(printable_json(item));
    } else {
      result[printable(key)] = printable_json(item);
    }
  }
  return result;
}

/// Adds units of the numbers in the summary and its lists, by name.
void add_units(const Json& value, const UnitNames& names, Json& units) {
  for (const auto& [key, item] : value.items()) {
    if (item.is_structured()) add_units(item, names, units);
    const std::string unit = value.is_object() ? unit_of_quantity(key, names) : "";
    if (!unit.empty()) units[printable(key)] = unit;
  }
}

void add_words(ReportedRun& run) {
  run.json["sentences"] = sentences_of_run(run.summary, run.root, run.units);
  run.json["tables"] = Json::array();
  for (const WordedTable& table : tables_of_case(run.root, run.units)) {
    run.json["tables"].push_back({{"heading", table.heading}, {"entries", table.entries}});
  }
  run.json["summary"] = printable_json(run.summary);
  run.json["units"] = Json::object();
  add_units(run.summary, run.units, run.json["units"]);
  for (const char* column : {"axial_stress", "axial_force", "slip", "bond_stress"}) {
    run.json["units"][column] = unit_of_quantity(column, run.units);
  }
}

}  // namespace

Json report_run(const std::string& directory, std::size_t most, ReportStreams& streams,
                const std::string& at) {
  require_result(directory);
  ReportedRun run;
  run.directory = directory;
  run.json = Json::object();
  read_summary(run);
  read_case(run, streams);
  const double peak_time = add_rows(run, streams, at);
  const std::size_t used = streams.texts().back().size();
  run.json["body"] =
      report_body(run.directory, peak_time, std::max(most, used) - used, run.units, streams);
  run.json["cracks"] = cracks_of(run.root);
  add_words(run);
  if (run.json["body"].is_null()) note(run, "there is no field file, so the body is not shown");
  return std::move(run.json);
}

}  // namespace perilink

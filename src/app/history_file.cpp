#include "app/history_file.hpp"

#include <array>
#include <cmath>
#include <type_traits>

#include "base/error.hpp"

namespace perilink {
namespace {

constexpr double seconds_between_flushes = 0.5;

/// The one list of columns, from which both the writer and the reader are made.
struct Column {
  const char* name;
  double (*get)(const StepRecord&);
  void (*set)(StepRecord&, double);
};

template <auto Member>
constexpr Column column(const char* name) {
  return {name, [](const StepRecord& record) { return static_cast<double>(record.*Member); },
          [](StepRecord& record, double value) {
            using Value = std::remove_reference_t<decltype(record.*Member)>;
            record.*Member = static_cast<Value>(value);
          }};
}

constexpr std::array columns = {
    column<&StepRecord::step>("step"),
    column<&StepRecord::broken_bonds>("broken_bonds"),
    column<&StepRecord::load_factor>("load_factor"),
    column<&StepRecord::load>("load"),
    column<&StepRecord::displacement>("displacement"),
    column<&StepRecord::strain_energy>("strain_energy"),
    column<&StepRecord::dissipated_energy>("dissipated_energy"),
    column<&StepRecord::external_work>("external_work"),
    column<&StepRecord::released_energy>("released_energy"),
    column<&StepRecord::yield_events>("yield_events"),
    column<&StepRecord::residual>("residual"),
    column<&StepRecord::factorizations>("factorizations"),
    column<&StepRecord::element>("element"),
};

std::vector<std::string> with(std::vector<std::string> names,
                              const std::vector<std::string>& more) {
  names.insert(names.end(), more.begin(), more.end());
  return names;
}

}  // namespace

std::vector<std::string> history_columns() {
  std::vector<std::string> names;
  for (const Column& column : columns) names.emplace_back(column.name);
  return names;
}

HistoryFile::HistoryFile(const std::string& directory, const std::vector<std::string>& gauges)
    : history_(directory + "/history.csv", with(history_columns(), gauges)),
      timing_(directory + "/timing.csv", {"step", "seconds"}) {}

void HistoryFile::append(const StepRecord& record, std::span<const double> gauges) {
  std::vector<double> row;
  row.reserve(columns.size() + gauges.size());
  for (const Column& column : columns) row.push_back(column.get(record));
  row.insert(row.end(), gauges.begin(), gauges.end());
  history_.write_row(row);
  timing_.write_row({static_cast<double>(record.step), record.seconds});
  if (since_flush_.seconds() > seconds_between_flushes) flush();
}

void HistoryFile::flush() {
  history_.flush();
  timing_.flush();
  since_flush_.restart();
}

std::vector<StepRecord> read_history(const std::string& path) {
  const CsvTable table = read_csv(path);
  for (const char* needed : {"load", "displacement"}) {
    if (table.column(needed) < 0) throw FileError(path + ": has no column '" + needed + "'");
  }
  std::vector<StepRecord> records(table.rows.size());
  for (const Column& column : columns) {
    const int place = table.column(column.name);
    if (place < 0) continue;
    for (std::size_t row = 0; row < records.size(); ++row) {
      const double value = table.rows[row][static_cast<std::size_t>(place)];
      if (std::isfinite(value)) column.set(records[row], value);
    }
  }
  return records;
}

}  // namespace perilink

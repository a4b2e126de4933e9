#include "app/results/history_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
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
  bool counts;  ///< holds whole numbers
};

template <auto Member>
constexpr Column column(const char* name) {
  using Value = std::remove_reference_t<decltype(StepRecord{}.*Member)>;
  return {name, [](const StepRecord& record) { return static_cast<double>(record.*Member); },
          [](StepRecord& record, double value) { record.*Member = static_cast<Value>(value); },
          std::is_integral_v<Value>};
}

/// Squares of what is larger leave the range of double precision, and axes of what is finite.
constexpr double largest_number = 1e150;

/// Whether an integer of a row can hold it; -1 stands for no element.
bool is_count(double value) {
  return value >= -1.0 && value <= std::numeric_limits<Index>::max() && std::trunc(value) == value;
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
  if (since_flush_.seconds() < seconds_between_flushes) return;
  history_.flush();
  timing_.flush();
  since_flush_.restart();
}

void HistoryFile::finish() {
  history_.finish();
  timing_.finish();
}

std::vector<StepRecord> history_records(const CsvTable& table, const std::string& path) {
  for (const char* needed : {"load", "displacement"}) {
    if (table.column(needed) < 0) throw FileError(path + ": has no column '" + needed + "'");
  }
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    for (const double value : table.rows[row]) {
      if (std::abs(value) <= largest_number) continue;
      throw FileError(
          fmt::format("{}: row {} holds {}, too large for any run", path, row + 1, value));
    }
  }
  std::vector<StepRecord> records(table.rows.size());
  for (const Column& column : columns) {
    const int place = table.column(column.name);
    if (place < 0) continue;
    for (std::size_t row = 0; row < records.size(); ++row) {
      const double value = table.rows[row][static_cast<std::size_t>(place)];
      if (column.counts && !is_count(value)) {
        throw FileError(fmt::format("{}: row {}: column {} holds {}, which is no count", path,
                                    row + 1, column.name, value));
      }
      column.set(records[row], value);
    }
  }
  for (std::size_t row = 1; row < records.size() && table.column("step") >= 0; ++row) {
    if (records[row].step > records[row - 1].step) continue;
    throw FileError(fmt::format("{}: row {}: step {} comes after step {}", path, row + 1,
                                records[row].step, records[row - 1].step));
  }
  return records;
}

std::vector<StepRecord> read_history(const std::string& path) {
  return history_records(read_csv(path), path);
}

}  // namespace perilink

#include "results/history_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.hpp"
#include "base/files.hpp"
#include "io/case/sections/case_kinds.hpp"

namespace perilink {
namespace {

constexpr double seconds_between_flushes = 0.5;

/// Largest number read; squares of larger ones overflow double precision, and plots need finite
/// ranges.
constexpr double largest_number = 1e150;

/// Whether an integer field of a row can hold the value; -1 stands for no element.
bool is_count(double value) {
  return value >= -1.0 && value <= std::numeric_limits<Index>::max() && std::trunc(value) == value;
}

std::vector<std::string> all_columns(const CaseFile& input) {
  std::vector<std::string> names = history_columns(input);
  for (const GaugeSection& gauge : input.gauges) names.push_back(gauge.name);
  return names;
}

}  // namespace

HistoryFile::HistoryFile(const std::string& directory, const CaseFile& input)
    : history_(directory + "/history.csv", all_columns(input)),
      timing_(directory + "/timing.csv", {"step", "seconds"}) {
  choose_columns(input);
}

HistoryFile::HistoryFile(const std::string& directory, const CaseFile& input, Sizes kept)
    // Both files are checked before one is cut.
    : history_((require_size(directory + "/timing.csv", kept.timing), directory + "/history.csv"),
               all_columns(input), kept.history),
      timing_(directory + "/timing.csv", {"step", "seconds"}, kept.timing) {
  choose_columns(input);
}

void HistoryFile::choose_columns(const CaseFile& input) {
  const auto choose = [&](const auto& columns) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if (columns[k].is_shown(input)) shown_.push_back(k);
    }
  };
  is_quasistatic(input.analysis.type) ? choose(columns_of(StepRecord{}))
                                      : choose(columns_of(ExplicitRecord{}));
}

template <class Row>
std::vector<double> HistoryFile::values_of(const Row& record) const {
  std::vector<double> row;
  for (const std::size_t k : shown_) row.push_back(columns_of(record)[k].get(record));
  return row;
}

void HistoryFile::append(const StepRecord& record, std::span<const double> gauges) {
  write(values_of(record), gauges, record.seconds);
}

void HistoryFile::append(const ExplicitRecord& record, std::span<const double> gauges) {
  write(values_of(record), gauges, since_row_.seconds());
  since_row_.restart();
}

void HistoryFile::write(std::vector<double> row, std::span<const double> gauges, double seconds) {
  row.insert(row.end(), gauges.begin(), gauges.end());
  history_.write_row(row);
  timing_.write_row({row[0], seconds});
  if (since_flush_.seconds() < seconds_between_flushes) return;
  history_.flush();
  timing_.flush();
  since_flush_.restart();
}

void HistoryFile::finish() {
  history_.flush();
  timing_.flush();
}

std::vector<StepRecord> history_records(const CsvTable& table, const std::string& path) {
  for (const char* needed : {"load", "displacement"}) {
    if (table.column(needed) < 0) throw FileError(path + ": has no column '" + needed + "'");
  }
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    for (const double value : table.rows[row]) {
      if (std::abs(value) <= largest_number) continue;
      throw FileError(fmt::format("{}: row {} holds {}, larger than any result of a run", path,
                                  row + 1, value));
    }
  }
  std::vector<StepRecord> records(table.rows.size());
  for (const RowColumn<StepRecord>& column : columns_of(StepRecord{})) {
    const int place = table.column(column.name);
    if (place < 0) continue;
    for (std::size_t row = 0; row < records.size(); ++row) {
      const double value = table.rows[row][static_cast<std::size_t>(place)];
      if (column.counts && !is_count(value)) {
        throw FileError(
            fmt::format("{}: row {}: column {} holds {}, not a whole number of at least -1", path,
                        row + 1, column.name, value));
      }
      column.set(records[row], value);
    }
  }
  for (std::size_t row = 1; row < records.size() && table.column("step") >= 0; ++row) {
    if (records[row].step > records[row - 1].step) continue;
    throw FileError(fmt::format("{}: row {}: step {} follows step {}, but steps must increase",
                                path, row + 1, records[row].step, records[row - 1].step));
  }
  return records;
}

}  // namespace perilink

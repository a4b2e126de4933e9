#include "results/history_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "base/error.hpp"
#include "io/case/sections/case_kinds.hpp"

namespace perilink {
namespace {

constexpr double seconds_between_flushes = 0.5;

/// Feature of a case that a column depends on.
enum class With { nothing, stages, elements, batches };

/// Column of quasistatic histories; writer and reader use the same list.
struct Column {
  const char* name;
  double (*get)(const StepRecord&);
  void (*set)(StepRecord&, double);
  bool counts;  ///< holds whole numbers
  With with;

  bool is_shown(const CaseFile& input) const {
    switch (with) {
      case With::stages: return !input.stages.empty();
      case With::elements: return input.elements.has_value();
      case With::batches:
        return event_tolerance_of(input) > 0.0 && input.analysis.control == LoadControl::events;
      default: return true;
    }
  }
};

template <auto Member>
constexpr Column column(const char* name, With with = With::nothing) {
  using Value = std::remove_reference_t<decltype(StepRecord{}.*Member)>;
  return {name, [](const StepRecord& record) { return static_cast<double>(record.*Member); },
          [](StepRecord& record, double value) { record.*Member = static_cast<Value>(value); },
          std::is_integral_v<Value>, with};
}

/// Largest number read; squares of larger ones overflow double precision, and plots need finite
/// ranges.
constexpr double largest_number = 1e150;

/// Whether an integer field of a row can hold the value; -1 stands for no element.
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
    column<&StepRecord::events>("events", With::batches),
    column<&StepRecord::stage>("stage", With::stages),
    column<&StepRecord::at_constant_load>("avalanche", With::stages),
    column<&StepRecord::side_change>("side_change", With::stages),
    column<&StepRecord::elements>("elements", With::elements),
    column<&StepRecord::constraint_energy>("freed_energy", With::elements),
};

struct TimeColumn {
  enum class Of { every_body, bonds, particles };
  const char* name;
  double (*get)(const ExplicitRecord&);
  Of of = Of::every_body;

  bool is_shown(bool bonds_break) const {
    return of == Of::every_body || (of == Of::bonds) == bonds_break;
  }
};

/// Columns of time histories.
constexpr std::array time_columns = {
    TimeColumn{"step", [](const ExplicitRecord& r) { return 1.0 * r.step; }},
    TimeColumn{"time", [](const ExplicitRecord& r) { return r.time; }},
    TimeColumn{"load_factor", [](const ExplicitRecord& r) { return r.load_factor; }},
    TimeColumn{"load", [](const ExplicitRecord& r) { return r.load; }},
    TimeColumn{"reaction", [](const ExplicitRecord& r) { return r.support_reaction; }},
    TimeColumn{"displacement", [](const ExplicitRecord& r) { return r.displacement; }},
    TimeColumn{"broken_bonds", [](const ExplicitRecord& r) { return 1.0 * r.broken_bonds; },
               TimeColumn::Of::bonds},
    TimeColumn{"cracked_particles",
               [](const ExplicitRecord& r) { return 1.0 * r.cracked_particles; },
               TimeColumn::Of::particles},
    TimeColumn{"kinetic_energy", [](const ExplicitRecord& r) { return r.energy.kinetic; }},
    TimeColumn{"strain_energy", [](const ExplicitRecord& r) { return r.energy.stored; }},
    TimeColumn{"damped_energy",
               [](const ExplicitRecord& r) {
                 return r.energy.internal_damping + r.energy.external_damping;
               }},
    TimeColumn{"dissipated_energy",
               [](const ExplicitRecord& r) { return r.energy.fractured + r.energy.plastic; }},
    TimeColumn{"external_work", [](const ExplicitRecord& r) { return r.energy.external_work; }},
};

bool is_over_time(const CaseFile& input) { return !is_quasistatic(input.analysis.type); }

std::vector<std::string> all_columns(const CaseFile& input) {
  std::vector<std::string> names = history_columns(input);
  for (const GaugeSection& gauge : input.gauges) names.push_back(gauge.name);
  return names;
}

}  // namespace

std::vector<std::string> history_columns(const CaseFile& input) {
  std::vector<std::string> names;
  if (!is_over_time(input)) {
    for (const Column& column : columns) {
      if (column.is_shown(input)) {
        names.emplace_back(column.name);
      }
    }
    return names;
  }
  const bool bonds_break = !has_state_based_particles(input.body);
  for (const TimeColumn& column : time_columns) {
    if (column.is_shown(bonds_break)) names.emplace_back(column.name);
  }
  return names;
}

bool is_history_column(const std::string& name) {
  const auto named = [&](const auto& column) { return column.name == name; };
  return std::any_of(columns.begin(), columns.end(), named) ||
         std::any_of(time_columns.begin(), time_columns.end(), named);
}

HistoryFile::HistoryFile(const std::string& directory, const CaseFile& input)
    : bonds_break_(!has_state_based_particles(input.body)),
      history_(directory + "/history.csv", all_columns(input)),
      timing_(directory + "/timing.csv", {"step", "seconds"}) {
  choose_columns(input);
}

HistoryFile::HistoryFile(const std::string& directory, const CaseFile& input, Sizes kept)
    : bonds_break_(!has_state_based_particles(input.body)),
      history_(directory + "/history.csv", all_columns(input), kept.history),
      timing_(directory + "/timing.csv", {"step", "seconds"}, kept.timing) {
  choose_columns(input);
}

void HistoryFile::choose_columns(const CaseFile& input) {
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (columns[k].is_shown(input)) shown_.push_back(k);
  }
}

void HistoryFile::append(const StepRecord& record, std::span<const double> gauges) {
  std::vector<double> row;
  for (const std::size_t k : shown_) row.push_back(columns[k].get(record));
  write(std::move(row), gauges, record.seconds);
}

void HistoryFile::append(const ExplicitRecord& record, std::span<const double> gauges) {
  std::vector<double> row;
  for (const TimeColumn& column : time_columns) {
    if (column.is_shown(bonds_break_)) row.push_back(column.get(record));
  }
  write(std::move(row), gauges, since_row_.seconds());
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
  for (const Column& column : columns) {
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

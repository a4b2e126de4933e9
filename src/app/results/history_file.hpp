#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/dynamics/explicit_run.hpp"
#include "analysis/quasistatic/observer.hpp"
#include "base/timer.hpp"
#include "io/case/case_file.hpp"
#include "io/text/csv.hpp"

namespace perilink {

/// Columns of the history of a case, without its gauges.
std::vector<std::string> history_columns(const CaseFile& input);

/// Whether a column belongs to runs of some kind; else it is that of a gauge.
bool is_history_column(const std::string& name);

/// Writes DIR/history.csv (what happened, the same in every run on a machine) and DIR/timing.csv
/// (how long each row took) of any run. Rows reach the disk at most twice a second, since runs make
/// thousands of events per second, and when the writer is destroyed.
class HistoryFile {
 public:
  /// \throws FileError
  HistoryFile(const std::string& directory, const CaseFile& input);

  /// A row of a quasistatic run.
  /// \param gauges  their values, in the order of the case
  void append(const StepRecord& record, std::span<const double> gauges = {});
  /// The same of a run over time, whose rows are timed here.
  void append(const ExplicitRecord& record, std::span<const double> gauges = {});
  /// Brings all rows to the disk: call it at the end, to learn of a full disk.
  /// \throws FileError
  void finish();

 private:
  void write(std::vector<double> row, std::span<const double> gauges, double seconds);

  bool bonds_break_;                ///< and not particles
  std::vector<std::size_t> shown_;  ///< columns of quasistatic runs
  CsvWriter history_;
  CsvWriter timing_;
  Timer since_row_;
  Timer since_flush_;
};

/// What to say where CsvTable::cut_off is set.
inline constexpr const char* cut_off_note =
    "history.csv ends within a row, which is left out: the run was killed, or the file is damaged";

/// Rows of a history.csv; columns that the file lacks keep their defaults.
/// \param path  only named in messages
/// \throws FileError when one of the columns load and displacement is missing, or when numbers
/// cannot be those of a run: counts that are no whole numbers, steps that do not grow
std::vector<StepRecord> history_records(const CsvTable& table, const std::string& path);

}  // namespace perilink

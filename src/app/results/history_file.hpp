#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/quasistatic/observer.hpp"
#include "base/timer.hpp"
#include "io/text/csv.hpp"

namespace perilink {

/// Writes DIR/history.csv (what happened, the same in every run on a machine) and DIR/timing.csv
/// (how long each step took). Rows reach the disk at most twice a second, since runs make thousands
/// of events per second, and when the writer is destroyed.
class HistoryFile {
 public:
  /// \param gauges  names of further columns
  /// \throws FileError
  explicit HistoryFile(const std::string& directory, const std::vector<std::string>& gauges = {});

  /// \param gauges  values of the further columns
  void append(const StepRecord& record, std::span<const double> gauges = {});
  /// Brings all rows to the disk: call it at the end, to learn of a full disk.
  /// \throws FileError
  void finish();

 private:
  CsvWriter history_;
  CsvWriter timing_;
  Timer since_flush_;
};

/// Columns that every history has.
std::vector<std::string> history_columns();

/// What to say where CsvTable::cut_off is set.
inline constexpr const char* cut_off_note =
    "history.csv ends within a row, which is left out: the run was killed, or the file is damaged";

/// Rows of a history.csv; columns that the file lacks keep their defaults.
/// \param path  only named in messages
/// \throws FileError when one of the columns load and displacement is missing, or when numbers
/// cannot be those of a run: counts that are no whole numbers, steps that do not grow
std::vector<StepRecord> history_records(const CsvTable& table, const std::string& path);

/// The same from the file.
std::vector<StepRecord> read_history(const std::string& path);

}  // namespace perilink

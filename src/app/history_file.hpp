#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/observer.hpp"
#include "base/timer.hpp"
#include "io/csv.hpp"

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
  /// Call it at the end and when a signal stops the run, to learn of a full disk.
  /// \throws FileError
  void flush();

 private:
  CsvWriter history_;
  CsvWriter timing_;
  Timer since_flush_;
};

/// Columns that every history has.
std::vector<std::string> history_columns();

/// Rows of a history.csv; columns that the file lacks keep their defaults.
/// \throws FileError when the file or one of its columns load and displacement is missing
std::vector<StepRecord> read_history(const std::string& path);

}  // namespace perilink

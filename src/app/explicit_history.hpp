#pragma once

#include <string>
#include <vector>

#include "analysis/explicit_analysis.hpp"
#include "base/timer.hpp"
#include "io/csv.hpp"

namespace perilink {

/// Columns of the history of an explicit analysis.
std::vector<std::string> explicit_history_columns();

/// Writes DIR/history.csv, which depends on nothing but the case, and DIR/timing.csv with the wall
/// time of each row; like HistoryFile for explicit analyses.
class ExplicitHistory {
 public:
  /// \throws FileError
  explicit ExplicitHistory(const std::string& directory);

  void append(const ExplicitRecord& record);
  /// \throws FileError
  void flush();

 private:
  CsvWriter history_;
  CsvWriter timing_;
  Timer since_row_;
  Timer since_flush_;
};

}  // namespace perilink

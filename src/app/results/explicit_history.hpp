#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/dynamics/explicit_run.hpp"
#include "base/timer.hpp"
#include "io/case/case_file.hpp"
#include "io/text/csv.hpp"

namespace perilink {

/// What a history counts as cracked.
enum class CrackCount { cracked_particles, broken_bonds };

/// Bonds of a network break, state-based particles crack.
CrackCount crack_count(const CaseFile& input);

/// Columns of the history of an explicit analysis.
std::vector<std::string> explicit_history_columns(CrackCount count);

/// Writes DIR/history.csv, which depends on nothing but the case, and DIR/timing.csv with the wall
/// time of each row; like HistoryFile for explicit analyses.
class ExplicitHistory {
 public:
  /// \throws FileError
  /// \param gauges  names of further columns
  ExplicitHistory(const std::string& directory, CrackCount count,
                  const std::vector<std::string>& gauges = {});

  /// \param gauges  values of the further columns
  void append(const ExplicitRecord& record, std::span<const double> gauges = {});
  /// Brings all rows to the disk. \throws FileError
  void finish();

 private:
  CrackCount count_;
  CsvWriter history_;
  CsvWriter timing_;
  Timer since_row_;
  Timer since_flush_;
};

}  // namespace perilink

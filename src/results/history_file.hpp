#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/timer.hpp"
#include "io/text/csv.hpp"
#include "results/history_columns.hpp"

namespace perilink {

/// Writes DIR/history.csv, the same in every run on a machine, and DIR/timing.csv with the time of
/// each row. Rows are flushed at most twice a second, because runs have thousands of events per
/// second, and by the destructor.
class HistoryFile {
 public:
  /// Sizes of the two files [bytes].
  struct Sizes {
    std::size_t history = 0, timing = 0;

    template <class Archive>
    void serialize(Archive& archive) {
      archive(history, timing);
    }
  };

  /// \throws FileError
  HistoryFile(const std::string& directory, const CaseFile& input);
  /// Goes on with existing files.
  /// \param kept  the rest is removed
  /// \throws FileError
  HistoryFile(const std::string& directory, const CaseFile& input, Sizes kept);

  /// Appends a row of a quasistatic run.
  /// \param gauges  gauge values, in the order of the case
  void append(const StepRecord& record, std::span<const double> gauges = {});
  /// Appends a row of a time-dependent run and measures its time.
  void append(const ExplicitRecord& record, std::span<const double> gauges = {});
  /// Flushes all rows; call it at the end to detect a full disk.
  /// \throws FileError
  void finish();
  /// Returns the sizes after finish().
  Sizes sizes() const { return {history_.size(), timing_.size()}; }

 private:
  void choose_columns(const CaseFile& input);
  template <class Row>
  std::vector<double> values_of(const Row& record) const;
  void write(std::vector<double> row, std::span<const double> gauges, double seconds);

  std::vector<std::size_t> shown_;  ///< of columns_of()
  CsvWriter history_;
  CsvWriter timing_;
  Timer since_row_;
  Timer since_flush_;
};

/// Note for files with CsvTable::cut_off.
inline constexpr const char* cut_off_note =
    "history.csv ends within a row, which is ignored: the run was killed, "
    "or the file is damaged";

/// Returns the rows of a history.csv; missing columns keep their defaults.
/// \param path  path of the table, for messages
/// \throws FileError when one of the columns load and displacement is missing, or when numbers
/// are invalid: fractional counts, steps that do not increase
std::vector<StepRecord> history_records(const CsvTable& table, const std::string& path);

}  // namespace perilink

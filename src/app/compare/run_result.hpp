#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/quasistatic/observer.hpp"
#include "app/compare/crack_overlap.hpp"
#include "app/plot/plot_labels.hpp"

namespace perilink {

/// Pairs of name and number, in the order of the file.
using NamedNumbers = std::vector<std::pair<std::string, double>>;

/// Returns the number with a name; not-a-number where it is missing.
double number_of(const NamedNumbers& numbers, const std::string& name);

/// Result of `perilink run` for any analysis type, finished or not.
struct RunResult {
  std::string directory;  ///< as given
  std::string name;       ///< last part of its path
  PlotLabels labels;
  std::string units;                    ///< from summary.json; empty: none
  std::string status;                   ///< from summary.json; empty: no summary.json
  std::string reason;                   ///< for its end, from summary.json
  NamedNumbers summary;                 ///< numbers of summary.json; `seconds` gives seconds.KEY
  std::vector<StepRecord> records;      ///< rows of history.csv
  NamedNumbers last_row;                ///< all columns of history.csv
  NamedNumbers gauges, gauges_at_peak;  ///< at the last row, and at the peak
  std::optional<CrackPattern> body;     ///< from the last field file
  /// Horizon from summary.json, else the longest broken bond or two spacings, whichever is larger
  /// (a lattice bond depends on the neighbours of both ends); 0 without fields [length].
  double horizon = 0.0;
  std::vector<std::string> notes;  ///< missing data and unfinished runs

  /// Returns the row of the peak in summary.json, else the row of the largest |load|.
  const StepRecord& peak() const { return records[peak_number()]; }
  std::size_t peak_number() const;
};

/// Returns the number of a row that a user chose: "peak" (RunResult::peak), "last", or a number. Of
/// runs over time it is the step. \throws FileError as read_run_numbers()
Index row_of_choice(const std::string& directory, const std::string& choice);

/// Reads a result without its body. \throws FileError as read_run_result()
RunResult read_run_numbers(const std::string& directory);

/// \throws FileError when the directory does not hold at least one row of a history, or a file
/// cannot be read
RunResult read_run_result(const std::string& directory);

}  // namespace perilink

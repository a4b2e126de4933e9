#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/quasistatic/observer.hpp"
#include "app/compare/crack_overlap.hpp"
#include "app/plot/plot_labels.hpp"

namespace perilink {

/// Numbers under their names, in the order of the file.
using NamedNumbers = std::vector<std::pair<std::string, double>>;

/// The number of a name; not-a-number where there is none.
double number_of(const NamedNumbers& numbers, const std::string& name);

/// What `perilink run` left in a directory, of any kind of analysis, finished or not.
struct RunResult {
  std::string directory;  ///< as given
  std::string name;       ///< last part of its path
  PlotLabels labels;
  std::string units;                ///< from summary.json; empty: none
  std::string status;               ///< from summary.json; empty: there is none
  NamedNumbers summary;             ///< numbers of summary.json, those of `seconds` as seconds.KEY
  std::vector<StepRecord> records;  ///< rows of history.csv
  NamedNumbers last_row;            ///< all columns of history.csv
  NamedNumbers gauges, gauges_at_peak;  ///< at the last row, and at the peak
  std::optional<CrackPattern> body;     ///< from the last field file
  /// From summary.json, else the longest broken bond, or two spacings where that is more: the reach
  /// of a lattice whose bonds see the neighbours of either end; 0 without fields [length].
  double horizon = 0.0;
  std::vector<std::string> notes;  ///< what is missing

  /// The row of the peak that summary.json names; without one that of the largest |load|.
  const StepRecord& peak() const { return records[peak_number()]; }
  std::size_t peak_number() const;
};

/// \throws FileError when the directory does not hold at least one row of a history, or a file
/// cannot be read
RunResult read_run_result(const std::string& directory);

}  // namespace perilink

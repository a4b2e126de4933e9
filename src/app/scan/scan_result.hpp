#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "app/compare/run_result.hpp"
#include "app/process/process_pool.hpp"
#include "results/summary_file.hpp"

/// \file
/// Results of the members of a scan, from their directories.

namespace perilink {

/// Numbers of summary.json in the table of a scan.
inline constexpr std::array<std::string_view, 10> scan_quantities = {
    "peak_load",          "peak_displacement", "first_peak_load", "first_peak_displacement",
    "smoothed_peak_load", "initial_stiffness", "external_work",   "dissipated_energy",
    "strain_energy",      "broken_bonds"};

/// Result of one member.
struct ScanResult {
  std::string status = "not run";  ///< of summary.json
  std::string reason;              ///< for its end
  NamedNumbers numbers;            ///< of summary.json; empty unless finished()
  NamedNumbers gauges;             ///< at the peak
  double seconds = 0.0;            ///< set-up, analysis and output
  bool kept = false;               ///< from an earlier scan

  /// Whether the run came to its end: completed, collapsed or nothing_breaks.
  bool finished() const { return is_end(status); }
};

/// Returns the result in a directory; status "not run" where it has no summary.json.
/// \throws FileError  where a file is damaged
ScanResult read_scan_result(const std::filesystem::path& directory);

/// Returns the result of a member whose process has ended. Failures are told in its reason.
ScanResult result_of_process(const FinishedProcess& process,
                             const std::filesystem::path& directory);

}  // namespace perilink

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/result_directory.hpp"

namespace perilink {

/// Exit statuses of the program.
enum ExitStatus : int { exit_done = 0, exit_bad_input = 2, exit_solver = 3, exit_interrupted = 4 };

/// Options of commands that read a case.
struct RunOptions {
  std::string case_path;
  std::optional<std::string> directory;
  int threads = 0;  ///< 0: all processors
  bool quiet = false;
  OldResults old_results = OldResults::refused;  ///< kept: goes on with results of the same case
  bool trust_geometry = false;                   ///< gmsh scripts may run commands and write files
  std::vector<std::string> settings = {};        ///< KEY=VALUE, other values of keys of the case
  std::optional<std::string> calibrations = {};  ///< directory of kept calibrations
};

/// Runs a case, `perilink run`.
/// \returns the exit status
int run_case(const RunOptions& options);

/// Runs a convergence study, `perilink converge`; `case_path` names the study file.
/// \returns the exit status
int converge(const RunOptions& options);

/// Options of `perilink compare`.
struct CompareOptions {
  std::string first, second;             ///< directories of the results
  std::optional<std::string> directory;  ///< output directory
  bool quiet = false;
  bool force = false;
};
/// Compares the results of two runs. Prints a table and writes compare.csv and compare.svg.
/// \returns the exit status
/// \throws FileError
int compare(const CompareOptions& options);

/// Options of `perilink report`.
struct ReportOptions {
  std::vector<std::string> directories;  ///< of the results, at least one
  std::optional<std::string> file;       ///< the page; absent: report.html, in the only directory
  std::string at = "last";               ///< row that the page shows first (row_of_choice)
  bool watch = false;                    ///< write the page again until all runs have ended
};
/// Writes an HTML page that shows the results of runs.
/// \returns the exit status
/// \throws FileError
int make_report(const ReportOptions& options);

/// Validates a case, builds its model and prints sizes and expected cost, `perilink check`. Bonds
/// are calibrated only where the given time step must be checked against the critical one. Nothing
/// is solved and no file written.
/// \returns the exit status
int check_case(const RunOptions& options);

/// Options of `perilink scan`.
struct ScanOptions {
  RunOptions run;  ///< of the members; `case_path` names the scan file
  int jobs = 0;    ///< most members at once; 0: as many as have processors
};
/// Runs a case with the sets of values of a scan file, each in a process.
/// \returns the exit status
int scan(const ScanOptions& options);

}  // namespace perilink

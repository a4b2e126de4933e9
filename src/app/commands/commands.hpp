#pragma once

#include <optional>
#include <string>

namespace perilink {

/// Exit statuses of the program.
enum ExitStatus : int { exit_done = 0, exit_bad_input = 2, exit_solver = 3, exit_interrupted = 4 };

/// perilink run
struct RunOptions {
  std::string case_path;
  std::optional<std::string> directory;
  int threads = 0;  ///< 0: all processors
  bool quiet = false;
  bool force = false;
  bool trust_geometry = false;  ///< scripts of gmsh may run commands and write files
};
int run_case(const RunOptions& options);

/// perilink converge: runs a study of a case; the options name the study in place of the case.
int converge(const RunOptions& options);

/// perilink compare
struct CompareOptions {
  std::string first, second;             ///< directories of the results
  std::optional<std::string> directory;  ///< where the comparison goes
  bool quiet = false;
  bool force = false;
};
/// Compares the results of two runs: a table, compare.csv and compare.svg.
/// \returns the exit status
/// \throws FileError
int compare(const CompareOptions& options);

/// perilink check: validates a case, builds its model without calibrating the bonds (but where a
/// time step has to be judged by them), and prints what a run is and will cost; writes no file and
/// solves nothing.
int check_case(const std::string& case_path, bool trust_geometry);

}  // namespace perilink

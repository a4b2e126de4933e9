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
  bool trust_geometry = false;  ///< gmsh scripts may run commands and write files
};
int run_case(const RunOptions& options);

/// perilink converge: runs a convergence study; `case_path` names the study file.
int converge(const RunOptions& options);

/// perilink compare
struct CompareOptions {
  std::string first, second;             ///< directories of the results
  std::optional<std::string> directory;  ///< output directory
  bool quiet = false;
  bool force = false;
};
/// Compares the results of two runs: a table, compare.csv and compare.svg.
/// \returns the exit status
/// \throws FileError
int compare(const CompareOptions& options);

/// perilink check: validates a case, builds its model and prints sizes and expected cost. Bonds are
/// calibrated only where the time step must be checked against them. It writes no file and solves
/// nothing.
int check_case(const std::string& case_path, bool trust_geometry);

}  // namespace perilink

#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "app/commands/commands.hpp"
#include "app/process/console.hpp"
#include "app/process/signals.hpp"
#include "app/process/threads.hpp"
#include "app/run/run_case.hpp"
#include "app/scan/calibration_files.hpp"
#include "io/case/case_settings.hpp"
#include "results/result_directory.hpp"

namespace perilink {
namespace {

int exit_status_of(Termination termination) {
  if (termination == Termination::interrupted) return exit_interrupted;
  return termination == Termination::failed ? exit_solver : exit_done;
}

}  // namespace

int run_case(const RunOptions& options) {
  RunSettings settings{set_threads(options.threads), options.old_results, options.quiet};
  settings.callbacks.on_start = catch_stop_signals;
  settings.callbacks.stop_requested = stop_signal_received;
  settings.callbacks.on_fault = complain;
  if (!options.quiet) settings.callbacks.on_note = complain;
  std::optional<CalibrationFiles> calibrations;
  if (options.calibrations) {
    settings.callbacks.calibrations = &calibrations.emplace(*options.calibrations);
  }
  CaseFile input = read_case_file(options.case_path, parse_settings(options.settings), {});
  input.trust_geometry = options.trust_geometry;
  const std::filesystem::path directory = options.directory
                                              ? std::filesystem::path(*options.directory)
                                              : default_result_directory(options.case_path);
  const RunEnd end = run_case(input, directory, settings);
  if (options.quiet) return exit_status_of(end.termination);
  if (end.ran) {
    fmt::print("{}", end.summary.text);
  } else {
    fmt::print("{}: the run has ended already\n", directory.string());
  }
  return exit_status_of(end.termination);
}

}  // namespace perilink

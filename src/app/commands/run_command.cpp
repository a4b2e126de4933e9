#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <optional>

#include "app/commands/commands.hpp"
#include "app/process/console.hpp"
#include "app/process/signals.hpp"
#include "app/process/threads.hpp"
#include "app/run/run_case.hpp"
#include "app/scan/calibration_files.hpp"
#include "base/error.hpp"
#include "io/case/case_settings.hpp"
#include "results/result_directory.hpp"

namespace perilink {
namespace {

int exit_status_of(const RunEnd& end) {
  if (end.termination == Termination::interrupted) return exit_interrupted;
  if (end.termination != Termination::failed) return exit_done;
  try {
    if (end.error) std::rethrow_exception(end.error);
  } catch (const InputError&) {
    return exit_bad_input;
  } catch (...) {  // reported by run_case()
  }
  return exit_solver;
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
  if (options.quiet) return exit_status_of(end);
  if (end.ran) {
    fmt::print("{}", end.summary.text);
  } else {
    fmt::print("{}: the run has ended already\n", directory.string());
  }
  return exit_status_of(end);
}

}  // namespace perilink

#include "app/scan/scan_result.hpp"

#include <fmt/format.h>

#include <cstring>

#include "base/error.hpp"
#include "results/summary_file.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

/// Exit status of `perilink run`.
constexpr int status_of_interrupted_runs = 4;

/// Returns the first line of a process's errors without the name of the program.
std::string first_error(const FinishedProcess& process) {
  std::string text = process.errors.substr(0, process.errors.find('\n'));
  for (const std::string_view start : {"perilink: ", "bad input: "}) {
    if (text.starts_with(start)) text.erase(0, start.size());
  }
  if (!text.empty()) return text;
  return process.signal != 0
             ? fmt::format("ended by signal {} ({})", process.signal, strsignal(process.signal))
             : fmt::format("ended with exit status {}", process.exit_status);
}

}  // namespace

ScanResult read_scan_result(const fs::path& directory) {
  ScanResult result;
  const auto summary = read_summary_file(directory);
  if (!summary) return result;
  result.status = summary_text(*summary, "status", directory);
  result.reason = summary_text(*summary, "reason", directory);
  if (!result.finished()) return result;
  RunResult run = read_run_numbers(directory.string());
  for (const std::string_view phase : {"set_up", "analysis", "output"}) {
    result.seconds += number_of(run.summary, fmt::format("seconds.{}", phase));
  }
  result.numbers = std::move(run.summary);
  result.gauges = std::move(run.gauges_at_peak);
  return result;
}

ScanResult result_of_process(const FinishedProcess& process, const fs::path& directory) {
  ScanResult result;
  try {
    // A process that was refused or killed leaves no result, or that of an earlier run.
    if (process.exit_status == 0 || process.exit_status == status_of_interrupted_runs) {
      result = read_scan_result(directory);
      if (result.finished() || process.exit_status != 0) return result;
    }
    result.reason = first_error(process);
  } catch (const Error& error) {
    result.reason = error.what();
  }
  result.status = "failed";
  return result;
}

}  // namespace perilink

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "app/commands/commands.hpp"
#include "app/process/console.hpp"
#include "app/process/progress.hpp"
#include "app/process/rank_start.hpp"
#include "app/process/signals.hpp"
#include "app/scan/scan_run.hpp"
#include "app/scan/scan_table.hpp"
#include "base/error.hpp"
#include "base/plain_text.hpp"
#include "results/result_directory.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

void tell_member(const ScanFile& scan, const EndedMember& member) {
  const ScanResult& result = member.result;
  const std::string line =
      fmt::format("[{}/{}] {} ({}): {}{}\n", member.done, member.count, member_name(member.number),
                  member_text(scan.members[member.number].settings), result.status,
                  result.finished() ? ", " + format_duration(result.seconds) : "");
  std::fputs(printable(line).c_str(), stderr);
}

void draw_progress(ProgressBar& progress, std::size_t done, std::size_t count) {
  if (!progress.is_due()) return;
  std::optional<double> part = static_cast<double>(done) / static_cast<double>(count);
  if (*part < 0.5) part.reset();  // members differ in size
  progress.draw(fmt::format("{} of {}", done, counted(count, "member")), part);
}

int exit_status_of_scan(const std::vector<ScanResult>& results) {
  const auto any = [&](const char* status) {
    return std::any_of(results.begin(), results.end(),
                       [&](const ScanResult& result) { return result.status == status; });
  };
  if (stop_signal_received()) {
    complain("interrupted; the results so far are kept, and the same command goes on");
    return exit_interrupted;
  }
  return any("failed") || any("interrupted") ? exit_solver : exit_done;
}

}  // namespace

int scan(const ScanOptions& options) {
  const std::string& path = options.run.case_path;
  ScanFile scan = read_scan_file(path);
  if (is_one_of_many()) {
    throw InputError({path, 0, ""}, "is a scan, which starts processes of its own",
                     "start it without mpiexec; --jobs gives the number of processes");
  }
  ProgressBar progress(options.run.quiet);
  ScanSettings settings;
  settings.directory =
      options.run.directory ? fs::path(*options.run.directory) : default_result_directory(path);
  settings.common = parse_settings(options.run.settings);
  settings.jobs = options.jobs;
  settings.threads = options.run.threads;
  settings.old_results = options.run.old_results;
  settings.trust_geometry = options.run.trust_geometry;
  settings.on_start = catch_stop_signals;
  settings.stop_requested = stop_signal_received;
  settings.on_member = [&](const EndedMember& member) {
    progress.finish();
    if (!options.run.quiet) tell_member(scan, member);
  };
  settings.on_wait = [&](std::size_t done, std::size_t count) {
    draw_progress(progress, done, count);
  };
  const std::vector<CaseFile> cases = read_members(scan, settings.common);
  const std::vector<ScanResult> results = run_scan(scan, cases, settings);
  progress.finish();
  if (!options.run.quiet) {
    say(fmt::format("{}\n{}results in {}\n", scan.title, scan_report(scan, results),
                    settings.directory.string()));
  }
  return exit_status_of_scan(results);
}

}  // namespace perilink

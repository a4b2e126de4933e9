#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "app/commands/commands.hpp"
#include "app/process/console.hpp"
#include "app/process/process_pool.hpp"
#include "app/process/progress.hpp"
#include "app/process/rank_start.hpp"
#include "app/process/signals.hpp"
#include "app/process/threads.hpp"
#include "app/run/resume.hpp"
#include "app/scan/scan_picture.hpp"
#include "app/scan/scan_result.hpp"
#include "app/scan/scan_table.hpp"
#include "base/error.hpp"
#include "base/files.hpp"
#include "base/plain_text.hpp"
#include "io/text/input_text.hpp"
#include "io/text/toml_tree.hpp"
#include "results/result_directory.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

/// A scan, its results so far and the members to run.
struct ScanRun {
  ScanFile scan;
  std::vector<CaseSetting> common;  ///< values of --set, for all members
  fs::path directory;
  std::vector<ScanResult> results;
  std::vector<std::size_t> to_run;

  fs::path place(std::size_t member) const { return directory / member_name(member); }
  /// Returns the directory of calibrations that members share, which goes when all have ended.
  fs::path calibrations() const { return directory / ".calibrations"; }
};

/// Refuses common values of keys that the scan varies. \throws InputError
void refuse_scanned_keys(const ScanRun& run) {
  for (const CaseSetting& setting : run.common) {
    const bool varies =
        std::any_of(run.scan.members.begin(), run.scan.members.end(),
                    [&](const ScanMember& member) { return member.find(setting.key) != nullptr; });
    if (!varies) continue;
    throw InputError({run.scan.path, from_option, setting.key}, "has other values in the scan",
                     "delete it here or in the scan");
  }
}

/// Returns the values of --set and those of a member.
std::vector<CaseSetting> settings_of(const ScanRun& run, std::size_t member) {
  std::vector<CaseSetting> settings = run.common;
  const std::vector<CaseSetting>& own = run.scan.members[member].settings;
  settings.insert(settings.end(), own.begin(), own.end());
  return settings;
}

/// Reads and checks the case of every member.
/// \throws InputError at the member's values, or at those of --set
std::vector<CaseFile> read_members(ScanRun& run) {
  ScanFile& scan = run.scan;
  const std::string text = read_input_text(scan.case_path);
  if (!scan.seeds.empty()) {
    refuse_large_input(text, scan.case_path);
    give_seeds(scan, parse_toml(text, scan.case_path));
  }
  refuse_scanned_keys(run);
  std::vector<CaseFile> cases;
  for (std::size_t k = 0; k < scan.members.size(); ++k) {
    const ScanMember& member = scan.members[k];
    try {
      cases.push_back(parse_case(text, scan.case_path, settings_of(run, k), {}));
    } catch (const InputError& error) {
      const TomlValue* value = member.find(error.where().key);
      const bool is_common =
          std::any_of(run.common.begin(), run.common.end(),
                      [&](const CaseSetting& setting) { return setting.key == error.where().key; });
      if (value == nullptr && is_common) throw;
      throw InputError({scan.path, value != nullptr ? value->line : member.line, ""},
                       fmt::format("the case refuses member {} ({})", member_name(k),
                                   member_text(member.settings)),
                       error.what());
    }
  }
  return cases;
}

/// Keeps finished results of the same cases and chooses the members to run.
/// \throws FileError  where a directory holds the result of another case
void keep_results(ScanRun& run, const std::vector<CaseFile>& cases, bool force) {
  run.results.resize(cases.size());
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const fs::path place = run.place(k);
    if (!force && holds_a_run(place) && find_results(cases[k], place).is_finished) {
      run.results[k] = read_scan_result(place);
      run.results[k].kept = true;
    } else {
      run.to_run.push_back(k);
    }
  }
}

std::vector<std::string> words_of_member(const ScanRun& run, std::size_t member,
                                         const RunOptions& options) {
  std::vector<std::string> words = {
      "run",
      run.scan.case_path,
      "--out",
      run.place(member).string(),
      "--threads",
      std::to_string(std::max(options.threads, 1)),
      "--quiet",
      options.old_results == OldResults::removed ? "--force" : "--resume",
      "--calibrations",
      run.calibrations().string()};
  if (options.trust_geometry) words.emplace_back("--trust-geometry");
  for (const CaseSetting& setting : settings_of(run, member)) {
    words.push_back("--set");
    words.push_back(setting_text(setting));
  }
  return words;
}

void write_scan_table(const ScanRun& run) {
  write_whole_file((run.directory / "scan.csv").string(), scan_table(run.scan, run.results));
  if (run.scan.seeds.empty()) return;
  write_whole_file((run.directory / "scan_seeds.csv").string(), seed_table(run.scan, run.results));
}

void tell_member(const ScanRun& run, std::size_t member, std::size_t done) {
  const ScanResult& result = run.results[member];
  const std::string line =
      fmt::format("[{}/{}] {} ({}): {}{}\n", done, run.to_run.size(), member_name(member),
                  member_text(run.scan.members[member].settings), result.status,
                  result.finished() ? ", " + format_duration(result.seconds) : "");
  std::fputs(printable(line).c_str(), stderr);
}

/// Runs the members in parallel until all have ended or a signal stops them.
void run_members_of_scan(ScanRun& run, const RunOptions& options, std::size_t jobs) {
  constexpr int milliseconds = 100;  // between looks at signals and progress
  ProcessPool pool("/proc/self/exe", jobs);
  ProgressBar progress(options.quiet);
  std::size_t started = 0, done = 0;
  bool stopped = false;
  while (!pool.idle() || (!stopped && started < run.to_run.size())) {
    while (!stopped && !pool.full() && started < run.to_run.size()) {
      const std::size_t member = run.to_run[started++];
      pool.start(member, words_of_member(run, member, options));
    }
    for (const FinishedProcess& process : pool.wait(milliseconds)) {
      run.results[process.number] = result_of_process(process, run.place(process.number));
      write_scan_table(run);
      progress.finish();
      ++done;
      if (!options.quiet) tell_member(run, process.number, done);
    }
    if (!stopped && stop_signal_received()) {
      stopped = true;
      pool.stop();
    }
    if (!progress.is_due()) continue;
    std::optional<double> part = static_cast<double>(done) / static_cast<double>(run.to_run.size());
    if (*part < 0.5) part.reset();  // members differ in size
    progress.draw(fmt::format("{} of {}", done, counted(run.to_run.size(), "member")), part);
  }
  progress.finish();
  std::error_code ignored;
  if (!stopped) fs::remove_all(run.calibrations(), ignored);
}

int exit_status_of_scan(const ScanRun& run) {
  const auto any = [&](const char* status) {
    return std::any_of(run.results.begin(), run.results.end(),
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
  ScanRun run;
  run.scan = read_scan_file(path);
  if (is_one_of_many()) {
    throw InputError({path, 0, ""}, "is a scan, which starts processes of its own",
                     "start it without mpiexec; --jobs gives the number of processes");
  }
  run.common = parse_settings(options.run.settings);
  const std::vector<CaseFile> cases = read_members(run);
  if (run.scan.title.empty()) run.scan.title = cases.front().title;
  run.directory =
      options.run.directory ? fs::path(*options.run.directory) : default_result_directory(path);
  const ResultDirectory hold(run.directory, options.run.old_results);
  keep_results(run, cases, options.run.old_results == OldResults::removed);
  catch_stop_signals();
  write_scan_table(run);
  const int jobs = options.jobs > 0
                       ? options.jobs
                       : std::max(1, default_threads() / std::max(options.run.threads, 1));
  run_members_of_scan(run, options.run, static_cast<std::size_t>(jobs));
  draw_scan(scan_plot(run.scan, run.results, cases.front().units))
      .save((run.directory / "scan.svg").string());
  if (!options.run.quiet) {
    say(fmt::format("{}\n{}results in {}\n", run.scan.title, scan_report(run.scan, run.results),
                    run.directory.string()));
  }
  return exit_status_of_scan(run);
}

}  // namespace perilink

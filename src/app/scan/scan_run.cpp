#include "app/scan/scan_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/process/process_pool.hpp"
#include "app/process/threads.hpp"
#include "app/run/resume.hpp"
#include "app/scan/scan_picture.hpp"
#include "app/scan/scan_table.hpp"
#include "base/error.hpp"
#include "base/files.hpp"
#include "io/text/input_text.hpp"
#include "io/text/toml_tree.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

/// A scan, its results so far and the members to run.
struct ScanRun {
  const ScanFile& scan;
  const ScanSettings& settings;
  std::vector<ScanResult> results;
  std::vector<std::size_t> to_run;

  fs::path place(std::size_t member) const { return settings.directory / member_name(member); }
  /// Returns the directory of calibrations that members share, which goes when all have ended.
  fs::path calibrations() const { return settings.directory / ".calibrations"; }
};

/// Refuses common values of keys that the scan varies. \throws InputError
void refuse_scanned_keys(const ScanFile& scan, const std::vector<CaseSetting>& common) {
  for (const CaseSetting& setting : common) {
    const bool varies =
        std::any_of(scan.members.begin(), scan.members.end(),
                    [&](const ScanMember& member) { return member.find(setting.key) != nullptr; });
    if (!varies) continue;
    throw InputError({scan.path, from_option, setting.key}, "has other values in the scan",
                     "delete it here or in the scan");
  }
}

/// Returns the values of --set and those of a member.
std::vector<CaseSetting> settings_of(const ScanFile& scan, std::size_t member,
                                     std::vector<CaseSetting> common) {
  const std::vector<CaseSetting>& own = scan.members[member].settings;
  common.insert(common.end(), own.begin(), own.end());
  return common;
}

/// Keeps finished results of the same cases and chooses the members to run.
/// \throws FileError  where a directory holds the result of another case
void keep_results(ScanRun& run, const std::vector<CaseFile>& cases) {
  run.results.resize(cases.size());
  const bool force = run.settings.old_results == OldResults::removed;
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

std::vector<std::string> words_of_member(const ScanRun& run, std::size_t member) {
  const ScanSettings& settings = run.settings;
  std::vector<std::string> words = {
      "run",
      run.scan.case_path,
      "--out",
      run.place(member).string(),
      "--threads",
      std::to_string(std::max(settings.threads, 1)),
      "--quiet",
      settings.old_results == OldResults::removed ? "--force" : "--resume",
      "--calibrations",
      run.calibrations().string()};
  if (settings.trust_geometry) words.emplace_back("--trust-geometry");
  for (const CaseSetting& setting : settings_of(run.scan, member, settings.common)) {
    words.push_back("--set");
    words.push_back(setting_text(setting));
  }
  return words;
}

void write_scan_table(const ScanRun& run) {
  const fs::path& directory = run.settings.directory;
  const fs::path seeds = directory / "scan_seeds.csv";
  write_whole_file((directory / "scan.csv").string(), scan_table(run.scan, run.results));
  std::error_code ignored;
  if (run.scan.seeds.empty()) {
    fs::remove(seeds, ignored);  // of an earlier scan
  } else {
    write_whole_file(seeds.string(), seed_table(run.scan, run.results));
  }
}

void run_members(ScanRun& run) {
  constexpr int milliseconds = 100;  // between looks at signals and progress
  const ScanSettings& settings = run.settings;
  const int jobs = settings.jobs > 0
                       ? settings.jobs
                       : std::max(1, default_threads() / std::max(settings.threads, 1));
  ProcessPool pool(settings.program, static_cast<std::size_t>(jobs), settings.words);
  std::size_t started = 0, done = 0;
  bool stopped = false;
  while (!pool.idle() || (!stopped && started < run.to_run.size())) {
    while (!stopped && !pool.full() && started < run.to_run.size()) {
      const std::size_t member = run.to_run[started++];
      pool.start(member, words_of_member(run, member));
    }
    for (const FinishedProcess& process : pool.wait(milliseconds)) {
      ScanResult& result = run.results[process.number];
      result = result_of_process(process, run.place(process.number));
      write_scan_table(run);
      ++done;
      if (settings.on_member) {
        settings.on_member({process.number, result, done, run.to_run.size()});
      }
    }
    if (!stopped && settings.stop_requested && settings.stop_requested()) {
      stopped = true;
      pool.stop();
    }
    if (settings.on_wait) settings.on_wait(done, run.to_run.size());
  }
  std::error_code ignored;
  if (!stopped) fs::remove_all(run.calibrations(), ignored);
}

}  // namespace

std::vector<CaseFile> read_members(ScanFile& scan, const std::vector<CaseSetting>& common) {
  const std::string text = scan.case_text ? *scan.case_text : read_input_text(scan.case_path);
  if (!scan.seeds.empty()) {
    refuse_large_input(text, scan.case_path);
    give_seeds(scan, parse_toml(text, scan.case_path));
  }
  refuse_scanned_keys(scan, common);
  std::vector<CaseFile> cases;
  for (std::size_t k = 0; k < scan.members.size(); ++k) {
    const ScanMember& member = scan.members[k];
    try {
      cases.push_back(parse_case(text, scan.case_path, settings_of(scan, k, common), {}));
    } catch (const InputError& error) {
      const TomlValue* value = member.find(error.where().key);
      const bool is_common =
          std::any_of(common.begin(), common.end(),
                      [&](const CaseSetting& setting) { return setting.key == error.where().key; });
      if (value == nullptr && is_common) throw;
      throw InputError({scan.path, value != nullptr ? value->line : member.line, ""},
                       fmt::format("the case refuses member {} ({})", member_name(k),
                                   member_text(member.settings)),
                       error.what());
    }
  }
  if (scan.title.empty()) scan.title = cases.front().title;
  return cases;
}

std::vector<ScanResult> run_scan(ScanFile& scan, const std::vector<CaseFile>& cases,
                                 const ScanSettings& settings) {
  const fs::path& directory = settings.directory;
  const ResultDirectory hold(directory, settings.old_results);
  ScanRun run{scan, settings, {}, {}};
  keep_results(run, cases);
  if (settings.on_start) settings.on_start();
  if (scan.case_text) {
    scan.case_path = (directory / "scan_case.toml").string();
    write_whole_file(scan.case_path, *scan.case_text);
  }
  write_scan_table(run);
  run_members(run);
  draw_scan(scan_plot(scan, run.results, cases.front().units))
      .save((directory / "scan.svg").string());
  return run.results;
}

}  // namespace perilink

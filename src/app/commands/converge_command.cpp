#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>

#include "app/commands/commands.hpp"
#include "app/plot/plot_convergence.hpp"
#include "app/process/console.hpp"
#include "app/process/progress.hpp"
#include "app/process/signals.hpp"
#include "app/process/threads.hpp"
#include "app/study/study_pictures.hpp"
#include "app/study/study_run.hpp"
#include "app/study/study_table.hpp"
#include "base/error.hpp"
#include "base/files.hpp"
#include "base/plain_text.hpp"
#include "io/case/case_settings.hpp"
#include "model/body/mesh_input.hpp"
#include "results/result_directory.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

void write_text(const fs::path& path, const std::string& text) {
  write_whole_file(path.string(), text);
}

/// A study, its series and the members run so far.
struct Results {
  StudyFile study;
  std::vector<StudySeries> series;
  std::vector<StudyMember> members;
};

/// Writes all tables. Called after every member, so that a killed study keeps its results.
void write_tables(const fs::path& directory, Results& results) {
  compare_members(results.study, results.members);
  write_text(directory / "table.csv", study_table(results.study, results.series, results.members));
  write_text(directory / "timing.csv",
             study_timing(results.study, results.series, results.members));
}

/// Writes the study. With other values of --set, it names a case that has them, beside it.
void write_inputs(const fs::path& directory, const StudyFile& study, const CaseFile& input) {
  std::string case_path = study.case_path;
  if (!study.settings.empty()) {
    case_path = (directory / "case.toml").string();
    write_text(case_path, write_case(seen_from(input, directory)));
  }
  write_text(directory / "study.toml", write_study(study, directory.string(), case_path));
}

/// Returns the file name of a picture, "error_unknowns.svg", or "error_NAME_unknowns.svg" where the
/// study has several errors.
std::string picture_name(const Results& results, std::size_t error, const char* cost) {
  if (results.study.errors.size() == 1) return fmt::format("error_{}.svg", cost);
  std::string name = results.study.errors[error].name;
  std::replace_if(
      name.begin(), name.end(),
      [](unsigned char c) { return std::isalnum(c) == 0 && c != '-' && c != '_' && c != '.'; },
      '_');
  return fmt::format("error_{}_{}.svg", name, cost);
}

void write_pictures(const fs::path& directory, const Results& results) {
  for (std::size_t e = 0; e < results.study.errors.size(); ++e) {
    for (const auto& [cost, name] :
         {std::pair(Cost::unknowns, "unknowns"), std::pair(Cost::seconds, "seconds")}) {
      draw_convergence(study_picture(results.study, results.series, results.members, e, cost))
          .save((directory / picture_name(results, e, name)).string());
    }
  }
}

void tell(const StudyMember& member, const StudySeries& series, std::size_t done, std::size_t all) {
  const std::string line =
      fmt::format("[{}/{}] {}, {} {}: {}\n", done, all, series.name, member.refinement.key,
                  refinement_text(member.refinement),
                  member.failed() ? "failed" : format_duration(member.seconds.total()));
  std::fputs(printable(line).c_str(), stderr);
}

/// Runs one member and shows the progress of the calibration on a terminal.
StudyMember run_visibly(const Results& results, std::size_t series, const TomlValue& value,
                        int threads, bool quiet) {
  CalibrationProgress progress(quiet);
  return run_member(results.study, results.series[series], value, threads,
                    [&](int search, double left) { progress.update(search, left); });
}

/// \return whether all members were run
bool run_members(const fs::path& directory, Results& results, int threads, bool quiet) {
  const std::vector<TomlValue>& values = results.study.vary.values;
  const std::size_t all = results.series.size() * values.size();
  std::size_t done = 0;
  for (std::size_t s = 0; s < results.series.size(); ++s) {
    for (const TomlValue& value : values) {
      StudyMember member = run_visibly(results, s, value, threads, quiet);
      if (stop_signal_received()) return false;
      member.series = s;
      if (!quiet) tell(member, results.series[s], ++done, all);
      results.members.push_back(std::move(member));
      write_tables(directory, results);
    }
  }
  return true;
}

int exit_status_of(const Results& results, bool complete) {
  if (!complete) {
    complain("interrupted; the results so far are kept");
    return exit_interrupted;
  }
  const auto good = std::find_if(results.members.begin(), results.members.end(),
                                 [](const StudyMember& member) { return !member.failed(); });
  if (good != results.members.end()) return exit_done;
  complain("every member of the study failed; the first failure:\n" +
           results.members.front().failure);
  return results.members.front().bad_input ? exit_bad_input : exit_solver;
}

}  // namespace

int converge(const RunOptions& options) {
  const int threads = set_threads(options.threads);
  Results results;
  results.study = read_study_file(options.case_path);
  results.study.trust_geometry = options.trust_geometry;
  results.study.settings = parse_settings(options.settings);
  const CaseFile input = read_case_file(results.study.case_path, results.study.settings, {});
  check_study(results.study, input);
  if (results.study.title.empty()) results.study.title = input.title;
  results.series = study_series(results.study);
  check_members(results.study, results.series);

  const fs::path directory = options.directory ? fs::path(*options.directory)
                                               : default_result_directory(options.case_path);
  refuse_own_file(directory, "study.toml", options.case_path, "this study");
  const ResultDirectory hold(directory, options.old_results);
  catch_stop_signals();
  write_inputs(directory, results.study, input);
  const bool complete = run_members(directory, results, threads, options.quiet);
  write_pictures(directory, results);
  if (!options.quiet) {
    say(fmt::format("{}\n{}\nresults in {}\n", results.study.title,
                    study_report(results.study, results.series, results.members),
                    directory.string()));
  }
  return exit_status_of(results, complete);
}

}  // namespace perilink

#include <fmt/format.h>
#include <spdlog/details/null_mutex.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>

#include "app/commands/commands.hpp"
#include "app/process/console.hpp"
#include "app/process/signals.hpp"
#include "app/process/threads.hpp"
#include "app/run/resume.hpp"
#include "app/run/run_kind.hpp"
#include "base/error.hpp"
#include "base/files.hpp"
#include "base/memory.hpp"
#include "base/plain_text.hpp"
#include "base/timer.hpp"
#include "io/case/case_settings.hpp"
#include "model/body/mesh_input.hpp"
#include "results/result_directory.hpp"
#include "results/summary_file.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

/// Log sink that writes whole lines of printable text to DIR/log.txt.
class LogSink final : public spdlog::sinks::base_sink<spdlog::details::null_mutex> {
 public:
  explicit LogSink(const std::string& path) : file_(path) {}
  LogSink(const std::string& path, std::size_t size) : file_(path, size) {}

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    spdlog::memory_buf_t text;
    formatter_->format(message, text);
    std::string line = printable({text.data(), text.size()});
    file_.append(line);
  }
  void flush_() override {}

  LineFile file_;
};

/// \param goes_on  an existing log is kept
std::shared_ptr<spdlog::logger> open_log(const fs::path& directory, bool goes_on) {
  const std::string path = (directory / "log.txt").string();
  const bool keeps = goes_on && fs::exists(path);
  auto sink = keeps ? std::make_shared<LogSink>(path, fs::file_size(path))
                    : std::make_shared<LogSink>(path);
  auto log = std::make_shared<spdlog::logger>("perilink", std::move(sink));
  log->set_error_handler([](const std::string& fault) { complain(fault); });
  return log;
}

/// Writes a summary with the status "failed". Errors of this write are ignored, because the first
/// failure is reported.
void tell_of_failure(const fs::path& directory, const CaseFile& input,
                     const std::exception& error) {
  try {
    write_failed_summary(directory, input, failure_text(error));
  } catch (const std::exception&) {
  }
}

/// Records a failure, unless the run has failed before.
void fail(const RunOutcome& run_outcome, const std::exception& error) {
  if (run_outcome.termination == Termination::failed) return;
  run_outcome.termination = Termination::failed;
  run_outcome.reason = failure_text(error);
}

/// Runs one phase. A full disk or exhausted memory ends the run as failed and keeps its results.
template <class Action>
void attempt(const RunOutcome& run_outcome, const Action& action) {
  try {
    action();
  } catch (const std::exception& error) {
    fail(run_outcome, error);
  }
}

int exit_status_of(Termination termination) {
  if (termination == Termination::interrupted) return exit_interrupted;
  return termination == Termination::failed ? exit_solver : exit_done;
}

/// Opens all files of a run. On failure nothing is computed and the summary gives the reason.
std::shared_ptr<spdlog::logger> open_files(RunKind& run, const fs::path& directory, bool quiet,
                                           const std::optional<Checkpoint>& checkpoint) {
  try {
    const CaseFile seen = seen_from(run.input, directory);
    write_running_summary(directory, seen);
    write_whole_file((directory / "case.toml").string(), write_case(seen));
    const auto log = open_log(directory, checkpoint.has_value());
    log->info("{} : {}, {} threads", run.input.path, run.plan, run.threads);
    if (run.calibration) log->info("calibration: {}", *run.calibration);
    for (const std::string& note : run.notes) log->info("note: {}", note);
    run.open(directory, quiet, checkpoint ? checkpoint->state : "");
    if (checkpoint) log->info("goes on after row {}", run.files().rows());
    return log;
  } catch (const std::exception& error) {
    tell_of_failure(directory, run.input, error);
    throw;
  }
}

/// Runs all phases of a case, whatever its analysis type. \return the exit status
int run_in(const fs::path& directory, const RunOptions& options, const CaseFile& input, int threads,
           const std::optional<Checkpoint>& checkpoint) {
  Timer timer;
  const std::unique_ptr<RunKind> run = make_run(input, threads, options.quiet);
  if (checkpoint) require_same_model(*checkpoint, run->model_fingerprint(), directory);
  const bool begins_anew = options.old_results == OldResults::kept && !checkpoint;
  const ResultDirectory hold(directory, begins_anew ? OldResults::removed : options.old_results);
  catch_stop_signals();
  const auto log = open_files(*run, directory, options.quiet, checkpoint);
  run->seconds.set_up = timer.seconds();

  timer.restart();
  const RunOutcome run_outcome = run->run_outcome();
  attempt(run_outcome, [&] { run->analyse(); });
  attempt(run_outcome, [&] { run->files().finish(); });
  run->seconds.output = run->files().seconds_writing();
  run->seconds.analysis += timer.seconds() - run->seconds.output;
  if (run_outcome.termination == Termination::failed) complain(run_outcome.reason);
  Summary summary;
  const auto sum_up = [&] {
    summary = summary_of(*run, directory);
    write_summary_file(directory, summary.json);
  };
  try {
    sum_up();
  } catch (const std::exception& error) {
    complain(failure_text(error));
    fail(run_outcome, error);
    tell_of_failure(directory, input, error);  // kept if the full summary cannot be written
    attempt(run_outcome, sum_up);
  }
  for (std::size_t k = run->notes.size(); k < summary.notes.size(); ++k) {
    log->info("note: {}", summary.notes[k]);
  }
  log->info("{}: {}; {}", to_string(run_outcome.termination), run_outcome.reason, summary.outcome);
  for (const std::string& warning : summary.warnings) log->info("doubt: {}", warning);
  if (!options.quiet) fmt::print("{}", summary.text);
  return exit_status_of(run_outcome.termination);
}

}  // namespace

int run_case(const RunOptions& options) {
  const int threads = set_threads(options.threads);
  CaseFile input = read_case_file(options.case_path, parse_settings(options.settings), {});
  input.trust_geometry = options.trust_geometry;
  const fs::path directory = options.directory ? fs::path(*options.directory)
                                               : default_result_directory(options.case_path);
  refuse_own_file(directory, "case.toml", options.case_path, "this case with its resolved form");
  // All before the model is built, which may take minutes.
  refuse_old_results(directory, options.old_results != OldResults::refused);
  Resumed found;
  if (options.old_results == OldResults::kept) found = find_results(input, directory);
  if (found.is_finished) {
    if (!options.quiet) fmt::print("{}: holds the whole run already\n", directory.string());
    return exit_done;
  }
  return run_in(directory, options, input, threads, found.checkpoint);
}

}  // namespace perilink

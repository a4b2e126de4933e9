#include "app/run/run_case.hpp"

#include <spdlog/details/null_mutex.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <optional>
#include <utility>

#include "analysis/quasistatic/equilibrium/equilibrium.hpp"
#include "app/run/resume.hpp"
#include "app/run/run_kind.hpp"
#include "base/error.hpp"
#include "base/files.hpp"
#include "base/memory.hpp"
#include "base/plain_text.hpp"
#include "base/timer.hpp"
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
std::shared_ptr<spdlog::logger> open_log(const fs::path& directory, const RunCallbacks& calls,
                                         bool goes_on) {
  const std::string path = (directory / "log.txt").string();
  const bool keeps = goes_on && fs::exists(path);
  auto sink = keeps ? std::make_shared<LogSink>(path, fs::file_size(path))
                    : std::make_shared<LogSink>(path);
  auto log = std::make_shared<spdlog::logger>("perilink", std::move(sink));
  log->set_error_handler([on_fault = calls.on_fault](const std::string& fault) {
    if (on_fault) on_fault(fault);
  });
  return log;
}

/// Writes a summary with the status "failed". Errors of this write are ignored, because the first
/// failure is reported.
void tell_of_failure(const fs::path& directory, const RunKind& run, const std::exception& error) {
  try {
    write_failed_summary(directory, run.input, run.meshes, failure_text(error));
  } catch (const std::exception&) {
  }
}

/// Records the exception being handled as the failure of the run, unless the run has failed before.
void fail(const RunOutcome& run_outcome, RunEnd& end, const std::exception& error) {
  if (run_outcome.termination == Termination::failed) return;
  run_outcome.termination = Termination::failed;
  run_outcome.reason = failure_text(error);
  end.error = std::current_exception();
}

/// Runs one phase. A full disk or exhausted memory ends the run as failed and keeps its results.
template <class Action>
void attempt(const RunOutcome& run_outcome, RunEnd& end, const Action& action) {
  try {
    action();
  } catch (const std::exception& error) {
    fail(run_outcome, end, error);
  }
}

/// \throws InputError  for a body that no equilibrium holds although its pre-cracks may close
void analyse(RunKind& run, const CaseFile& input) {
  try {
    run.analyse();
  } catch (const CracksSeparate&) {
    throw InputError(
        input.where(input.cracks.empty() ? "analysis" : "cracks[1]"),
        "the pre-cracks leave a part of the body free to move: the loads pull it off, or turn it "
        "about the few bonds that are left, as about a hinge",
        "end or move the crack so that more rows of particles are left, remove the loads on that "
        "part, or hold it with [[supports]] or [[springs]]");
  }
}

/// Opens all files of a run. On failure nothing is computed and the summary gives the reason.
std::shared_ptr<spdlog::logger> open_files(RunKind& run, const fs::path& directory,
                                           const std::optional<Checkpoint>& checkpoint) {
  // First: files that do not fit their checkpoint stay as they are.
  if (checkpoint) run.open(directory, run.callbacks, checkpoint->state);
  try {
    const CaseFile seen = seen_from(run.input, directory);
    write_running_summary(directory, seen, run.meshes);
    write_whole_file((directory / "case.toml").string(), write_case(seen));
    const auto log = open_log(directory, run.callbacks, checkpoint.has_value());
    log->info("{} : {}, {}", run.input.source.path, run.plan, counted(run.threads, "thread"));
    if (run.calibration) log->info("calibration: {}", *run.calibration);
    for (const std::string& note : run.notes) log->info("note: {}", note);
    if (!checkpoint) run.open(directory, run.callbacks, "");
    if (checkpoint) log->info("goes on after row {}", run.files().rows());
    return log;
  } catch (const std::exception& error) {
    tell_of_failure(directory, run, error);
    throw;
  }
}

/// Writes the summary of a run at its end. A summary that cannot be written makes the run failed.
void write_summary(RunKind& run, const fs::path& directory, RunEnd& end) {
  const RunOutcome run_outcome = run.run_outcome();
  const auto sum_up = [&] {
    end.summary = summary_of(run, directory);
    write_summary_file(directory, end.summary.json);
  };
  try {
    sum_up();
  } catch (const std::exception& error) {
    if (run.callbacks.on_fault) run.callbacks.on_fault(failure_text(error));
    fail(run_outcome, end, error);
    tell_of_failure(directory, run, error);  // kept if the full summary cannot be written
    attempt(run_outcome, end, sum_up);
  }
}

}  // namespace

RunEnd run_case(const CaseFile& input, const fs::path& directory, const RunSettings& settings) {
  const RunCallbacks& calls = settings.callbacks;
  refuse_own_file(directory, "case.toml", input.source.path, "this case with its resolved form");
  // All before the model is built, which may take minutes.
  const bool goes_on = settings.old_results == OldResults::kept && holds_a_run(directory);
  refuse_old_results(directory, goes_on || settings.old_results == OldResults::removed);
  std::optional<ResultDirectory> hold;
  Resumed found;
  if (goes_on) {
    hold.emplace(directory, OldResults::kept);  // before results are read that others could change
    found = find_results(input, directory);
  }
  if (found.is_finished) return {.ran = false};

  Timer timer;
  const std::unique_ptr<RunKind> run = make_run(input, settings.threads, calls);
  if (found.checkpoint) require_same_model(*found.checkpoint, run->model_fingerprint(), directory);
  if (!hold) {
    hold.emplace(directory, settings.old_results);
  } else if (!found.checkpoint) {
    hold->remove_old_results();
  }
  if (calls.on_start) calls.on_start();
  const auto log = open_files(*run, directory, found.checkpoint);
  run->seconds.set_up = timer.seconds();
  if (goes_on && calls.on_note) {
    calls.on_note(
        found.checkpoint
            ? fmt::format("{}: goes on after row {}", directory.string(), run->files().rows())
            : fmt::format("{}: has no checkpoint, so the run starts from the beginning",
                          directory.string()));
  }

  timer.restart();
  RunEnd end;
  const RunOutcome run_outcome = run->run_outcome();
  attempt(run_outcome, end, [&] { analyse(*run, input); });
  attempt(run_outcome, end, [&] { run->files().finish(); });
  const Timer syncing;
  attempt(run_outcome, end, [&] { sync_files(directory.string()); });
  run->seconds.output = run->files().seconds_writing() + syncing.seconds();
  run->seconds.analysis += timer.seconds() - run->seconds.output;
  const bool failed = run_outcome.termination == Termination::failed;
  if (failed && calls.on_fault) calls.on_fault(run_outcome.reason);
  write_summary(*run, directory, end);
  const Summary& summary = end.summary;
  for (std::size_t k = run->notes.size(); k < summary.notes.size(); ++k) {
    log->info("note: {}", summary.notes[k]);
  }
  log->info("{}: {}; {}", to_string(run_outcome.termination), run_outcome.reason, summary.outcome);
  for (const std::string& warning : summary.warnings) log->info("warning: {}", warning);
  if (!end.error) end.error = run->failure;
  end.termination = run_outcome.termination;
  end.reason = run_outcome.reason;
  return end;
}

}  // namespace perilink

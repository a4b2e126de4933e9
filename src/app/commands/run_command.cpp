#include <fmt/format.h>
#include <spdlog/details/null_mutex.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "app/commands/commands.hpp"
#include "app/model/body/mesh_input.hpp"
#include "app/model/from_case/configure.hpp"
#include "app/model/from_case/lattice_case.hpp"
#include "app/process/console.hpp"
#include "app/process/signals.hpp"
#include "app/process/threads.hpp"
#include "app/results/calibration_text.hpp"
#include "app/results/result_directory.hpp"
#include "app/results/summary_file.hpp"
#include "app/run/bond_run.hpp"
#include "app/run/lattice_observer.hpp"
#include "app/run/lattice_summary.hpp"
#include "app/run/peak_note.hpp"
#include "app/run/relaxation_run.hpp"
#include "app/run/run_model.hpp"
#include "app/run/run_observer.hpp"
#include "app/run/run_warnings.hpp"
#include "app/run/summary.hpp"
#include "base/error.hpp"
#include "base/files.hpp"
#include "base/memory.hpp"
#include "base/plain_text.hpp"
#include "base/timer.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

/// Whole lines of printable text in DIR/log.txt.
class LogSink final : public spdlog::sinks::base_sink<spdlog::details::null_mutex> {
 public:
  explicit LogSink(const fs::path& directory) : file_((directory / "log.txt").string()) {}

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

std::shared_ptr<spdlog::logger> open_log(const fs::path& directory) {
  auto log = std::make_shared<spdlog::logger>("perilink", std::make_shared<LogSink>(directory));
  log->set_error_handler([](const std::string& fault) { complain(fault); });
  return log;
}

/// Before the analysis begins.
void write_first_files(const fs::path& directory, const CaseFile& input) {
  write_running_summary(directory, input);
  write_whole_file((directory / "case.toml").string(), write_case(input));
}

/// Writes the summary of a run that failed before it began. What goes wrong with that is not
/// reported: the first failure is.
void tell_of_failure(const fs::path& directory, const CaseFile& input, const DiskFull& error) {
  try {
    write_failed_summary(directory, input, error.what());
  } catch (const std::exception&) {
  }
}

/// Does a part of a run. A full disk or no memory ends it as failed with what was found so far; the
/// first failure is the one that is told.
template <class Result, class Action>
void attempt(Result& result, const Action& action) {
  try {
    action();
  } catch (const std::exception& error) {
    if (result.ending == Ending::failed) return;
    result.ending = Ending::failed;
    result.reason = failure_text(error);
  }
}

/// Writes the summary at the end of a run.
template <class Result, class Action>
void conclude(Result& result, const Action& write) {
  if (result.ending == Ending::failed) complain(result.reason);
  try {
    write();
  } catch (const std::exception& error) {
    complain(failure_text(error));
    result.ending = Ending::failed;
  }
}

/// The resolved case is written to DIR/case.toml; it must not take the place of the user's own
/// file.
void refuse_own_case(const fs::path& directory, const std::string& case_path) {
  std::error_code error;
  if (!fs::equivalent(directory / "case.toml", case_path, error) || error) return;
  throw FileError(
      fmt::format("{}: the results would overwrite this case with its resolved form\n"
                  "  choose another directory with --out DIR",
                  case_path));
}

/// What is known before the analysis begins.
void log_model(spdlog::logger& log, const Model& model) {
  if (model.network.calibration) {
    log.info("calibration: {}", calibration_line(*model.network.calibration));
  }
  for (const std::string& note : model.notes) log.info("note: {}", note);
}

/// What is known only when the run is over.
void add_note(const std::optional<std::string>& note, std::vector<std::string>& notes,
              spdlog::logger& log) {
  if (!note) return;
  notes.push_back(*note);
  log.info("note: {}", *note);
}

int exit_status_of(Ending ending) {
  if (ending == Ending::interrupted) return exit_interrupted;
  return ending == Ending::failed ? exit_solver : exit_done;
}

int run_explicit(const RunOptions& options, const CaseFile& input, const fs::path& directory,
                 int threads, std::optional<ResultDirectory>& hold) {
  Timer timer;
  ExplicitCase built = build_explicit_case(input);
  built.options.threads = threads;
  hold.emplace(directory, options.force);
  catch_stop_signals();
  write_first_files(directory, input);
  const auto log = open_log(directory);
  log->info("{} : {} particles, {} bonds, {} steps of {:.4g} (critical {:.4g}), {} threads",
            input.path, built.model.lattice.particles(), built.bonds, built.steps, built.time_step,
            built.critical_time_step, threads);
  for (const std::string& note : built.notes) log->info("note: {}", note);

  PhaseSeconds seconds;
  seconds.set_up = timer.seconds();
  timer.restart();
  ExplicitRunObserver observer(input, built, directory, options.quiet);
  ExplicitResult result;
  attempt(result, [&] {
    ExplicitState state(built.model);
    result = run_explicit_analysis(built.model, state, built.options, observer);
  });
  attempt(result, [&] { observer.finish(); });
  seconds.output = observer.seconds_writing();
  seconds.analysis = timer.seconds() - seconds.output;
  add_note(note_of_peaks(observer.peaks()), built.notes, *log);
  const ExplicitSummary summary{input, built, result, observer, seconds, threads};
  conclude(result, [&] { write_summary(directory, summary); });
  log->info("{}: {}; {} steps, {} cracked particles, energy to {:.2e} of the work",
            to_string(result.ending), result.reason, result.steps, result.last.cracked_particles,
            result.largest_surplus);
  for (const std::string& doubt : observer.doubts(result)) {
    log->info("doubt: {}", doubt);
  }
  if (!options.quiet) print_summary(directory, summary);
  return exit_status_of(result.ending);
}

/// Bonds that move instead of going from equilibrium to equilibrium.
int run_moving_bonds(const RunOptions& options, const CaseFile& input, const fs::path& directory,
                     int threads, std::optional<ResultDirectory>& hold) {
  Timer timer;
  Model model = build_model_visibly(input, options.quiet);
  BondRunCase built = build_bond_run(input, model);
  built.options.threads = threads;
  hold.emplace(directory, options.force);
  catch_stop_signals();
  write_first_files(directory, seen_from(input, directory));
  const auto log = open_log(directory);
  log->info("{} : {} particles, {}, {} steps of {:.4g} (critical {:.4g}), {} threads", input.path,
            model.network.particles.size(), elements_text(model), built.steps,
            built.options.time_step, built.inertia.critical_time_step(), threads);
  log_model(*log, model);

  PhaseSeconds seconds;
  seconds.set_up = timer.seconds();
  timer.restart();
  BondRunFiles files(input, model, built.steps, directory, options.quiet);
  ExplicitResult result;
  attempt(result, [&] {
    result = run_explicit_bonds(model, built.inertia, built.rules, built.options, files);
  });
  attempt(result, [&] { files.finish(); });
  seconds.output = files.seconds_writing();
  seconds.analysis = timer.seconds() - seconds.output;
  add_note(note_of_peaks(files.peaks()), model.notes, *log);
  conclude(result,
           [&] { write_summary(directory, input, model, result, files, seconds, threads); });
  log->info("{}: {}; {} steps, {}, energy to {:.2e} of the work", to_string(result.ending),
            result.reason, result.steps, cracks_text(model, result.last), result.largest_surplus);
  for (const std::string& doubt : files.doubts(result)) {
    log->info("doubt: {}", doubt);
  }
  if (!options.quiet) print_summary(directory, input, model, result, files, seconds);
  return exit_status_of(result.ending);
}

/// Bonds that are brought to rest.
int run_relaxation(const RunOptions& options, const CaseFile& input, const fs::path& directory,
                   int threads, std::optional<ResultDirectory>& hold) {
  Timer timer;
  Model model = build_model_visibly(input, options.quiet);
  hold.emplace(directory, options.force);
  catch_stop_signals();
  write_first_files(directory, seen_from(input, directory));
  const auto log = open_log(directory);
  log->info("{} : {} particles, {}, {} load steps, {} threads", input.path,
            model.network.particles.size(), elements_text(model),
            input.analysis.load_factors.size(), threads);
  log_model(*log, model);

  PhaseSeconds seconds;
  seconds.set_up = timer.seconds();
  timer.restart();
  BondRunFiles files(input, model, static_cast<Index>(input.analysis.load_factors.size()),
                     directory, options.quiet);
  RelaxationResult result;
  attempt(result, [&] {
    result = run_dynamic_relaxation(model, relaxation_options(input, threads), files);
  });
  attempt(result, [&] { files.finish(); });
  seconds.output = files.seconds_writing();
  seconds.analysis = timer.seconds() - seconds.output;
  add_note(note_of_peaks(files.peaks()), model.notes, *log);
  conclude(result,
           [&] { write_summary(directory, input, model, result, files, seconds, threads); });
  log->info("{}: {}; {} iterations, {} broken bonds, residual {:.2e}", to_string(result.ending),
            result.reason, result.iterations, result.last.broken_bonds, result.residual);
  if (!options.quiet) print_summary(directory, input, model, result, files, seconds);
  return exit_status_of(result.ending);
}

/// Bonds that break one after the other, or a single elastic solution.
int run_quasistatic(const RunOptions& options, const CaseFile& input, const fs::path& directory,
                    int threads, std::optional<ResultDirectory>& hold) {
  Timer timer;
  Model model = build_model_visibly(input, options.quiet);
  hold.emplace(directory, options.force);
  catch_stop_signals();
  write_first_files(directory, seen_from(input, directory));
  const auto log = open_log(directory);
  log->info("{} : {} particles, {}, {} unknowns, {} threads", input.path,
            model.network.particles.size(), elements_text(model), model.unknowns.count, threads);
  log_model(*log, model);

  PhaseSeconds seconds;
  seconds.set_up = timer.seconds();
  timer.restart();
  RunObserver observer(input, model, directory, options.quiet);
  DamageResult result;
  attempt(result, [&] {
    const ModelRun run = run_model(input, model, threads, observer);
    result = run.result;
    if (run.elastic) seconds.elastic = run.elastic->seconds;
  });
  attempt(result, [&] { observer.finish(); });
  result.places = observer.places();
  for (const auto& note :
       {note_of_grips(model, observer.broken()), note_of_peaks(result, model, observer.broken())}) {
    add_note(note, model.notes, *log);
  }
  seconds.output = observer.seconds_writing();
  seconds.analysis = timer.seconds() - seconds.output;
  conclude(result, [&] { write_summary(directory, input, model, result, seconds, threads); });
  log->info("{}: {}; {} broken bonds, {} factorisations, largest residual {:.2e}",
            to_string(result.ending), result.reason, result.broken_bonds,
            result.factor.factorizations, result.largest_residual);
  for (const std::string& doubt : doubts_about(result)) log->info("doubt: {}", doubt);
  if (!options.quiet) print_summary(input, model, result, seconds, directory);
  return exit_status_of(result.ending);
}

}  // namespace

int run_case(const RunOptions& options) {
  const int threads = set_threads(options.threads);
  CaseFile input = read_case_file(options.case_path);
  input.trust_geometry = options.trust_geometry;
  const fs::path directory = options.directory ? fs::path(*options.directory)
                                               : default_result_directory(options.case_path);
  refuse_own_case(directory, options.case_path);
  refuse_old_results(directory, options.force);  // at once: the model may take minutes
  const bool lattice = input.body.model == BodyModel::lattice;
  const AnalysisType type = input.analysis.type;
  const auto run = type == AnalysisType::relaxation             ? run_relaxation
                   : type == AnalysisType::explicit_ && lattice ? run_explicit
                   : type == AnalysisType::explicit_            ? run_moving_bonds
                                                                : run_quasistatic;
  std::optional<ResultDirectory> hold;
  try {
    return run(options, input, directory, threads, hold);
  } catch (const DiskFull& error) {  // among the first files: nothing is computed
    if (hold) tell_of_failure(directory, input, error);
    throw;
  }
}

}  // namespace perilink

#include <fmt/format.h>
#include <omp.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <thread>

#include "app/bond_run.hpp"
#include "app/commands.hpp"
#include "app/configure.hpp"
#include "app/explicit_case.hpp"
#include "app/explicit_observer.hpp"
#include "app/explicit_summary.hpp"
#include "app/mesh_input.hpp"
#include "app/relaxation_run.hpp"
#include "app/result_directory.hpp"
#include "app/run_doubts.hpp"
#include "app/run_model.hpp"
#include "app/run_observer.hpp"
#include "app/signals.hpp"
#include "app/summary.hpp"
#include "base/error.hpp"
#include "base/timer.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

std::shared_ptr<spdlog::logger> open_log(const fs::path& directory) {
  auto sink =
      std::make_shared<spdlog::sinks::basic_file_sink_st>((directory / "log.txt").string(), true);
  auto log = std::make_shared<spdlog::logger>("perilink", sink);
  log->flush_on(spdlog::level::info);
  return log;
}

void write_resolved_case(const fs::path& directory, const CaseFile& input) {
  std::ofstream file(directory / "case.toml");
  file << write_case(input);
  file.close();
  if (!file)
    throw FileError(fmt::format("{}: cannot be written", (directory / "case.toml").string()));
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

int exit_status_of(Ending ending) {
  if (ending == Ending::interrupted) return exit_interrupted;
  return ending == Ending::failed ? exit_solver : exit_done;
}

int run_explicit(const RunOptions& options, const CaseFile& input, const fs::path& directory,
                 int threads) {
  Timer timer;
  ExplicitCase built = build_explicit_case(input, threads);
  built.options.threads = threads;
  prepare_result_directory(directory, options.force);
  catch_stop_signals();
  write_resolved_case(directory, input);
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
  try {
    ExplicitState state(built.model);
    result = run_explicit_analysis(built.model, state, built.options, observer);
    observer.finish();
  } catch (const std::exception& error) {  // a full disk, no memory: what is written stays readable
    result.ending = Ending::failed;
    result.reason = error.what();
  }
  if (result.ending == Ending::failed) fmt::print(stderr, "perilink: {}\n", result.reason);
  seconds.output = observer.seconds_writing();
  seconds.analysis = timer.seconds() - seconds.output;
  const ExplicitSummary summary{input, built, result, observer, seconds, threads};
  try {
    write_summary(directory, summary);
  } catch (const FileError& error) {
    fmt::print(stderr, "perilink: {}\n", error.what());
    result.ending = Ending::failed;
  }
  log->info("{}: {}; {} steps, {} cracked particles, energy to {:.2e} of the work",
            to_string(result.ending), result.reason, result.steps, result.last.cracked_particles,
            result.largest_surplus);
  for (const std::string& doubt : doubts_about(result, observer.peak_load())) {
    log->info("doubt: {}", doubt);
  }
  if (!options.quiet) print_summary(directory, summary);
  return exit_status_of(result.ending);
}

/// Bonds that move instead of going from equilibrium to equilibrium.
int run_moving_bonds(const RunOptions& options, const CaseFile& input, const fs::path& directory,
                     int threads) {
  Timer timer;
  const Model model = build_model_visibly(input, options.quiet);
  BondRunCase built = build_bond_run(input, model, threads);
  built.options.threads = threads;
  prepare_result_directory(directory, options.force);
  catch_stop_signals();
  write_resolved_case(directory, seen_from(input, directory));
  const auto log = open_log(directory);
  log->info("{} : {} particles, {}, {} steps of {:.4g} (critical {:.4g}), {} threads", input.path,
            model.network.particles.size(), elements_text(model), built.steps,
            built.options.time_step, built.inertia.critical_time_step(), threads);
  for (const std::string& note : model.notes) log->info("note: {}", note);

  PhaseSeconds seconds;
  seconds.set_up = timer.seconds();
  timer.restart();
  BondRunFiles files(input, model, built.steps, directory, options.quiet);
  ExplicitResult result;
  try {
    result = run_explicit_bonds(model.network, model.unknowns, model.loads, model.reference,
                                built.inertia, built.rules, built.options, files);
    files.finish();
  } catch (const std::exception& error) {  // a full disk, no memory: what is written stays readable
    result.ending = Ending::failed;
    result.reason = error.what();
  }
  if (result.ending == Ending::failed) fmt::print(stderr, "perilink: {}\n", result.reason);
  seconds.output = files.seconds_writing();
  seconds.analysis = timer.seconds() - seconds.output;
  try {
    write_summary(directory, input, model, built, result, files, seconds, threads);
  } catch (const FileError& error) {
    fmt::print(stderr, "perilink: {}\n", error.what());
    result.ending = Ending::failed;
  }
  log->info("{}: {}; {} steps, {}, energy to {:.2e} of the work", to_string(result.ending),
            result.reason, result.steps, cracks_text(model, result.last), result.largest_surplus);
  for (const std::string& doubt : doubts_about(result, files.peak_load())) {
    log->info("doubt: {}", doubt);
  }
  if (!options.quiet) print_summary(directory, input, model, result, files, seconds);
  return exit_status_of(result.ending);
}

/// Bonds that are brought to rest.
int run_relaxation(const RunOptions& options, const CaseFile& input, const fs::path& directory,
                   int threads) {
  Timer timer;
  const Model model = build_model_visibly(input, options.quiet);
  prepare_result_directory(directory, options.force);
  catch_stop_signals();
  write_resolved_case(directory, seen_from(input, directory));
  const auto log = open_log(directory);
  log->info("{} : {} particles, {}, {} load steps, {} threads", input.path,
            model.network.particles.size(), elements_text(model),
            input.analysis.load_factors.size(), threads);
  for (const std::string& note : model.notes) log->info("note: {}", note);

  PhaseSeconds seconds;
  seconds.set_up = timer.seconds();
  timer.restart();
  BondRunFiles files(input, model, static_cast<Index>(input.analysis.load_factors.size()),
                     directory, options.quiet);
  RelaxationResult result;
  try {
    result = run_dynamic_relaxation(model.network, model.unknowns, model.loads, model.reference,
                                    relaxation_options(input, threads), files);
    files.finish();
  } catch (const std::exception& error) {  // a full disk, no memory: what is written stays readable
    result.ending = Ending::failed;
    result.reason = error.what();
  }
  if (result.ending == Ending::failed) fmt::print(stderr, "perilink: {}\n", result.reason);
  seconds.output = files.seconds_writing();
  seconds.analysis = timer.seconds() - seconds.output;
  try {
    write_summary(directory, input, model, result, files, seconds, threads);
  } catch (const FileError& error) {
    fmt::print(stderr, "perilink: {}\n", error.what());
    result.ending = Ending::failed;
  }
  log->info("{}: {}; {} iterations, {} broken bonds, residual {:.2e}", to_string(result.ending),
            result.reason, result.iterations, result.last.broken_bonds, result.residual);
  if (!options.quiet) print_summary(directory, input, model, result, files, seconds);
  return exit_status_of(result.ending);
}

/// Bonds that break one after the other, or a single elastic solution.
int run_quasistatic(const RunOptions& options, const CaseFile& input, const fs::path& directory,
                    int threads) {
  Timer timer;
  Model model = build_model_visibly(input, options.quiet);
  prepare_result_directory(directory, options.force);
  catch_stop_signals();
  write_resolved_case(directory, seen_from(input, directory));
  const auto log = open_log(directory);
  log->info("{} : {} particles, {}, {} unknowns, {} threads", input.path,
            model.network.particles.size(), elements_text(model), model.unknowns.count, threads);
  for (const std::string& note : model.notes) log->info("note: {}", note);

  PhaseSeconds seconds;
  seconds.set_up = timer.seconds();
  timer.restart();
  RunObserver observer(input, model, directory, options.quiet);
  DamageResult result;
  try {
    const ModelRun run = run_model(input, model, threads, observer);
    result = run.result;
    if (run.elastic) seconds.elastic = run.elastic->seconds;
    observer.finish();
  } catch (const std::exception& error) {  // a full disk, no memory: what is written stays readable
    result.ending = Ending::failed;
    result.reason = error.what();
  }
  if (const auto note = note_of_grips(model, observer.broken())) {
    model.notes.push_back(*note);
    log->info("note: {}", *note);
  }
  if (result.ending == Ending::failed) fmt::print(stderr, "perilink: {}\n", result.reason);
  seconds.output = observer.seconds_writing();
  seconds.analysis = timer.seconds() - seconds.output;
  try {
    write_summary(directory, input, model, result, seconds, threads);
  } catch (const FileError& error) {
    fmt::print(stderr, "perilink: {}\n", error.what());
    result.ending = Ending::failed;
  }
  log->info("{}: {}; {} broken bonds, {} factorisations, largest residual {:.2e}",
            to_string(result.ending), result.reason, result.broken_bonds,
            result.factor.factorizations, result.largest_residual);
  for (const std::string& doubt : doubts_about(result)) log->info("doubt: {}", doubt);
  if (!options.quiet) print_summary(input, model, result, seconds, directory);
  return exit_status_of(result.ending);
}

}  // namespace

int run_case(const RunOptions& options) {
  const int threads = options.threads > 0
                          ? options.threads
                          : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  omp_set_num_threads(threads);
  const CaseFile input = read_case_file(options.case_path);
  const fs::path directory = options.directory ? fs::path(*options.directory)
                                               : default_result_directory(options.case_path);
  refuse_own_case(directory, options.case_path);
  refuse_old_results(directory, options.force);  // at once: the model may take minutes
  const bool lattice = input.body.model == "lattice";
  const std::string& type = input.analysis.type;
  const auto run = type == "relaxation"            ? run_relaxation
                   : type == "explicit" && lattice ? run_explicit
                   : type == "explicit"            ? run_moving_bonds
                                                   : run_quasistatic;
  return run(options, input, directory, threads);
}

}  // namespace perilink

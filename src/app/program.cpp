#include "app/program.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands/commands.hpp"
#include "app/commands/plot_command.hpp"
#include "app/process/console.hpp"
#include "base/build_info.hpp"
#include "base/error.hpp"
#include "base/files.hpp"
#include "base/memory.hpp"
#include "solver/dense/blas_kernels.hpp"

namespace perilink {
namespace {

constexpr const char* footer =
    "Exit status: 0 done (also when the specimen collapsed), 2 bad input, 3 solver failure,\n"
    "4 interrupted (results so far are kept). Case files are described in docs/case_file.md,\n"
    "studies in docs/studies.md, comparisons in docs/compare.md.";

/// Larger scales draw round-off only.
constexpr double largest_scale = 1e12;

const CLI::Validator is_scale(
    [](const std::string& text) -> std::string {
      double value = 0.0;
      const bool number = CLI::detail::lexical_cast(text, value);
      if (number && value > 0.0 && value <= largest_scale) return "";
      return fmt::format("{} is not a scale: give a number above 0 and at most {}", text,
                         largest_scale);
    },
    "NUMBER > 0");

/// Whether a command-line word holds control characters, which would act on the terminal when
/// printed.
bool steers_terminal(std::string_view word) {
  return std::any_of(word.begin(), word.end(),
                     [](unsigned char c) { return c < 0x20 || c == 0x7F; });
}

void add_trust_option(CLI::App& command, bool& trust_geometry) {
  command.add_flag("--trust-geometry", trust_geometry,
                   "Run gmsh scripts (.geo) with any command, also programs and writing files");
}

/// Adds the options that all computing commands share.
void add_run_options(CLI::App& command, RunOptions& options) {
  command.add_option("--out", options.directory, "Directory of the results [results/<file name>]");
  command
      .add_option("--threads", options.threads,
                  "Most threads; results do not depend on it [OMP_NUM_THREADS, or all processors]")
      ->check(CLI::Range(1, 1024));
  command.add_flag("--quiet", options.quiet, "No progress, no summary");
  command.add_flag("--force", options.force, "Overwrite the results of an earlier run");
  add_trust_option(command, options.trust_geometry);
}

const CLI::App* add_compare_command(CLI::App& app, CompareOptions& options) {
  CLI::App* command = app.add_subcommand(
      "compare", "Compare two results: peaks, curves, energies, cracks, times, overlay plot");
  command->add_option("dir_a", options.first, "Directory of the results A")->required();
  command->add_option("dir_b", options.second, "Directory of the results B")->required();
  command->add_option("--out", options.directory,
                      "Directory of compare.csv and compare.svg [results/A_vs_B]");
  command->add_flag("--quiet", options.quiet, "No table, files only");
  command->add_flag("--force", options.force, "Overwrite an earlier comparison");
  return command;
}

void add_plot_command(CLI::App& app, PlotOptions& options) {
  CLI::App* command = app.add_subcommand(
      "plot", "Draw the load-displacement curve and the deformed body of a result (SVG)");
  command->add_option("directory", options.directory, "Directory of the results")->required();
  command->add_option("--out", options.out, "Directory of the pictures [the same]");
  command->add_option("--scale", options.scale, "Factor on the displacements [automatic]")
      ->check(is_scale);
}

/// Ends the program after an uncaught failure, such as exhausted memory in a parallel loop. Files
/// written so far stay readable and the summary keeps the status of an unfinished run.
[[noreturn]] void end_without_handler() {
  try {
    if (const auto error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc& error) {
    complain(failure_text(error));
    std::_Exit(exit_solver);
  } catch (...) {
  }
  std::abort();
}

/// Calls a command and turns its failures into exit statuses.
template <class Command>
int with_exit_status(const Command& command) {
  try {
    const int status = command();
    if (std::fflush(stdout) == 0 || errno == EPIPE || status != exit_done) return status;
    complain(fmt::format("standard output cannot be written: {}", std::strerror(errno)));
    return exit_solver;
  } catch (const InputError& error) {
    complain(std::string("bad input: ") + error.what());
    return exit_bad_input;
  } catch (const DiskFull& error) {
    complain(error.what());
    return exit_solver;
  } catch (const FileError& error) {
    complain(error.what());
    return exit_bad_input;
  } catch (const std::exception& error) {
    complain(failure_text(error));
    return exit_solver;
  }
}

/// Disables signals that would end the program.
void set_up_process() {
  std::set_terminate(end_without_handler);
  std::signal(SIGXFSZ, SIG_IGN);  // a file size limit is reported as a full disk
  std::signal(SIGPIPE, SIG_IGN);  // the run continues when its output pipe is closed
}

}  // namespace

int run_program(int argc, char** argv) {
  set_up_process();
  CLI::App app{"Perilink: implicit quasistatic peridynamics, damage event by event"};
  app.set_version_flag("--version", [] {
    use_fitting_kernels();  // reports the kernels that a run uses
    return build_summary();
  });
  app.require_subcommand(1);
  app.footer(footer);

  RunOptions run;
  CLI::App* run_command = app.add_subcommand("run", "Run a case and write its results");
  run_command->add_option("case", run.case_path, "Case file (.toml)")->required();
  add_run_options(*run_command, run);
  run_command
      ->add_flag("--resume", run.resume,
                 "Go on from the last checkpoint of the results, or begin where there are none")
      ->excludes("--force");

  RunOptions study;
  CLI::App* converge_command = app.add_subcommand(
      "converge", "Run a study of a case: errors and orders over spacing, horizon and surface");
  converge_command->add_option("study", study.case_path, "Study file (.toml)")->required();
  add_run_options(*converge_command, study);

  CompareOptions compared;
  const CLI::App* compare_command = add_compare_command(app, compared);

  std::string checked_case;
  CLI::App* check_command =
      app.add_subcommand("check", "Validate a case; print its sizes, expected memory and time");
  check_command->add_option("case", checked_case, "Case file (.toml)")->required();
  add_trust_option(*check_command, run.trust_geometry);

  PlotOptions plot;
  add_plot_command(app, plot);

  for (const char* word : std::span(argv, argc)) {
    if (!steers_terminal(word)) continue;
    complain(fmt::format("{}: names must not contain control characters", word));
    return exit_bad_input;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    const std::vector<std::string> unknown = app.remaining();
    if (app.get_subcommands().empty() && !unknown.empty()) {
      complain("unknown command or option " + unknown.front());
    }
    app.exit(error);
    return exit_bad_input;
  }
  return with_exit_status([&] {
    if (run_command->parsed()) return run_case(run);
    if (converge_command->parsed()) return converge(study);
    if (compare_command->parsed()) return compare(compared);
    if (check_command->parsed()) return check_case(checked_case, run.trust_geometry);
    return plot_results(plot);
  });
}

}  // namespace perilink

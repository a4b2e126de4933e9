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
#include <iterator>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands/commands.hpp"
#include "app/commands/option_texts.hpp"
#include "app/commands/plot_command.hpp"
#include "app/process/console.hpp"
#include "base/build_info.hpp"
#include "base/error.hpp"
#include "base/files.hpp"
#include "base/memory.hpp"
#include "results/case_json_schema.hpp"
#include "solver/dense/blas_kernels.hpp"

namespace perilink {
namespace {

constexpr const char* footer =
    "Exit status: 0 done (also when the specimen collapsed), 2 bad input, 3 solver failure,\n"
    "4 interrupted (results so far are kept). Case files are described in docs/case_file.md,\n"
    "studies and scans in docs/studies.md, comparisons in docs/compare.md, reports in\n"
    "docs/report.md.";

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

const CLI::Validator is_row_choice(
    [](const std::string& text) -> std::string {
      int row = 0;
      const bool number = CLI::detail::lexical_cast(text, row);
      if (text == "peak" || text == "last" || (number && row >= 0)) return "";
      return fmt::format("{} is no row: give peak, last or a number of at least 0", text);
    },
    "peak|last|ROW");

/// Whether a command-line word holds control characters, which would act on the terminal when
/// printed.
bool steers_terminal(std::string_view word) {
  return std::any_of(word.begin(), word.end(),
                     [](unsigned char c) { return c < 0x20 || c == 0x7F; });
}

/// Returns whether a word was refused.
bool refuse_control_characters(std::span<char*> words) {
  const auto found = std::ranges::find_if(words, steers_terminal);
  if (found == words.end()) return false;
  complain(fmt::format("{}: names must not contain control characters", *found));
  return true;
}

void add_trust_option(CLI::App& command, bool& trust_geometry) {
  command.add_flag("--trust-geometry", trust_geometry,
                   "Run gmsh scripts (.geo) with any command, also programs and writing files");
}

void add_set_option(CLI::App& command, RunOptions& options) {
  command
      .add_option("--set", options.settings,
                  "Set a key of the case: KEY=VALUE, for example body.spacing=0.5 or "
                  "'materials[1].fracture_energy=0.1'; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

/// Adds the options that all computing commands share.
void add_run_options(CLI::App& command, RunOptions& options) {
  command.add_option("-o,--out", options.directory,
                     "Directory of the results [results/<file name>]");
  command
      .add_option("--threads", options.threads,
                  "Maximum number of threads; results do not depend on it "
                  "[OMP_NUM_THREADS, or all processors]")
      ->check(CLI::Range(1, 1024));
  command.add_flag("--quiet", options.quiet, "No progress, no summary");
  command.add_flag_callback(
      "--force", [&options] { options.old_results = OldResults::removed; },
      "Overwrite the results of an earlier run");
  add_trust_option(command, options.trust_geometry);
  add_set_option(command, options);
}

const CLI::App* add_run_command(CLI::App& app, RunOptions& options) {
  CLI::App* command = app.add_subcommand("run", "Run a case and write its results");
  command->add_option("case", options.case_path, "Case file (.toml)")->required();
  add_run_options(*command, options);
  command
      ->add_flag_callback(
          "--resume", [&options] { options.old_results = OldResults::kept; },
          "Go on from the last checkpoint of the results, or begin where there are none")
      ->excludes("--force");
  command->add_option(
      "--calibrations", options.calibrations,
      "Keep the calibration of the bonds in this directory, and take it from there: "
      "runs that differ in strengths and loads share it");
  return command;
}

const CLI::App* add_converge_command(CLI::App& app, RunOptions& options) {
  CLI::App* command = app.add_subcommand(
      "converge", "Run a study of a case: errors and orders over spacing, horizon and surface");
  command->add_option("study", options.case_path, "Study file (.toml)")->required();
  add_run_options(*command, options);
  return command;
}

const CLI::App* add_check_command(CLI::App& app, RunOptions& options) {
  CLI::App* command =
      app.add_subcommand("check", "Validate a case; print its sizes, expected memory and time");
  command->add_option("case", options.case_path, "Case file (.toml)")->required();
  add_trust_option(*command, options.trust_geometry);
  add_set_option(*command, options);
  return command;
}

const CLI::App* add_scan_command(CLI::App& app, ScanOptions& options) {
  CLI::App* command = app.add_subcommand(
      "scan",
      "Run a case with lists of values of its keys, several runs at once; goes on where "
      "an earlier scan was stopped");
  command->add_option("scan", options.run.case_path, "Scan file (.toml)")->required();
  command->add_option("-o,--out", options.run.directory,
                      "Directory of the results [results/<file name>]");
  command
      ->add_option("--jobs", options.jobs,
                   "Maximum number of simultaneous runs "
                   "[OMP_NUM_THREADS, or all processors, over --threads]")
      ->check(CLI::Range(1, 1024));
  command->add_option("--threads", options.run.threads, "Threads of each run [1]")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--quiet", options.run.quiet, "No progress, no summary");
  command->add_flag_callback(
      "--force", [&options] { options.run.old_results = OldResults::removed; },
      "Run every member anew, overwrite its results");
  add_trust_option(*command, options.run.trust_geometry);
  add_set_option(*command, options.run);
  return command;
}

const CLI::App* add_compare_command(CLI::App& app, CompareOptions& options) {
  CLI::App* command = app.add_subcommand(
      "compare", "Compare two results: peaks, curves, energies, cracks, times, overlay plot");
  command->add_option("dir_a", options.first, "Directory of the results A")->required();
  command->add_option("dir_b", options.second, "Directory of the results B")->required();
  command->add_option("-o,--out", options.directory,
                      "Directory of compare.csv and compare.svg [results/A_vs_B]");
  command->add_flag("--quiet", options.quiet, "No table, files only");
  command->add_flag("--force", options.force, "Overwrite an earlier comparison");
  return command;
}

void add_plot_command(CLI::App& app, PlotOptions& options) {
  CLI::App* command = app.add_subcommand(
      "plot", "Draw the load-displacement curve and the deformed body of a result (SVG)");
  command->add_option("directory", options.directory, "Directory of the results")->required();
  command->add_option("-o,--out", options.out, "Directory of the pictures [the same]");
  command->add_option("--scale", options.scale, "Factor on the displacements [automatic]")
      ->check(is_scale);
  command
      ->add_option("--x", options.x, "Draw a curve over this column of history.csv [displacement]")
      ->type_name("COLUMN");
  command->add_option("--y", options.y, "Draw the curve of this column of history.csv [load]")
      ->type_name("COLUMN");
  command->add_flag("--whole", options.whole, "Draw the last rows of a failed body too");
  command->add_option("--at", options.at, "Draw the body at this row only: a number, peak or last")
      ->check(is_row_choice);
  command->add_option("--field", options.field,
                      "Colour the body by this field, for example \"crack opening\" "
                      "[damage; elastic: von Mises stress]");
  command->add_option("--range", options.range, "Range of the colours [of the field]")
      ->expected(2)
      ->type_name("MIN MAX");
  command->add_flag("--png", options.png, "Also write PNG, by the program rsvg-convert");
  command
      ->add_flag("--animation", options.animation,
                 "Draw only the body, at all rows with fields in one view, and animation.png of "
                 "them")
      ->excludes("--at");
}

const CLI::App* add_report_command(CLI::App& app, ReportOptions& options) {
  CLI::App* command = app.add_subcommand(
      "report",
      "Write one HTML page: case, curves, growing crack, energies; several runs together");
  command->add_option("directories", options.directories, "Directories of the results")->required();
  command->add_option("-o,--out", options.file,
                      "The page [report.html in the directory; of several runs in this folder]");
  command->add_option("--at", options.at, "Show the body at this row first: a number, peak or last")
      ->check(is_row_choice);
  command->add_flag("--watch", options.watch, "Renew the page until all runs have ended");
  return command;
}

const CLI::App* add_schema_command(CLI::App& app, bool& as_text) {
  CLI::App* command = app.add_subcommand(
      "schema", "Print the JSON schema of case files, by which editors complete and check them");
  command->add_flag("--text", as_text, "Print tables and keys with values and meanings instead");
  return command;
}

int print_schema(bool as_text) {
  say(as_text ? case_reference() : case_json_schema());
  return exit_done;
}

/// Adds the option by which the build gets the manual page and the completions.
void add_describe_option(CLI::App& app) {
  app.add_option_function<std::string>("--describe",
                                       [&app](const std::string& kind) {
                                         throw CLI::CallForVersion(option_text(app, kind, footer),
                                                                   0);
                                       })
      ->check(
          CLI::IsMember(std::vector<std::string>(std::begin(option_texts), std::end(option_texts))))
      ->group("");
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

/// Returns why a command line cannot be read, with the nearest command or option.
std::string text_of(const CLI::ParseError& error, const CLI::App& app) {
  std::vector<std::string> unknown = app.remaining(true);
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  std::vector<std::string> allowed;
  if (chosen.empty()) {
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
      allowed.push_back(command->get_name());
    }
  } else {
    std::erase_if(unknown, [](const std::string& word) { return !word.starts_with('-'); });
    for (const CLI::Option* option : chosen.front()->get_options()) {
      if (!option->get_lnames().empty()) allowed.push_back("--" + option->get_lnames().front());
    }
  }
  if (unknown.empty()) return error.what();
  const std::string word = unknown.front().substr(0, unknown.front().find('='));
  return fmt::format("unknown {} {}\n  {}", chosen.empty() ? "command or option" : "option", word,
                     suggest(word, std::vector<std::string_view>(allowed.begin(), allowed.end())));
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
  add_describe_option(app);

  RunOptions run;
  const CLI::App* run_command = add_run_command(app, run);

  RunOptions study;
  const CLI::App* converge_command = add_converge_command(app, study);

  CompareOptions compared;
  const CLI::App* compare_command = add_compare_command(app, compared);

  ScanOptions scanned;
  const CLI::App* scan_command = add_scan_command(app, scanned);

  RunOptions checked;
  const CLI::App* check_command = add_check_command(app, checked);

  ReportOptions report;
  const CLI::App* report_command = add_report_command(app, report);

  bool schema_as_text = false;
  const CLI::App* schema_command = add_schema_command(app, schema_as_text);

  PlotOptions plot;
  add_plot_command(app, plot);

  if (refuse_control_characters(std::span(argv, argc))) return exit_bad_input;
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    complain(text_of(error, app) + "\n  --help, also after a command, lists what can be given");
    return exit_bad_input;
  }
  return with_exit_status([&] {
    if (run_command->parsed()) return run_case(run);
    if (converge_command->parsed()) return converge(study);
    if (compare_command->parsed()) return compare(compared);
    if (check_command->parsed()) return check_case(checked);
    if (scan_command->parsed()) return scan(scanned);
    if (report_command->parsed()) return make_report(report);
    if (schema_command->parsed()) return print_schema(schema_as_text);
    return plot_results(plot);
  });
}

}  // namespace perilink

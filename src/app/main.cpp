#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/commands.hpp"
#include "app/plot.hpp"
#include "base/build_info.hpp"
#include "base/error.hpp"

namespace {

constexpr const char* footer =
    "Exit status: 0 done (also when the specimen collapsed), 2 bad input, 3 solver failure,\n"
    "4 interrupted (results so far are kept). Case files are described in docs/case_file.md,\n"
    "studies in docs/studies.md, comparisons in docs/compare.md.";

void add_trust_option(CLI::App& command, bool& trust_geometry) {
  command.add_flag("--trust-geometry", trust_geometry,
                   "Give gmsh scripts (.geo) that may run commands and write files, too");
}

/// What all commands that compute have in common.
void add_run_options(CLI::App& command, perilink::RunOptions& options) {
  command.add_option("--out", options.directory, "Directory of the results [results/<file name>]");
  command.add_option("--threads", options.threads, "Threads; results do not depend on it [all]")
      ->check(CLI::Range(1, 1024));
  command.add_flag("--quiet", options.quiet, "No progress, no summary");
  command.add_flag("--force", options.force, "Overwrite the results of an earlier run");
  add_trust_option(command, options.trust_geometry);
}

const CLI::App* add_compare_command(CLI::App& app, perilink::CompareOptions& options) {
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

void add_plot_command(CLI::App& app, perilink::PlotOptions& options) {
  CLI::App* command = app.add_subcommand(
      "plot", "Draw the load-displacement curve and the deformed body of a result (SVG)");
  command->add_option("directory", options.directory, "Directory of the results")->required();
  command->add_option("--out", options.out, "Directory of the pictures [the same]");
  command->add_option("--scale", options.scale, "Factor on the displacements [automatic]")
      ->check(CLI::NonNegativeNumber);
}

}  // namespace

/// The program: reads the command line, calls one command, turns failures into exit statuses.
int main(int argc, char** argv) {
  using namespace perilink;
  CLI::App app{"Perilink: implicit quasistatic peridynamics, damage event by event"};
  app.set_version_flag("--version", build_summary());
  app.require_subcommand(1);
  app.footer(footer);

  RunOptions run;
  CLI::App* run_command = app.add_subcommand("run", "Run a case and write its results");
  run_command->add_option("case", run.case_path, "Case file (.toml)")->required();
  add_run_options(*run_command, run);

  RunOptions study;
  CLI::App* converge_command = app.add_subcommand(
      "converge", "Run a study of a case: errors and orders over spacing, horizon and surface");
  converge_command->add_option("study", study.case_path, "Study file (.toml)")->required();
  add_run_options(*converge_command, study);

  CompareOptions compared;
  const CLI::App* compare_command = add_compare_command(app, compared);

  std::string checked_case;
  CLI::App* check_command = app.add_subcommand(
      "check", "Validate a case, calibrate its bonds; print its sizes, expected memory and time");
  check_command->add_option("case", checked_case, "Case file (.toml)")->required();
  add_trust_option(*check_command, run.trust_geometry);

  PlotOptions plot;
  add_plot_command(app, plot);

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    const std::vector<std::string> unknown = app.remaining();
    if (app.get_subcommands().empty() && !unknown.empty()) {
      fmt::print(stderr, "perilink: there is no command or option {}\n", unknown.front());
    }
    app.exit(error);
    return exit_bad_input;
  }
  try {
    if (run_command->parsed()) return run_case(run);
    if (converge_command->parsed()) return converge(study);
    if (compare_command->parsed()) return compare(compared);
    if (check_command->parsed()) return check_case(checked_case, run.trust_geometry);
    return plot_results(plot);
  } catch (const InputError& error) {
    fmt::print(stderr, "perilink: bad input: {}\n", error.what());
    return exit_bad_input;
  } catch (const FileError& error) {
    fmt::print(stderr, "perilink: {}\n", error.what());
    return exit_bad_input;
  } catch (const std::exception& error) {
    fmt::print(stderr, "perilink: {}\n", error.what());
    return exit_solver;
  }
}

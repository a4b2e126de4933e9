#include <fmt/format.h>

#include <filesystem>

#include "app/commands/commands.hpp"
#include "app/compare/comparison.hpp"
#include "app/compare/plot_comparison.hpp"
#include "app/process/console.hpp"
#include "base/error.hpp"
#include "base/files.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

/// Prepares the output directory. Results of runs in the directory are kept.
void prepare_directory(const fs::path& directory, bool force) {
  std::error_code error;
  if (fs::exists(directory, error) && !fs::is_directory(directory, error)) {
    throw FileError(fmt::format("{}: exists and is not a directory", directory.string()));
  }
  for (const char* name : {"compare.csv", "compare.svg"}) {
    if (force || !fs::exists(directory / name, error)) continue;
    throw FileError(
        fmt::format("{}: holds an earlier comparison (found {})\n"
                    "  choose another directory with --out DIR, or overwrite it with --force",
                    directory.string(), name));
  }
  fs::create_directories(directory, error);
  if (error) {
    throw FileError(fmt::format("{}: cannot be created: {}", directory.string(), error.message()));
  }
}

}  // namespace

int compare(const CompareOptions& options) {
  const RunResult a = read_run_result(options.first);
  const RunResult b = read_run_result(options.second);
  const fs::path directory = options.directory ? fs::path(*options.directory)
                                               : fs::path("results") / (a.name + "_vs_" + b.name);
  prepare_directory(directory, options.force);
  const Comparison comparison = compare_results(a, b);
  write_whole_file((directory / "compare.csv").string(), comparison_csv(a, b, comparison));
  draw_comparison(a, b).save((directory / "compare.svg").string());
  if (!options.quiet) {
    say(fmt::format("{}comparison in {}\n", comparison_report(a, b, comparison),
                    directory.string()));
  }
  return exit_done;
}

}  // namespace perilink

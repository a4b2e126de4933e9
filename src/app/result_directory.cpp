#include "app/result_directory.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <vector>

#include "base/error.hpp"

namespace perilink {
namespace fs = std::filesystem;
namespace {

/// Whether a run of this program writes a file of this name.
bool is_result_file(const std::string& name) {
  constexpr std::array<std::string_view, 9> names = {
      "case.toml",  "history.csv",           "timing.csv", "summary.json", "fields.pvd", "log.txt",
      "study.toml", "load_displacement.svg", "table.csv"};
  for (const std::string_view known : names) {
    if (name == known) return true;
  }
  if (name.starts_with("error_")) return name.ends_with(".svg");
  if (!name.starts_with("fields_")) return false;
  // The last one is what a run that was killed left half written.
  return name.ends_with(".vtu") || name.ends_with(".svg") || name.ends_with(".vtu.part");
}

}  // namespace

fs::path default_result_directory(const std::string& case_path) {
  return fs::path("results") / fs::path(case_path).stem();
}

std::vector<fs::path> refuse_old_results(const fs::path& directory, bool force) {
  std::error_code error;
  if (fs::exists(directory, error) && !fs::is_directory(directory, error)) {
    throw FileError(fmt::format("{}: exists and is not a directory", directory.string()));
  }
  std::vector<fs::path> old;
  if (fs::is_directory(directory, error)) {
    for (const auto& entry : fs::directory_iterator(directory, error)) {
      if (is_result_file(entry.path().filename().string())) old.push_back(entry.path());
    }
  }
  if (!old.empty() && !force) {
    throw FileError(
        fmt::format("{}: holds the results of an earlier run (found {})\n"
                    "  choose another directory with --out DIR, or overwrite them with --force",
                    directory.string(), old.front().filename().string()));
  }
  return old;
}

void prepare_result_directory(const fs::path& directory, bool force) {
  std::error_code error;
  const std::vector<fs::path> old = refuse_old_results(directory, force);
  for (const fs::path& file : old) {
    if (!fs::remove(file, error)) {
      throw FileError(fmt::format("{}: cannot be removed: {}", file.string(), error.message()));
    }
  }
  fs::create_directories(directory, error);
  if (error) {
    throw FileError(fmt::format("{}: cannot be made: {}", directory.string(), error.message()));
  }
}

}  // namespace perilink

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "app/commands/commands.hpp"
#include "app/process/console.hpp"
#include "app/report/report_assets.hpp"
#include "app/report/report_page.hpp"
#include "app/report/report_run.hpp"
#include "base/error.hpp"
#include "base/files.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

/// Characters of rows and fields in a report; the rest of three million are for programs and texts.
constexpr std::size_t most_characters = 2'600'000;

void require_library() {
  if (!report_assets().dygraphs.empty()) return;
  throw FileError(
      "perilink report draws curves by dygraphs, which was missing when this program was built\n"
      "  install it (Debian: libjs-dygraphs) and build the program again");
}

/// Refuses to overwrite a file that is no report.
void refuse_other_file(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(path, error))) return;
  const std::string mark = report_mark;
  if (fs::is_regular_file(path, error) && read_regular_file(path.string(), mark.size()) == mark) {
    return;
  }
  throw FileError(fmt::format(
      "{}: exists and is not a report of perilink\n  choose another file with --out FILE",
      path.string()));
}

/// Writes the page. \return whether one of the runs goes on
bool write_report(const ReportOptions& options, const fs::path& path) {
  refuse_other_file(path);
  ReportStreams streams;
  nlohmann::ordered_json runs = nlohmann::ordered_json::array();
  bool is_running = false;
  for (const std::string& directory : options.directories) {
    runs.push_back(
        report_run(directory, most_characters / options.directories.size(), streams, options.at));
    is_running = is_running || runs.back()["is_running"].get<bool>();
  }
  const std::string page = report_page(runs, streams, is_running);
  write_whole_file(path.string(), page);
  say(fmt::format("{} ({:.1f} MB)\n", path.string(), 1e-6 * static_cast<double>(page.size())));
  return is_running;
}

}  // namespace

int make_report(const ReportOptions& options) {
  require_library();
  const fs::path path = options.file ? fs::path(*options.file)
                        : options.directories.size() > 1
                            ? fs::path("report.html")
                            : fs::path(options.directories.front()) / "report.html";
  while (write_report(options, path) && options.watch) {
    std::this_thread::sleep_for(std::chrono::seconds(seconds_between_loads));
  }
  return exit_done;
}

}  // namespace perilink

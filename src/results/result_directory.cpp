#include "results/result_directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/files.hpp"

namespace perilink {
namespace fs = std::filesystem;
namespace {

/// Whether a run of this program writes a file of this name.
bool is_result_file(const std::string& name) {
  constexpr std::array<std::string_view, 12> names = {
      "case.toml",   "history.csv",  "timing.csv", "summary.json",          "fields.pvd",
      "log.txt",     "study.toml",   "table.csv",  "load_displacement.svg", "checkpoint.bin",
      "report.html", "animation.png"};
  for (const std::string_view known : names) {
    if (name == known) return true;
  }
  const bool is_picture = name.ends_with(".svg") || name.ends_with(".png");
  if (name.starts_with("error_")) return is_picture;
  if (name.starts_with("bars_")) return is_picture || name.ends_with(".csv");
  if (name.starts_with("cracks_") || name.starts_with("reactions_")) return name.ends_with(".csv");
  return name.starts_with("fields_") && (is_picture || name.ends_with(".vtu"));
}

/// Returns the rank of a file in the order of removal. Files that refer to others are removed
/// first, so that an interrupted removal leaves no dangling summary or list. The case, by which a
/// run is known, is removed last, so that the next run can go on with the removal.
int rank_of_removal(const fs::path& file) {
  const std::string name = file.filename().string();
  if (name == "summary.json" || name == "checkpoint.bin") return 0;
  if (name == "case.toml") return 3;
  return name == "fields.pvd" ? 1 : 2;
}

/// Whether a file is the unfinished output of a killed run.
bool is_left_over(const std::string& name) {
  for (std::size_t dot = name.find('.'); dot != std::string::npos; dot = name.find('.', dot + 1)) {
    const std::string whole = name.substr(0, dot);
    if (is_result_file(whole) && is_temporary_of(whole, name)) return true;
  }
  return false;
}

/// Locks the directory. Waits a second for a run that has just been killed. \return the descriptor
/// of the lock; -1 where another process holds it
int lock_directory(const fs::path& directory) {
  const int descriptor = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) {
    throw FileError(
        fmt::format("{}: cannot be opened: {}", directory.string(), std::strerror(errno)));
  }
  // Some network disks support no locks; the directory then stays unlocked.
  for (int k = 0; k < 20; ++k) {
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return descriptor;
    ::usleep(50000);
  }
  ::close(descriptor);
  return -1;
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
      const std::string name = entry.path().filename().string();
      if (is_result_file(name) || is_left_over(name)) old.push_back(entry.path());
    }
  }
  std::sort(old.begin(), old.end(), [](const fs::path& a, const fs::path& b) {
    return std::pair(rank_of_removal(a), a) < std::pair(rank_of_removal(b), b);
  });
  if (!old.empty() && !force) {
    throw FileError(
        fmt::format("{}: holds the results of an earlier run (found {})\n"
                    "  choose another directory with --out DIR, or overwrite them with --force",
                    directory.string(), old.front().filename().string()));
  }
  return old;
}

void refuse_own_file(const fs::path& directory, const char* copy, const std::string& own,
                     const char* written) {
  std::error_code error;
  if (!fs::equivalent(directory / copy, own, error) || error) return;
  throw FileError(
      fmt::format("{}: the results would overwrite {}\n"
                  "  choose another directory with --out DIR",
                  own, written));
}

void require_result(const fs::path& directory) {
  std::error_code error;
  const std::string place = directory.string();
  if (!fs::exists(directory, error)) throw FileError(place + ": there is no such directory");
  if (!fs::is_directory(directory, error)) {
    throw FileError(place + ": is not a directory; give the directory of a result of perilink run");
  }
  if (fs::exists(directory / "history.csv", error)) return;
  const char* hint = fs::exists(directory / "study.toml", error)
                         ? "it holds a study of perilink converge"
                     : fs::exists(directory / "compare.csv", error)
                         ? "it holds a comparison of perilink compare, with the picture compare.svg"
                     : fs::exists(directory / "scan.csv", error)
                         ? "it holds a scan; name one of its members, such as 0001"
                         : "perilink run writes one";
  throw FileError(
      fmt::format("{}: is not a result of a run: it has no history.csv ({})", place, hint));
}

namespace {

/// \param left_over  only unfinished files of a killed run
void remove_files(const fs::path& directory, bool left_over) {
  std::error_code error;
  for (const fs::path& file : refuse_old_results(directory, true)) {
    if (left_over && !is_left_over(file.filename().string())) continue;
    if (fs::remove(file, error)) continue;
    throw FileError(fmt::format("{}: cannot be removed: {}", file.string(), error.message()));
  }
}

}  // namespace

ResultDirectory::ResultDirectory(const fs::path& directory, OldResults old)
    : directory_(directory) {
  const bool force = old != OldResults::refused;
  std::error_code error;
  if (!fs::is_directory(directory, error)) {
    refuse_old_results(directory, force);  // also refuses a file of this name
    fs::create_directories(directory, error);
    if (error) {
      throw FileError(
          fmt::format("{}: cannot be created: {}", directory.string(), error.message()));
    }
  }
  lock_ = lock_directory(directory);
  if (lock_ < 0) {
    throw FileError(
        fmt::format("{}: another run is writing its results there\n  wait for its end, or "
                    "choose another directory with --out DIR",
                    directory.string()));
  }
  try {
    if (old == OldResults::refused) refuse_old_results(directory, false);
    remove_files(directory, old == OldResults::kept);
  } catch (...) {
    ::close(lock_);
    throw;
  }
}

void ResultDirectory::remove_old_results() { remove_files(directory_, false); }

ResultDirectory::~ResultDirectory() { ::close(lock_); }

}  // namespace perilink

#include "base/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <random>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "base/memory.hpp"

namespace perilink {
namespace {

constexpr std::string_view temporary_end = ".part";
constexpr std::size_t random_digits = 8;
/// Flags that refuse an existing file and a symbolic link.
constexpr int as_new_file = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
constexpr mode_t by_umask = 0666;

std::string fault_text(const std::string& path, const char* what, int fault) {
  return fmt::format("{}: cannot be {}: {}", path, what, std::strerror(fault));
}

[[noreturn]] void fail_to_read(const std::string& path, const char* what, int fault) {
  throw FileError(fault_text(path, what, fault));
}

[[noreturn]] void fail_to_write(const std::string& path, int fault) {
  const std::string text = fault_text(path, "written", fault);
  if (fault == ENOSPC || fault == EDQUOT || fault == EFBIG || fault == EIO) throw DiskFull(text);
  throw FileError(text);
}

/// Closes its file when it goes out of scope.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }
  /// Returns 0 or the fault.
  int close() { return ::close(std::exchange(number_, -1)) == 0 ? 0 : errno; }

 private:
  int number_;
};

/// Returns the number of bytes written; sets `fault` if some are missing.
std::size_t write_bytes(int descriptor, std::string_view bytes, int& fault) {
  std::size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t count = ::write(descriptor, bytes.data() + written, bytes.size() - written);
    if (count > 0) {
      written += static_cast<std::size_t>(count);
    } else if (count == 0 || errno != EINTR) {
      fault = count == 0 ? EIO : errno;
      break;
    }
  }
  return written;
}

/// Syncs a file. Files that cannot be synced, as on some network disks, count as synced.
/// \return 0 or the fault
int sync_file(int descriptor) {
  return ::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOSYS ? 0 : errno;
}

std::string temporary_name(const std::string& path) {
  std::random_device random;
  return fmt::format("{}.{:0{}x}{}", path, random(), random_digits, temporary_end);
}

const char* kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "a directory";
  if (S_ISFIFO(mode)) return "a named pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

/// Returns the size of the file [bytes].
std::size_t check_regular(const std::string& path, const struct stat& status) {
  if (!S_ISREG(status.st_mode)) {
    throw FileError(fmt::format("{}: is {}, not a file", path, kind_of(status.st_mode)));
  }
  return static_cast<std::size_t>(status.st_size);
}

}  // namespace

void write_whole_file(const std::string& path, std::string_view bytes, bool synced) {
  std::string temporary = temporary_name(path);
  int number = ::open(temporary.c_str(), as_new_file, by_umask);
  for (int again = 0; number < 0 && errno == EEXIST && again < 100; ++again) {
    temporary = temporary_name(path);
    number = ::open(temporary.c_str(), as_new_file, by_umask);
  }
  if (number < 0) fail_to_write(path, errno);
  Descriptor file(number);
  int fault = 0;
  write_bytes(number, bytes, fault);
  if (fault == 0 && synced) fault = sync_file(number);
  const int at_end = file.close();
  if (fault == 0) fault = at_end;
  if (fault == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) fault = errno;
  if (fault == 0) return;
  ::unlink(temporary.c_str());
  fail_to_write(path, fault);
}

/// A disk needs nearly the same time for one file as for several at once.
void sync_files(const std::string& directory) {
  constexpr std::size_t most_at_once = 8;
  std::vector<std::string> paths;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(directory, ignored)) {
    if (entry.is_symlink(ignored) || !entry.is_regular_file(ignored)) continue;
    paths.push_back(entry.path().string());
  }
  std::vector<int> faults(paths.size(), 0);
  std::atomic<std::size_t> next = 0;
  const auto sync_some = [&] {
    for (std::size_t k = next++; k < paths.size(); k = next++) {
      Descriptor file(::open(paths[k].c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
      if (file.number() >= 0) faults[k] = sync_file(file.number());  // else of another process
    }
  };
  {
    std::vector<std::jthread> others;
    try {
      while (others.size() + 1 < std::min(paths.size(), most_at_once))
        others.emplace_back(sync_some);
    } catch (const std::system_error&) {  // fewer threads do the same
    }
    sync_some();
  }
  for (std::size_t k = 0; k < paths.size(); ++k) {
    if (faults[k] != 0) fail_to_write(paths[k], faults[k]);
  }
}

bool is_temporary_of(std::string_view name, std::string_view temporary) {
  if (!temporary.starts_with(name) || !temporary.ends_with(temporary_end)) return false;
  if (temporary.size() != name.size() + 1 + random_digits + temporary_end.size()) return false;
  const std::string_view digits = temporary.substr(name.size() + 1, random_digits);
  return temporary[name.size()] == '.' &&
         digits.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

std::string read_regular_file(const std::string& path, std::size_t most, double memory) {
  struct stat status {};
  // Check before opening, because opening a device can act on it, and again afterwards, because the
  // file may have been replaced.
  if (::stat(path.c_str(), &status) == 0) check_regular(path, status);
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (file.number() < 0) fail_to_read(path, "opened", errno);
  if (::fstat(file.number(), &status) != 0) fail_to_read(path, "read", errno);
  const std::size_t size = std::min(check_regular(path, status), most);
  const double needed = memory * static_cast<double>(size), at_hand = available_memory();
  if (needed > at_hand) {
    throw FileError(fmt::format("{}: has {}, reading it takes {}, and {} of memory are free", path,
                                bytes_text(static_cast<double>(size)), bytes_text(needed),
                                bytes_text(at_hand)));
  }
  std::string bytes;
  std::size_t count = 0;
  // Files in /proc report size 0, and other files may grow: read to the end.
  for (;;) {
    bytes.resize(std::min(most, std::max(size + 1, count + (std::size_t{1} << 16))));
    const ssize_t got = ::read(file.number(), bytes.data() + count, bytes.size() - count);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_to_read(path, "read", errno);
    count += static_cast<std::size_t>(got);
    if (got == 0 || count == most) break;
  }
  bytes.resize(count);
  return bytes;
}

LineFile::LineFile(std::string path) : path_(std::move(path)), temporary_(temporary_name(path_)) {
  if (::unlink(path_.c_str()) != 0 && errno != ENOENT) fail_to_write(path_, errno);
  descriptor_ = ::open(temporary_.c_str(), as_new_file | O_APPEND, by_umask);
  if (descriptor_ < 0) fail_to_write(path_, errno);
}

void require_size(const std::string& path, std::size_t size) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0 && static_cast<std::size_t>(status.st_size) >= size)
    return;
  throw FileError(path +
                  ": is shorter than when the state of its run was saved\n"
                  "  begin the run again with --force");
}

LineFile::LineFile(std::string path, std::size_t size) : path_(std::move(path)), size_(size) {
  require_size(path_, size);
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_APPEND | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor_ < 0) fail_to_write(path_, errno);
  if (::ftruncate(descriptor_, static_cast<off_t>(size)) == 0) return;
  const int fault = errno;
  ::close(descriptor_);
  fail_to_write(path_, fault);
}

LineFile::~LineFile() {
  ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void LineFile::append(std::string& lines) {
  int fault = 0;
  std::size_t written = write_bytes(descriptor_, lines, fault);
  if (fault != 0) {
    const std::size_t line_end = written == 0 ? std::string::npos : lines.rfind('\n', written - 1);
    written = line_end == std::string::npos ? 0 : line_end + 1;
    // If truncation fails too, readers drop the unfinished last line.
    [[maybe_unused]] const int ignored =
        ::ftruncate(descriptor_, static_cast<off_t>(size_ + written));
  }
  size_ += written;
  lines.erase(0, written);
  if (size_ > 0 && !temporary_.empty()) {
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) fail_to_write(path_, errno);
    temporary_.clear();
  }
  if (fault != 0 && size_ == 0) ::unlink(temporary_.c_str());  // no file without a line
  if (fault != 0) fail_to_write(path_, fault);
}

}  // namespace perilink

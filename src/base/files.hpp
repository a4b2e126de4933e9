#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

#include "base/error.hpp"

/// \file
/// Files of a run. They are complete at every moment, also on full disks and after a kill. They
/// never follow a symbolic link.

namespace perilink {

/// The disk is full, or a quota or a limit on file sizes is reached. Exit status 3.
class DiskFull : public FileError {
 public:
  using FileError::FileError;
};

/// Writes a file in one step: writes a temporary file beside it (NAME.<random>.part) and renames
/// it. Readers find the old file or the new one. A link at `path` is replaced, not followed. On
/// failure the old file stays and the temporary file is removed.
/// \param synced  the file is on the disk before it replaces an old one. Each such file costs some
///                milliseconds; sync_files() makes many safe against a power cut in that time.
/// \throws FileError
void write_whole_file(const std::string& path, std::string_view bytes, bool synced = false);

/// Syncs the files of a directory, without those of its directories, to the disk. \throws FileError
void sync_files(const std::string& directory);

/// Returns whether `temporary` is a temporary name of write_whole_file() for a file `name`.
bool is_temporary_of(std::string_view name, std::string_view temporary);

/// Reads a regular file. Refuses pipes, devices and directories without opening them.
/// \param most    largest number of bytes to read; the rest of a longer file is skipped
/// \param memory  bytes of memory that the caller needs per byte of the file, at least one
/// \throws FileError  also before reading, where the free memory is too small
std::string read_regular_file(const std::string& path,
                              std::size_t most = std::numeric_limits<std::size_t>::max(),
                              double memory = 1.0);

/// Refuses a file that is shorter than when the state of its run was saved.
/// \param size  [bytes]
/// \throws FileError
void require_size(const std::string& path, std::size_t size);

/// File that grows by whole lines. An existing file or link at its path is deleted at once, and the
/// new file appears with its first lines. A kill during append() may leave an unfinished last line;
/// readers drop it.
class LineFile {
 public:
  /// \throws FileError
  explicit LineFile(std::string path);
  /// Goes on with an existing file.
  /// \param size  bytes of its lines to keep; the rest is removed
  /// \throws FileError  also where the file is shorter
  LineFile(std::string path, std::size_t size);
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  /// Appends whole lines and removes the written lines from `lines`. On a full disk, writes as many
  /// whole lines as fit.
  /// \throws FileError
  void append(std::string& lines);
  const std::string& path() const { return path_; }
  std::size_t size() const { return size_; }  ///< [bytes]

 private:
  std::string path_;
  std::string temporary_;  ///< name until the first lines are written
  int descriptor_ = -1;
  std::size_t size_ = 0;
};

}  // namespace perilink

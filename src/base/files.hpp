#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

#include "base/error.hpp"

/// \file
/// Files as a run needs them: whole whenever somebody looks, on full disks and after a kill, and
/// never behind a link that somebody else has laid.

namespace perilink {

/// The disk, a quota or a limit on the sizes of files has no room. Exit status 3.
class DiskFull : public FileError {
 public:
  using FileError::FileError;
};

/// Puts a file in its place: writes a temporary beside it (NAME.<random>.part), brings it to the
/// disk and renames it. Whoever reads finds the old file or the new one; a link at `path` is
/// replaced, not followed. When it fails the old file stays and the temporary is removed.
/// \throws FileError
void write_whole_file(const std::string& path, std::string_view bytes);

/// Whether write_whole_file() gives such a name to a temporary of a file `name`.
bool is_temporary_of(std::string_view name, std::string_view temporary);

/// Reads a regular file: a pipe, a device or a directory is refused at once instead of waited for.
/// \param most    bytes to read; the rest of a longer file is left
/// \param memory  bytes that the caller needs for each byte of the file, this one included; a file
///     for which the memory at hand is too small is refused before it is read
/// \throws FileError
std::string read_regular_file(const std::string& path,
                              std::size_t most = std::numeric_limits<std::size_t>::max(),
                              double memory = 1.0);

/// A file that grows by whole lines. What stood at its path goes, a link too; it appears there with
/// its first lines. A kill within append() may still end the kernel's write between two pages of
/// memory, and so within a line: readers leave out a last line that has no end.
class LineFile {
 public:
  /// \throws FileError
  explicit LineFile(std::string path);
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  /// Appends whole lines and takes from `lines` what has reached the file. When the disk is full
  /// this is as many as fit: no line is left half written.
  /// \throws FileError
  void append(std::string& lines);
  /// Waits until the disk has it all. \throws FileError
  void sync();
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  std::string temporary_;  ///< its name before the first lines are in it
  int descriptor_ = -1;
  std::size_t size_ = 0;
};

}  // namespace perilink

#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>

namespace perilink {

/// State of a run that was saved to a file, to take the run up again from there.
struct Checkpoint {
  std::string run;    ///< text of the case, without what may change: the state fits no other
  std::string model;  ///< fingerprint() of the model that was built from it
  std::string state;  ///< bytes of pack()
};

/// Returns a text that changes with any of the numbers or with the sizes of their lists.
std::string fingerprint(std::initializer_list<std::span<const std::byte>> lists);
template <class... Lists>
std::string fingerprint(const Lists&... lists) {
  return fingerprint({std::as_bytes(std::span(lists))...});
}

/// Writes a checkpoint in one step, see write_whole_file(). The file holds the version of the
/// program and a checksum. \throws FileError
void write_checkpoint(const std::string& path, const Checkpoint& checkpoint);

/// Reads a checkpoint; empty where there is no file.
/// \throws FileError if the file is damaged or of another version of the program
std::optional<Checkpoint> read_checkpoint(const std::string& path);

}  // namespace perilink

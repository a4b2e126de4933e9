#include "io/checkpoint/checkpoint.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <filesystem>

#include "base/build_info.hpp"
#include "base/files.hpp"
#include "io/checkpoint/pack.hpp"

namespace perilink {
namespace {

const std::string file_mark = "perilink checkpoint\n";

std::string this_program() { return program_version() + " (commit " + program_commit() + ")"; }

template <class Range>
std::uint32_t checksum(const Range& range, std::uint32_t before = 0) {
  const auto bytes = std::as_bytes(std::span(range));
  return static_cast<std::uint32_t>(
      crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

[[noreturn]] void refuse(const std::string& path, const std::string& fault) {
  throw FileError(path + ": " + fault +
                  "\n  begin the run again with --force in place of --resume");
}

}  // namespace

std::string fingerprint(std::initializer_list<std::span<const double>> numbers) {
  std::uint32_t sum = 0;
  std::string text;
  for (const std::span<const double> part : numbers) {
    sum = checksum(part, sum);
    text += fmt::format("{} ", part.size());
  }
  return text + fmt::format("{:08x}", sum);
}

void write_checkpoint(const std::string& path, const Checkpoint& checkpoint) {
  const std::string content = pack(checkpoint.run, checkpoint.model, checkpoint.state);
  write_whole_file(path, file_mark + pack(this_program(), checksum(content)) + content);
}

std::optional<Checkpoint> read_checkpoint(const std::string& path) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  const std::string bytes = read_regular_file(path, std::string::npos, 3.0);
  if (!bytes.starts_with(file_mark)) refuse(path, "is no checkpoint");
  std::string program;
  std::uint32_t sum = 0;
  Checkpoint checkpoint;
  try {
    unpack(bytes.substr(file_mark.size()), program, sum);
    if (program != this_program()) {
      refuse(path, "is of perilink " + program + ", and this is perilink " + this_program());
    }
    const std::string content = bytes.substr(file_mark.size() + pack(program, sum).size());
    if (checksum(content) != sum) refuse(path, "is damaged: its checksum is wrong");
    unpack(content, checkpoint.run, checkpoint.model, checkpoint.state);
  } catch (const std::length_error&) {  // a size that is damaged
    refuse(path, "is damaged");
  }
  return checkpoint;
}

}  // namespace perilink

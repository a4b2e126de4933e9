#include "io/checkpoint/checkpoint.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <filesystem>
#include <system_error>

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
  if (bytes.empty()) return before;  // zlib would begin again at a null pointer
  return static_cast<std::uint32_t>(
      crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

[[noreturn]] void refuse(const std::string& path, const std::string& fault) {
  throw FileError(path + ": " + fault +
                  "\n  begin the run again with --force in place of --resume");
}

}  // namespace

std::string fingerprint(std::initializer_list<std::span<const std::byte>> lists) {
  std::uint32_t sum = 0;
  for (const std::span<const std::byte> list : lists) {
    const std::size_t size = list.size();
    sum = checksum(list, checksum(std::span(&size, 1), sum));
  }
  return fmt::format("{:08x}", sum);
}

void write_checkpoint(const std::string& path, const Checkpoint& checkpoint) {
  const std::string content =
      pack(this_program(), checkpoint.run, checkpoint.model, checkpoint.state);
  write_whole_file(path, file_mark + pack(checksum(content)) + content, true);
}

std::optional<Checkpoint> read_checkpoint(const std::string& path) {
  std::error_code fault;
  if (!std::filesystem::exists(path, fault)) return std::nullopt;
  const std::string bytes = read_regular_file(path, std::string::npos, 3.0);
  std::uint32_t sum = 0;
  const std::size_t begin = file_mark.size() + sizeof sum;
  if (!bytes.starts_with(file_mark) || bytes.size() < begin) refuse(path, "is no checkpoint");
  unpack(bytes.substr(file_mark.size()), sum);
  const std::string content = bytes.substr(begin);
  if (checksum(content) != sum) refuse(path, "is damaged: its checksum is wrong");
  std::string program;
  Checkpoint checkpoint;
  unpack(content, program);
  if (program != this_program()) {
    refuse(path, "is of perilink " + program + ", and this is perilink " + this_program());
  }
  unpack(content, program, checkpoint.run, checkpoint.model, checkpoint.state);
  return checkpoint;
}

}  // namespace perilink

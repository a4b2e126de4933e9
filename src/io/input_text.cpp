#include "io/input_text.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "base/error.hpp"

namespace perilink {
namespace {

constexpr std::size_t largest_file = std::size_t{16} << 20;

using FileHandle = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

}  // namespace

std::string read_input_text(const std::string& path) {
  const FileHandle file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (file == nullptr) {
    throw FileError(fmt::format("{}: cannot be opened: {}", path, std::strerror(errno)));
  }
  std::string text;
  std::string block(std::size_t{1} << 16, '\0');
  // One block beyond the limit is enough to refuse; a device never ends.
  while (text.size() <= largest_file) {
    const std::size_t count = std::fread(block.data(), 1, block.size(), file.get());
    if (count == 0) break;
    text.append(block, 0, count);
  }
  if (std::ferror(file.get()) != 0) {
    throw FileError(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
  }
  return text;
}

void refuse_large_input(const std::string& text, const std::string& path) {
  if (text.size() <= largest_file) return;
  throw InputError({path, 0, ""},
                   fmt::format("is larger than {} MiB, so it is no case file", largest_file >> 20),
                   "name the .toml file of a case");
}

}  // namespace perilink

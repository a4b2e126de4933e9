#include "io/text/input_text.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "base/error.hpp"
#include "base/files.hpp"

namespace perilink {
namespace {

constexpr std::size_t largest_file = std::size_t{16} << 20;

}  // namespace

std::string read_input_text(const std::string& path) {
  return read_regular_file(path, largest_file + 1);
}

void refuse_large_input(const std::string& text, const std::string& path) {
  if (text.size() <= largest_file) return;
  throw InputError({path, 0, ""},
                   fmt::format("is larger than {} MiB, so it is no case file", largest_file >> 20),
                   "name the .toml file of a case");
}

std::string beside(const std::string& file, const std::string& path) {
  return (std::filesystem::path(file).parent_path() / path).lexically_normal().string();
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == text.npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

}  // namespace perilink

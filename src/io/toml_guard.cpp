#include "io/toml_guard.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <string_view>

#include "base/error.hpp"

namespace perilink {
namespace {

/// A case needs two levels of tables and two of arrays.
constexpr int deepest_level = 16;

/// First character after the string that begins at `begin` with a quote. An unclosed string of one
/// line ends with its line: the parser reports it.
std::size_t end_of_string(std::string_view text, std::size_t begin) {
  const char quote = text[begin];
  const bool escapes = quote == '"';
  const std::string triple(3, quote);
  const bool multiline = text.substr(begin, 3) == triple;
  std::size_t i = begin + (multiline ? 3 : 1);
  while (i < text.size()) {
    if (escapes && text[i] == '\\') {
      i += 2;
    } else if (multiline && text.substr(i, 3) == triple) {
      i += 3;
      // Up to two quotes may stand directly before the closing three.
      for (int extra = 0; extra < 2 && i < text.size() && text[i] == quote; ++extra) ++i;
      return i;
    } else if (!multiline && (text[i] == quote || text[i] == '\n')) {
      return i + 1;
    } else {
      ++i;
    }
  }
  return text.size();
}

}  // namespace

void refuse_deep_nesting(const std::string& text, const std::string& path) {
  int line = 1;
  int brackets = 0;
  int dots = 0;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      const std::size_t end = end_of_string(text, i);
      for (; i < end; ++i) line += text[i] == '\n';
      continue;
    }
    if (c == '#') {
      i = text.find('\n', i);
      if (i == std::string::npos) return;
      continue;
    }
    if (c == '[' || c == '{') ++brackets;
    if ((c == ']' || c == '}') && brackets > 0) --brackets;
    dots += c == '.';
    if (c == '\n' || c == ',' || c == '=' || c == '[' || c == '{') dots = 0;
    if (brackets > deepest_level || dots > deepest_level) {
      throw InputError({path, line, ""},
                       fmt::format("the values nest deeper than {} levels", deepest_level),
                       "a case needs no more than two levels of tables and lists of numbers");
    }
    line += c == '\n';
    ++i;
  }
}

}  // namespace perilink

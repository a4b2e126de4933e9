#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/plain_text.hpp"

namespace perilink {

/// Returns a text that is safe for a terminal, a log or an SVG file, and valid in XML. Control
/// characters, Unicode marks of text direction and invalid UTF-8 are escaped, as "\x1b" or
/// "\u202e". Line ends and tabs stay.
std::string printable(std::string_view text);

/// Returns numbers with six significant digits, separated by ", ". One shared function, because
/// every call of fmt::join() or fmt::format_to() compiles the formatting of numbers again.
std::string joined(std::span<const double> numbers);

/// Returns a number with its noun: "1 bond", "0 bonds", "2 entries".
/// \param plural  for nouns that do not take an s
std::string counted(std::int64_t number, std::string_view noun, std::string_view plural = {});

/// Returns texts separated by ", ".
std::string joined(std::span<const std::string> texts);

}  // namespace perilink

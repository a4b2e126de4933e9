#pragma once

#include <span>
#include <string>
#include <string_view>

namespace perilink {

/// Text as it may reach a terminal, a log or an SVG file, wherever it comes from: what would steer
/// a terminal (control characters, the Unicode marks that turn text around) or is no UTF-8 is
/// written out, "\x1b" or "\u202e". Line ends and tabs stay. The result is text that XML allows.
std::string printable(std::string_view text);

/// Numbers with six significant digits, separated by ", ". A function of its own, since every call
/// of fmt::join() or fmt::format_to() compiles the whole formatting of numbers again.
std::string joined(std::span<const double> numbers);

/// Texts separated by ", ".
std::string joined(std::span<const std::string> texts);

}  // namespace perilink

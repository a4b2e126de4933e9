#pragma once

#include <string>
#include <string_view>

namespace perilink {

/// Text as it may reach a terminal, a log or an SVG file, wherever it comes from: what would steer
/// a terminal (control characters, the Unicode marks that turn text around) or is no UTF-8 is
/// written out, "\x1b" or "\u202e". Line ends and tabs stay. The result is text that XML allows.
std::string printable(std::string_view text);

}  // namespace perilink

#pragma once

#include <string>

namespace perilink {

/// Makes a document safe for toml++ 3.3, or refuses it:
/// - Brackets, headers or dotted keys that nest deeper than any case can are refused. The parser
///   and the destructors of its tables recurse once per level, so a file of a few hundred kilobytes
///   of `a.a.a.` could otherwise exhaust the stack.
/// - The parser asks of characters beyond ASCII whether they are blanks, and its answer for many of
///   them is undefined behaviour. They become escapes (\u00fc) within strings and question marks
///   within comments; TOML allows them nowhere else.
/// - Strings of several lines are refused: no case needs them, and strings that end with their line
///   keep this function simple enough to be trusted.
/// \param text  UTF-8
/// \return the same document, line by line, in ASCII
/// \throws InputError
std::string guard_toml(const std::string& text, const std::string& path);

}  // namespace perilink

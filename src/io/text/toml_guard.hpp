#pragma once

#include <string>

namespace perilink {

/// Makes a document safe for toml++ 3.3, or refuses it:
/// - It refuses brackets, headers and dotted keys that nest too deep. The parser and the
///   destructors of its tables recurse once per level: a few hundred kilobytes of `a.a.a.` could
///   exhaust the stack.
/// - It replaces characters beyond ASCII by escapes (\u00fc) within strings and by question marks
///   within comments. TOML allows them nowhere else. The parser's test for blanks has undefined
///   behaviour for many of them.
/// - It refuses strings of several lines: no case needs them, and the guard stays simple without
///   them.
/// \param text  UTF-8
/// \return the same document, line by line, in ASCII
/// \throws InputError
std::string guard_toml(const std::string& text, const std::string& path);

}  // namespace perilink

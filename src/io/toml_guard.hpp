#pragma once

#include <string>

namespace perilink {

/// Refuses documents that toml++ 3.3 cannot be trusted with and that no case needs to be:
/// - Brackets, headers or dotted keys that nest deep. The parser and the destructors of its tables
///   recurse once per level, so a file of a few hundred kilobytes of `a.a.a.` could otherwise
///   exhaust the stack.
/// - Characters beyond ASCII outside of strings and comments. TOML allows none there, but the
/// parser
///   asks whether they are blanks, and the answer for many of them is undefined behaviour.
/// - Strings of several lines, within which it asks the same.
/// \throws InputError
void refuse_dangerous_text(const std::string& text, const std::string& path);

}  // namespace perilink

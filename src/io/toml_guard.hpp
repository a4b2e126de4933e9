#pragma once

#include <string>

namespace perilink {

/// Refuses a document whose brackets, headers or dotted keys nest deeper than any case can. The
/// parser and the destructors of its tables recurse once per level, so a file of a few hundred
/// kilobytes of `a.a.a.` could otherwise exhaust the stack.
/// \throws InputError
void refuse_deep_nesting(const std::string& text, const std::string& path);

}  // namespace perilink

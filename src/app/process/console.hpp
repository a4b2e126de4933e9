#pragma once

#include <string>

namespace perilink {

/// Writes "perilink: TEXT" to standard error, printable. Never throws: a full disk behind it or a
/// closed pipe must not end a run.
void complain(const std::string& text) noexcept;

/// Writes a text to standard output, printable.
void say(const std::string& text);

}  // namespace perilink

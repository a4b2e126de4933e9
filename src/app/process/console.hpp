#pragma once

#include <string>

namespace perilink {

/// Writes "perilink: TEXT" to standard error, with control characters removed. Never throws, so
/// that a full disk or closed pipe does not end a run.
void complain(const std::string& text) noexcept;

/// Writes a text to standard output, with control characters removed.
void say(const std::string& text);

}  // namespace perilink

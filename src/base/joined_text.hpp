#pragma once

#include <span>
#include <string>

namespace perilink {

/// Numbers with six significant digits, separated by ", ". A function of its own, since every call of
/// fmt::join() or fmt::format_to() compiles the whole formatting of numbers again.
std::string joined(std::span<const double> numbers);

/// Texts separated by ", ".
std::string joined(std::span<const std::string> texts);

}  // namespace perilink

#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace perilink {

/// Advice with the command by which gmsh saves a mesh that it can read in format 4.1.
std::string conversion_to_41(const std::string& path);

/// Advice that makes a mesh of first order from one of second order.
std::string conversion_to_first_order(const std::string& path);

/// Fault and advice for a file that does not begin as a mesh of gmsh does. Its format is told by
/// the ending of its name, otherwise by its first bytes.
std::pair<std::string, std::string> other_format(std::string_view bytes, const std::string& path);

}  // namespace perilink

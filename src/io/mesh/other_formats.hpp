#pragma once

#include <string>

namespace perilink {

/// Advice with the command by which gmsh saves a mesh that it can read in format 4.1.
std::string conversion_to_41(const std::string& path);

/// Advice that makes a mesh of first order from one of second order.
std::string conversion_to_first_order(const std::string& path);

/// Advice for a file that is no mesh of gmsh.
std::string conversion_of_others(const std::string& path);

}  // namespace perilink

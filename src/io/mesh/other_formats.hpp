#pragma once

#include <string>
#include <string_view>

/// \file
/// Messages for meshes that are not of gmsh's format 4.1: their format, and commands that convert
/// them.

namespace perilink {

/// Advice with the command by which gmsh saves a mesh in format 4.1, groups kept. gmsh must be able
/// to read the mesh.
std::string conversion_to_41(const std::string& path);

/// Advice with the command by which gmsh makes a mesh of first order from one of second order,
/// groups kept; for a geometry the options that ask for second order.
std::string conversion_to_first_order(const std::string& path);

/// Fault and advice of a message.
struct FormatFault {
  std::string fault, advice;
};

/// Names the format of a file that does not begin as a mesh of gmsh does: by the ending of its
/// name, otherwise by its first bytes.
FormatFault other_format(std::string_view bytes, const std::string& path);

}  // namespace perilink

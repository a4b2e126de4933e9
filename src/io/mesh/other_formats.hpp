#pragma once

#include <string>

namespace perilink {

/// Returns advice with the gmsh command that converts a mesh to format 4.1.
std::string conversion_to_41(const std::string& path);

/// Returns advice for a file that is no mesh of gmsh, with the commands that convert it.
std::string conversion_of_others(const std::string& path);

}  // namespace perilink

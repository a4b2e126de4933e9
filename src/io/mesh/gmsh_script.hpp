#pragma once

#include <string>

namespace perilink {

/// Refuses a gmsh script (.geo) with a command outside the list of geometry commands: other
/// commands may run programs or write files. Files that the script reads and PATH.opt are checked
/// too.
/// \throws InputError  with file, line, command and the option --trust-geometry
void refuse_unsafe_geometry(const std::string& path);

}  // namespace perilink

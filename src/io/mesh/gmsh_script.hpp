#pragma once

#include <string>

namespace perilink {

/// Refuses a gmsh script (.geo) with a command outside the list of geometry commands, which may run
/// programs or write files; also in files that it reads, in its folder or below, and in PATH.opt.
/// \throws InputError  with file, line, command and the option --trust-geometry
void refuse_unsafe_geometry(const std::string& path);

}  // namespace perilink

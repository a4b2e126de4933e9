#pragma once

#include <string>
#include <vector>

namespace perilink {

/// Refuses a geometry whose reading by gmsh could run commands or write files: a script, or one
/// that it includes or merges, with anything but the words known to draw and mesh. The script need
/// not be right otherwise; gmsh says what is wrong with it.
/// \param path  as gmsh is given it; what gmsh would read beside it (PATH.opt) is looked at, too
/// \throws InputError  with file, line and word
/// \throws FileError   where one of the files cannot be read
void refuse_unsafe_geometry(const std::string& path);

/// The same of the text of one script, for tests.
/// \return files that it includes or merges, as it names them
std::vector<std::string> check_gmsh_script(const std::string& text, const std::string& path);

}  // namespace perilink

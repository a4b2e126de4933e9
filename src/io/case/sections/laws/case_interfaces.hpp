#pragma once

#include "io/case/case_file.hpp"
#include "io/case/case_table.hpp"
#include "io/text/toml_writer.hpp"

namespace perilink {

/// Reads the place of a crack or an interface: the `points` of a line (2D), the `corners` of a
/// polygon (3D) or a `group` of the mesh, where a table has them.
void read_face(const CaseTable& table, int dim, std::vector<Vector3>& points, std::string& group);
void write_face(TomlWriter& out, const std::vector<Vector3>& points, const std::string& group,
                int dim);

/// \throws InputError  where an interface contradicts the rest of the case
void check_interfaces(const CaseFile& input);

InterfaceSection read_interface(const CaseTable& table, Kinds kind);

}  // namespace perilink

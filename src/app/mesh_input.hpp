#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "discretization/lattice.hpp"
#include "io/case_file.hpp"

namespace perilink {

/// Reads the mesh that a case names and makes its body.
/// \param notes  gets a line where cells are left out because they have no material
/// \throws InputError  where the mesh cannot be read, is damaged or does not suit the case: a group
///         that it lacks, a material for a group without cells, cells that overlap
Body read_mesh_body(const CaseFile& input, int dim, std::vector<std::string>& notes);

/// The case with its mesh named as seen from a folder, so that it can be written there.
CaseFile seen_from(const CaseFile& input, const std::filesystem::path& directory);

}  // namespace perilink

#pragma once

#include <string>
#include <vector>

#include "discretization/region.hpp"
#include "io/case/case_file.hpp"

namespace perilink {

/// Returns the region of a checked case that has a name.
const Region& region_named(const CaseFile& input, const std::string& name);

/// Returns boxes that fill the regions of a material without its holes, in a body without a mesh.
/// Hole boundaries belong to the body.
/// \throws InputError  where the holes remove all of the material
std::vector<Box> boxes_of(const CaseFile& input, std::size_t material);

/// Returns the box around at least one box.
Box bounding_box(const std::vector<Box>& boxes);

}  // namespace perilink

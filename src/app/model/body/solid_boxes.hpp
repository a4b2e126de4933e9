#pragma once

#include <vector>

#include "discretization/region.hpp"
#include "io/case/case_file.hpp"

namespace perilink {

/// Boxes that a material of a body without a mesh fills: its regions without its holes, whose sides
/// belong to the body.
/// \throws InputError  where the holes leave nothing
std::vector<Box> boxes_of(const CaseFile& input, std::size_t material);

/// Around all of some boxes, at least one.
Box bounding_box(const std::vector<Box>& boxes);

}  // namespace perilink

#pragma once

#include "discretization/lattices/lattice.hpp"
#include "io/case/case_file.hpp"

namespace perilink {

/// Returns the box around the regions of all materials of a case [length].
Box box_of_materials(const CaseFile& input);

/// Fills the regions of a case with unstructured particles, without their holes: vertices of a mesh
/// of the geometry, also on its surface and on faces between regions. The same seed gives the same
/// particles.
/// \param spacing  wanted mean distance of neighbours [length]
/// \throws InputError  where gmsh is missing or cannot mesh the geometry, or faces of regions lie
///         much closer together than the spacing
Body make_unstructured_body(const CaseFile& input, int dim, double spacing);

}  // namespace perilink

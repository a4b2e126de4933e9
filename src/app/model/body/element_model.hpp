#pragma once

#include "app/model/model.hpp"
#include "discretization/lattices/lattice.hpp"

namespace perilink {

/// Builds linear elements on the cells of a body. Fills `elements` and `network` of the model, sets
/// the facets of the body to those of the cells, and sets particle volumes to the integrals of the
/// shape functions, so that loads are consistent nodal loads.
void build_elements(const CaseFile& input, Body& body, Model& model);

}  // namespace perilink

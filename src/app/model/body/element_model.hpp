#pragma once

#include "app/model/model.hpp"
#include "discretization/lattices/lattice.hpp"

namespace perilink {

/// Puts linear elements on the cells of a body: fills `elements` and `network` of the model, and
/// gives the body the facets of the cells and its particles the integrals of their shape functions,
/// so that loads are those of the elements.
void build_elements(const CaseFile& input, Body& body, Model& model);

}  // namespace perilink

#pragma once

#include "discretization/lattices/lattice.hpp"
#include "model/model.hpp"

namespace perilink {

/// Builds linear elements on the cells of a body and fills `elements` and `network` of the model.
/// The body gets the facets of the cells. Particle volumes become the integrals of the shape
/// functions, so that loads are consistent nodal loads.
void build_elements(const CaseFile& input, Body& body, Model& model);

}  // namespace perilink

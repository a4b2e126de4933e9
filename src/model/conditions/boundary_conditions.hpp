#pragma once

#include "model/model.hpp"

namespace perilink {

/// Applies supports, prescribed displacements and loads of a case to the particles of the model and
/// numbers the unknowns. Pins the rigid-body modes of an unsupported body if the case sets
/// rigid_body_modes = "pin".
/// \throws InputError  for regions without particles, contradictory supports, free rigid-body
///                     modes, loads on a free body that are not in balance
void apply_boundary_conditions(const CaseFile& input, Model& model);

}  // namespace perilink

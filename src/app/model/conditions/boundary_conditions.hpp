#pragma once

#include "app/model/model.hpp"

namespace perilink {

/// Puts the supports, driven displacements and loads of a case on the particles of the model and
/// numbers the unknowns; pins the rigid-body modes of a body without supports when the case asks.
/// \throws InputError  for regions without particles, contradictory supports, free rigid-body
///                     modes, loads on a free body that are not in balance
void apply_boundary_conditions(const CaseFile& input, Model& model);

}  // namespace perilink

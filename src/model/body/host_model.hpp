#pragma once

#include "model/model.hpp"

namespace perilink {

/// Constrains particles by the finite elements of [elements], in a model with supports and loads.
/// The unknowns become those of the elements. Elements crossed by a crack, a support, a surface or
/// another region are left out; their particles are free from the start.
/// \throws InputError  where elements are too small for the spacing, or none is left
void carry_particles(const CaseFile& input, Model& model);

}  // namespace perilink

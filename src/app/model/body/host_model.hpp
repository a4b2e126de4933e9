#pragma once

#include "app/model/model.hpp"

namespace perilink {

/// Puts the finite elements of [elements] on the body of a model with supports and loads: its
/// unknowns are theirs from then on. Elements that a crack, a support, a surface or another region
/// crosses are left out, and their particles are free from the start.
/// \throws InputError  where elements are no larger than particles are apart, or none is whole
void carry_particles(const CaseFile& input, Model& model);

}  // namespace perilink

#pragma once

#include "calibration/bond_orbits.hpp"
#include "calibration/calibration_input.hpp"
#include "discretization/facets.hpp"

/// \file Bonds that lie alike in a lattice of any shape in space.

namespace perilink {

/// Classes of bonds whose surroundings are the same but for a move, a turn or a mirror of the
/// lattice: which bonds, how stiff, both ends have, and which area vectors the particles there.
/// Places are alike where that holds for the particles bonded to them as well: all bonds there lie
/// alike then, and the equations of forces and moments are the same (docs/theory/calibration.md).
/// \param input      with a step
/// \param stiffness  at the start of the calibration
/// \param most       kinds of places that are of use: more are not looked for
/// \return no representatives where there are more
BondOrbits find_surroundings(const CalibrationInput& input, const Facets& facets,
                             const BondStiffness& stiffness, std::size_t most);

}  // namespace perilink

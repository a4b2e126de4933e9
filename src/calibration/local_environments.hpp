#pragma once

#include <optional>

#include "calibration/bond_orbits.hpp"
#include "calibration/calibration_input.hpp"
#include "discretization/facets.hpp"

/// \file Symmetry-equivalent bonds of a lattice of any shape in space.

namespace perilink {

/// Finds equivalence classes of bonds: a translation, rotation or reflection of the lattice maps
/// the local environments of both ends on each other. The local environment of a particle consists
/// of its bonds, their stiffnesses, and the area vectors at their ends. Particles are equivalent
/// where the environments of their neighbours match too. Then all their bonds are equivalent, and
/// their equations are equal (docs/theory/calibration.md).
/// \param input      with a step
/// \param stiffness  at the start of the calibration
/// \param most       largest useful number of classes of particles
/// \return no representatives where there are more classes
BondOrbits find_environments(const CalibrationInput& input, const Facets& facets,
                             const BondStiffness& stiffness, std::size_t most);

/// Returns classes of symmetry-equivalent bonds of a lattice with one set of elastic constants;
/// std::nullopt where they would not reduce the problem enough.
/// \param stiffness  at the start of the calibration
std::optional<BondOrbits> equivalent_bonds(const CalibrationInput& input, const Facets& facets,
                                           const BondStiffness& stiffness);

}  // namespace perilink

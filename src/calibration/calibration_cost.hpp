#pragma once

#include <optional>

#include "calibration/bond_orbits.hpp"
#include "calibration/calibration_input.hpp"
#include "discretization/facets.hpp"

namespace perilink {

/// The classes of bonds that a calibration makes alike; none where the body has no lattice of one
/// stiffness, or so little in it repeats that single bonds are cheaper.
/// \param stiffness  at the start
std::optional<BondOrbits> alike_bonds(const CalibrationInput& input, const Facets& facets,
                                      const BondStiffness& stiffness);

/// Operations of factors that making these alike may take, until single bonds are tried instead:
/// twice as many as are expected.
double alike_budget(const CalibrationInput& input, const BondOrbits& orbits, bool moments);

/// Whether the bonds that may change meet so few that searches leave out all others.
bool meets_few(const CalibrationInput& input);

/// Estimate of a calibration that has not been done, as its report: how many bonds it may change
/// and roughly how many seconds it takes on an idle core, by rates of bodies whose search converges
/// (contradictory equations take longer).
/// \param stiffness  at the start
CalibrationReport expected_calibration(const CalibrationInput& input, const Facets& facets,
                                       const BondStiffness& stiffness);

}  // namespace perilink

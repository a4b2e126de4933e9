#pragma once

#include "calibration/bond_equations.hpp"
#include "calibration/calibration_input.hpp"
#include "discretization/facets.hpp"

/// \file Bond stiffnesses with which a body of bonds passes the linear patch test, boundary
/// included: in every uniform strain the bond forces on a particle are those of the stress on its
/// share of the surface.

namespace perilink {

/// Changes the stiffness of the free bonds as little as possible (least squares of the relative
/// changes, positive bounds) such that every particle is in balance in every uniform strain; see
/// docs/theory/calibration.md. Shifts the shares of facets where no stiffness could do it, and the
/// inflection of bonds that carry moments. Where the bounds stand in the way (a corner of a cube:
/// bonds along its diagonal pull out of all three faces at once) the bonds there may fall to zero.
/// Where even this balances nothing, what is left is made small by least squares, prices or soft
/// equations; the report says how small.
CalibrationReport calibrate_bonds(const CalibrationInput& input, const CalibrationOptions& options,
                                  Facets& facets, BondStiffness& stiffness);

}  // namespace perilink

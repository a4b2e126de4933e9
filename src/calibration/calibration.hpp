#pragma once

#include "calibration/bond_equations.hpp"
#include "calibration/calibration_input.hpp"
#include "discretization/facets.hpp"

/// \file Calibration of bond stiffnesses so that a body passes the linear patch test, boundary
///     included. In every uniform strain the bond forces on a particle balance the stress on its
///     part of the surface.

namespace perilink {

/// Calibrates the free bonds: every particle is in balance in every uniform strain, with the least
/// relative changes of stiffness (bounded least squares; docs/theory/calibration.md). Also shifts
/// nodal area fractions and inflection points of bonds that carry moments where stiffnesses are not
/// enough. Where the bounds make the equations infeasible, bonds may fall to zero. An example is
/// the corner of a cube, where bonds along the diagonal pull out of three faces. Where this is not
/// enough, the remaining forces are reduced by least squares, penalties or soft equations; the
/// report has their size.
CalibrationReport calibrate_bonds(const CalibrationInput& input, const CalibrationOptions& options,
                                  Facets& facets, BondStiffness& stiffness);

}  // namespace perilink

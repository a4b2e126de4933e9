#pragma once

#include "analysis/quasistatic/equilibrium/body/event_outcome.hpp"
#include "analysis/quasistatic/equilibrium/displacement/solution.hpp"

/// \file
/// Deformations and energies of elements that lose stiffness.

namespace perilink {

/// Returns the vectors that take an element to this secant, with their deformation by permanent
/// loads.
Removal removal_of(const Solution& solution, const Weakening& change);

/// Returns x'u of each vector at load factor 1: square roots of twice the energies. A bar's comes
/// from differences of displacements, which keep their digits if the body moves far.
Removal::Deformations deformations(const Solution& solution, const Removal& removal, Index element);

/// Returns the deformations at the present load factor; without permanent loads at load factor 1.
Removal::Deformations deformations_now(const Solution& solution, const Removal& removal,
                                       Index element);

/// Returns the sum of the squared deformations: twice the energy of the vectors.
double square_of(const Removal::Deformations& deformations);

/// Returns twice the energy of an element's lost stiffness, at load factor 1 or at the present
/// one of a stage.
double energy_lost(const Solution& solution, const Weakening& change);

/// Adds to the outcome the energy that leaves an element.
/// \return twice this energy at load factor 1 or at the present one of a stage
double release(const Solution& solution, const Removal& removal,
               const Removal::Deformations& growing, EventOutcome& outcome);

}  // namespace perilink

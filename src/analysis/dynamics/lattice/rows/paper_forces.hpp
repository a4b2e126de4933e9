#pragma once

#include "analysis/dynamics/lattice/body/lattice_state.hpp"

namespace perilink {

/// bond_forces() by the rules of the papers of 2017 and 2018, one bond after the other. These
/// constitutive rules are not conservative and are kept for comparison with the papers.
void paper_forces(const ExplicitModel& model, ExplicitState& state, Index row);

}  // namespace perilink

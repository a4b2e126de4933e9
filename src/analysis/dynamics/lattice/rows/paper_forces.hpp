#pragma once

#include "analysis/dynamics/lattice/body/lattice_state.hpp"

namespace perilink {

/// Computes bond forces as bond_forces() does, by the rules of the papers of 2017 and 2018, bond by
/// bond. These rules are not conservative and are kept for comparison with the papers.
void paper_forces(const ExplicitModel& model, ExplicitState& state, Index row);

}  // namespace perilink

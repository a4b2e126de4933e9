#pragma once

#include "analysis/dynamics/lattice/body/lattice_state.hpp"

namespace perilink {

/// Computes the bond forces of a row as bond_forces() does, with LatticeRules::least_2018 or
/// mean_2017 (Nikravesh 2017; Nikravesh & Gerstle 2018). These rules are not conservative. They
/// serve for comparison with the papers.
void paper_forces(const ExplicitModel& model, ExplicitState& state, Index row);

}  // namespace perilink

#pragma once

#include <string>

#include "assembly/bar_state.hpp"
#include "network/network.hpp"

namespace perilink {

/// Returns the text of bars_STEP.csv: a row for each bar element, bar after bar from its beginning.
/// Columns: bar (from 1, in case order), distance of the element's middle along the bar, x, y, z,
/// axial_strain, axial_stress, axial_force, slip, bond_stress (BarState).
std::string bar_table(const Network& network, const BarState& state);

}  // namespace perilink

#pragma once

#include <string>

#include "assembly/bar_state.hpp"
#include "network/network.hpp"

namespace perilink {

/// Text of bars_STEP.csv: a row for each segment, bar after bar from the beginning of each.
/// Columns: bar (from 1, in the order of the case), distance of the segment's middle from the
/// beginning along the bar, x, y and z of it, axial_strain, axial_stress, axial_force, slip,
/// bond_stress (BarState).
std::string bar_table(const Network& network, const BarState& state);

}  // namespace perilink

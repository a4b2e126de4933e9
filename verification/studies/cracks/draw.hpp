#pragma once

#include <vector>

#include "app/plot/svg.hpp"
#include "cracks.hpp"

namespace perilink::verification {

/// Cracks of all runs, one panel for each specimen; coarser lattices in fainter lines.
Svg draw_paths(const std::vector<CrackRun>& runs);

/// Dissipated energy over the energy that the crack of the moment accounts for, at the finest
/// spacing of each specimen.
Svg draw_energies(const std::vector<CrackRun>& runs);

}  // namespace perilink::verification

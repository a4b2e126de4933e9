#pragma once

#include <vector>

#include "app/plot/svg.hpp"
#include "size_effect.hpp"

namespace perilink::verification {

/// Figs. 3-6 of Gerstle, Sau & Aguilera (2007): the closed form as lines, bonds as circles.
Svg draw_neighbourhoods(const std::vector<NeighbourhoodRow>& rows);

/// Apparent modulus of bars over their width: uncorrected and calibrated.
Svg draw_bars(const std::vector<BarRow>& rows);

}  // namespace perilink::verification

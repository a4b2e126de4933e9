#pragma once

#include <array>
#include <string>

namespace perilink {

/// Colour of an undamaged particle.
inline constexpr const char* undamaged_color = "#d8dade";

/// Colours distinct in print and for colour-blind readers, after Okabe & Ito (2008), without
/// yellow.
inline constexpr std::array distinct_colors = {"#0072b2", "#d55e00", "#009e73",
                                               "#cc79a7", "#56b4e9", "#e69f00"};

/// Returns the perceptually uniform colour "#rrggbb" of a number between 0 (pale yellow) and 1
/// (black violet).
std::string damage_color(double fraction);

}  // namespace perilink

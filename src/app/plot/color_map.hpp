#pragma once

#include <string>

namespace perilink {

/// Colour of an undamaged particle.
inline constexpr const char* undamaged_color = "#d8dade";

/// Perceptually uniform colour "#rrggbb" of a number between 0 (pale yellow) and 1 (black violet).
std::string damage_color(double fraction);

}  // namespace perilink

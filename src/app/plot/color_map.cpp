#include "app/plot/color_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace perilink {
namespace {

using Rgb = std::array<int, 3>;

/// The colour map "magma" of matplotlib (S. van der Walt and N. Smith, CC0) at every tenth, from
/// light to dark, so that cracks are dark on paper.
constexpr std::array<Rgb, 11> stops = {{{252, 253, 191},
                                        {254, 207, 146},
                                        {254, 159, 109},
                                        {247, 112, 92},
                                        {222, 73, 104},
                                        {183, 55, 121},
                                        {140, 41, 129},
                                        {100, 26, 128},
                                        {59, 15, 112},
                                        {20, 14, 54},
                                        {0, 0, 4}}};

}  // namespace

std::string damage_color(double fraction) {
  const double place = std::clamp(fraction, 0.0, 1.0) * (stops.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const double rest = place - static_cast<double>(below);
  Rgb color{};
  for (std::size_t c = 0; c < 3; ++c) {
    color[c] =
        static_cast<int>(std::lround((1.0 - rest) * stops[below][c] + rest * stops[below + 1][c]));
  }
  return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

}  // namespace perilink

#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/plot/svg.hpp"

/// \file
/// Lines through marks, distinct in colour and mark, with a legend to the right of the frame.

namespace perilink {

struct MarkedLine {
  std::string name;              ///< in the legend
  std::vector<SvgPoint> points;  ///< [px]
  bool filled = false;           ///< the outline of an area, without marks
};

/// Returns width and height that the legend needs to the right of and below the corner given to
/// draw_marked_lines() [px].
SvgPoint room_of_lines(std::span<const MarkedLine> lines);

/// Draws lines and legend. \param corner  upper right corner of the frame [px]
void draw_marked_lines(Svg& svg, std::span<const MarkedLine> lines, SvgPoint corner);

}  // namespace perilink

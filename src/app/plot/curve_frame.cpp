#include "app/plot/curve_frame.hpp"

#include <algorithm>
#include <cmath>

namespace perilink {

CurveFrame make_curve_frame(std::span<const CurvePoint> points, double top) {
  CurvePoint low, high;
  for (const CurvePoint& point : points) {
    low.displacement = std::min(low.displacement, point.displacement);
    high.displacement = std::max(high.displacement, point.displacement);
    low.load = std::min(low.load, point.load);
    high.load = std::max(high.load, point.load);
  }
  return {make_axis(low.displacement, high.displacement, 92.0, curve_figure_width - 32.0),
          make_axis(low.load, high.load, curve_figure_height - 72.0, top)};
}

SvgPath curve_path(const CurveFrame& frame, std::span<const CurvePoint> points, CurvePoint from) {
  // Points closer than this are skipped, to keep files of thousands of events small [px].
  constexpr double visible_distance = 0.3;
  SvgPath path;
  SvgPoint last = frame.at(from);
  path.move_to(last);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const SvgPoint at = frame.at(points[k]);
    const bool end = k + 1 == points.size();
    if (!end && std::hypot(at.x - last.x, at.y - last.y) < visible_distance) continue;
    path.line_to(at);
    last = at;
  }
  return path;
}

}  // namespace perilink

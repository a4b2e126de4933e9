#pragma once

#include <span>

#include "analysis/quasistatic/load_curve.hpp"
#include "app/plot/plot_axes.hpp"
#include "app/plot/svg.hpp"

/// \file
/// Frame of load–displacement plots.

namespace perilink {

inline constexpr double curve_figure_width = 820.0;   ///< [px]
inline constexpr double curve_figure_height = 560.0;  ///< [px]

/// Axes of the plot: displacements to the right, loads upwards.
struct CurveFrame {
  Axis x;
  Axis y;

  SvgPoint at(CurvePoint point) const { return {x.map(point.displacement), y.map(point.load)}; }
};

/// Returns a frame around all points and the origin.
/// \param top  upper edge of the frame on the page [px]
CurveFrame make_curve_frame(std::span<const CurvePoint> points, double top);

/// Returns a curve through `points`, starting from `from`. Points within a pixel of the last one
/// are skipped.
SvgPath curve_path(const CurveFrame& frame, std::span<const CurvePoint> points,
                   CurvePoint from = {});

}  // namespace perilink

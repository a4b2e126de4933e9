#pragma once

#include <span>

#include "analysis/quasistatic/load_curve.hpp"
#include "app/plot/plot_axes.hpp"
#include "app/plot/svg.hpp"

/// \file
/// The frame of pictures of load–displacement curves.

namespace perilink {

inline constexpr double curve_figure_width = 820.0;   ///< [px]
inline constexpr double curve_figure_height = 560.0;  ///< [px]

/// Displacements to the right, loads upwards.
struct CurveFrame {
  Axis x;
  Axis y;

  SvgPoint at(CurvePoint point) const { return {x.map(point.displacement), y.map(point.load)}; }
};

/// Frame around all points and the origin.
/// \param top  upper edge of the frame on the page [px]
CurveFrame make_curve_frame(std::span<const CurvePoint> points, double top);

/// The curve from a point, else the origin, through others, without those that fall on the pixel of
/// another.
SvgPath curve_path(const CurveFrame& frame, std::span<const CurvePoint> points,
                   CurvePoint from = {});

}  // namespace perilink

#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/quasistatic/observer.hpp"
#include "app/plot/curve_frame.hpp"
#include "app/plot/plot_labels.hpp"
#include "app/plot/svg.hpp"

namespace perilink {

/// Curve of a stage, starting from the loads at its beginning.
struct StagePath {
  Index number = 0;  ///< from one
  std::string name;
  std::vector<CurvePoint> points;
};

/// Returns the stages of a history; empty: it has none. A stage that changes the loads of the
/// previous stage continues its curve; others start at their first row, since their axes differ.
std::vector<StagePath> paths_of_stages(std::span<const StepRecord> records,
                                       const PlotLabels& labels);

/// Draws every stage in its own colour, with a number at its beginning, and the legend.
/// \param legend       left end of the first legend line, at mid-height [px]
/// \param line_height  distance of legend lines [px]
void draw_stages(Svg& svg, const CurveFrame& frame, std::span<const StagePath> stages,
                 SvgPoint legend, double line_height);

}  // namespace perilink

#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/quasistatic/observer.hpp"
#include "app/plot/curve_frame.hpp"
#include "app/plot/plot_labels.hpp"
#include "app/plot/svg.hpp"

namespace perilink {

/// The curve of a stage, from where its loads were when it began.
struct StagePath {
  Index number = 0;  ///< from one
  std::string name;
  std::vector<CurvePoint> points;
};

/// The stages of a history; empty: it has none. Loads that change again go on from the row before;
/// others begin at their own first row, since both axes are theirs.
std::vector<StagePath> paths_of_stages(std::span<const StepRecord> records,
                                       const PlotLabels& labels);

/// Every stage in a colour of its own, with its number where it begins, and their names.
/// \param legend       middle of the first line of the legend, at its left [px]
/// \param line_height  distance of its lines [px]
void draw_stages(Svg& svg, const CurveFrame& frame, std::span<const StagePath> stages,
                 SvgPoint legend, double line_height);

}  // namespace perilink

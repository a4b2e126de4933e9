#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/plot/svg.hpp"

namespace perilink {

/// Errors of one series of a study, against unknowns or seconds.
struct ConvergenceLine {
  struct Point {
    double cost = 0.0;
    double error = 0.0;
  };
  std::string name;
  std::vector<Point> points;    ///< points with non-positive values are not drawn
  std::optional<double> order;  ///< order in the legend, if known
};

/// Labels and lines of a log-log plot.
struct ConvergencePlot {
  std::string title;
  std::string cost_label;
  std::string error_label;
  std::vector<ConvergenceLine> lines;
};

/// Draws error over cost on logarithmic axes, with a colour and mark for each series and a legend
/// to the right.
Svg draw_convergence(const ConvergencePlot& plot);

}  // namespace perilink

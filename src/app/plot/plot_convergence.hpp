#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/plot/svg.hpp"

namespace perilink {

/// Errors of one combination of a study, against unknowns or seconds.
struct ConvergenceLine {
  struct Point {
    double cost = 0.0;
    double error = 0.0;
  };
  std::string name;
  std::vector<Point> points;    ///< those that are not positive are left out
  std::optional<double> order;  ///< number in the legend; none: left out
};

/// Labels and lines of a log-log picture.
struct ConvergencePlot {
  std::string title;
  std::string cost_label;
  std::string error_label;
  std::vector<ConvergenceLine> lines;
};

/// Error over cost, both axes logarithmic, one line with its own colour and mark for each
/// combination, and a legend to the right.
Svg draw_convergence(const ConvergencePlot& plot);

}  // namespace perilink

#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/plot/svg.hpp"
#include "app/scan/scan_result.hpp"
#include "io/case/scan_file.hpp"

namespace perilink {

/// Results over one key of a scan.
struct ScanPlot {
  struct Point {
    double x = 0.0;
    double y = 0.0;
  };
  struct Line {
    std::string name;                 ///< values of the other keys; empty: there are none
    std::vector<Point> points;        ///< in the order of x; the outline of a histogram
    std::optional<double> mean = {};  ///< of a histogram
  };
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<Line> lines;
};

/// Returns the peak loads, or the strain energies of elastic runs, over the first key with several
/// numbers, with a line for each combination of the other keys. Without such a key they are over
/// the numbers of the members. Scans with seeds give a histogram for each combination of keys.
/// \param units  of the case, "kN, m"
ScanPlot scan_plot(const ScanFile& scan, std::span<const ScanResult> results,
                   const std::string& units);

/// Draws scan.svg.
Svg draw_scan(const ScanPlot& plot);

}  // namespace perilink

#pragma once

#include <string>

#include "app/plot/plot_labels.hpp"
#include "app/plot/svg.hpp"
#include "io/text/csv.hpp"

namespace perilink {

/// Axial stress above, bond stress below, over the distance from the beginning of each bar.
/// \param table    rows of a bars_STEP.csv
/// \param path     where it was, for messages
/// \param caption  stands below the title
/// \throws FileError where columns are missing, or numbers too large to be drawn
Svg draw_bars(const CsvTable& table, const std::string& path, const std::string& caption,
              const PlotLabels& labels);

}  // namespace perilink

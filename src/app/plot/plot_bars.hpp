#pragma once

#include <string>

#include "app/plot/plot_labels.hpp"
#include "app/plot/svg.hpp"
#include "io/text/csv.hpp"

namespace perilink {

/// Draws axial stress above and bond stress below, over the distance from the start of each bar.
/// \param table    rows of a bars_STEP.csv
/// \param path     path of the table, for messages
/// \param caption  text below the title
/// \throws FileError where columns are missing, or numbers too large to be drawn
Svg draw_bars(const CsvTable& table, const std::string& path, const std::string& caption,
              const PlotLabels& labels);

}  // namespace perilink

#pragma once

#include <string>
#include <vector>

namespace perilink {

/// Options of `perilink plot`.
struct PlotOptions {
  std::string directory;  ///< folder of the results
  std::string out;        ///< folder of the pictures; empty: `directory`
  double scale = 0.0;     ///< factor on the displacements; 0: automatic
  /// Columns of the history to draw over each other; empty: displacement and load.
  std::string x = {}, y = {};
  std::string at = {};     ///< row of the field file to draw (row_of_choice); empty: all
  std::string field = {};  ///< number per particle as colour; empty: damage or stress
  std::vector<double> range =
      {};                  ///< smallest and largest value of the colours; empty: of the file
  bool whole = false;      ///< curves show the tail below a hundredth of the peak
  bool png = false;        ///< also as PNG, by rsvg-convert
  bool animation = false;  ///< only the body, as PNG at one scale, joined as animation.png
};

/// Draws history.csv as load_displacement.svg and every file of fields.pvd as fields_<row>.svg.
/// With columns, draws only their curve, Y_over_X.svg; with a row, field or range only the body.
/// Title and units come from summary.json where it exists.
/// \returns the exit status
/// \throws FileError
int plot_results(const PlotOptions& options);

}  // namespace perilink

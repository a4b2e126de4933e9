#pragma once

#include <string>

namespace perilink {

/// Options of `perilink plot`.
struct PlotOptions {
  std::string directory;  ///< folder of the results
  std::string out;        ///< folder of the pictures; empty: `directory`
  double scale = 0.0;     ///< factor on the displacements; 0: automatic
};

/// Draws history.csv as load_displacement.svg and every file of fields.pvd as fields_<row>.svg.
/// Title and units come from summary.json where it exists.
/// \returns the exit status
/// \throws FileError
int plot_results(const PlotOptions& options);

}  // namespace perilink

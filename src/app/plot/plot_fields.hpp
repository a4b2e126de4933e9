#pragma once

#include <optional>
#include <string>

#include "app/plot/plot_body.hpp"
#include "app/plot/plot_labels.hpp"
#include "app/plot/svg.hpp"

namespace perilink {

/// Numbers of the state that the figure quotes.
struct FieldsCaption {
  Index broken_bonds = 0;
  double load_factor = 0.0;
  double load = 0.0;
  std::optional<double> time = std::nullopt;  ///< in explicit analyses, which count no bonds
};

/// The deformed body: particles coloured by damage, or by the von Mises stress where the file has
/// stresses (elastic analyses), the faces of cracks, bars, ghosts.
/// \param scale  factor on the displacements; 0: automatic
Svg draw_fields(const PlotBody& body, const FieldsCaption& caption, const PlotLabels& labels,
                double scale);

}  // namespace perilink

#pragma once

#include <optional>
#include <string>

#include "app/plot/plot_body.hpp"
#include "app/plot/plot_labels.hpp"
#include "app/plot/svg.hpp"

namespace perilink {

/// Numbers in the caption of the figure.
struct FieldsCaption {
  Index broken_bonds = 0;
  double load_factor = 0.0;
  double load = 0.0;
  std::optional<double> time = std::nullopt;  ///< explicit analyses only
};

/// Draws the deformed body: particles coloured by damage, or by von Mises stress in elastic
/// analyses, crack faces, bars and ghosts.
/// \param scale  factor on the displacements; 0: automatic
Svg draw_fields(const PlotBody& body, const FieldsCaption& caption, const PlotLabels& labels,
                double scale);

}  // namespace perilink

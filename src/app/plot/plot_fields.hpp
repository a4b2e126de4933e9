#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/plot/plot_body.hpp"
#include "app/plot/plot_labels.hpp"
#include "app/plot/plot_page.hpp"
#include "app/plot/svg.hpp"

namespace perilink {

/// Numbers in the caption of the figure.
struct FieldsCaption {
  Index broken_bonds = 0;
  double load_factor = 0.0;
  double load = 0.0;
  std::optional<double> time = std::nullopt;  ///< explicit analyses only
};

/// Colours of the particles.
struct ParticleColors {
  std::vector<double> values;  ///< per particle
  ColorBar bar;
  bool grey_zero = false;  ///< values of zero and below have the colour of undamaged particles
};

/// Returns colours of damage; of elastic analyses of the von Mises stress.
ParticleColors usual_colors(const PlotBody& body, const PlotLabels& labels);

/// Returns the rectangle in which a body is drawn.
/// \param scale  factor on the displacements
ViewBox view_of_body(const PlotBody& body, double scale);

/// Draws the deformed body: particles with their colours, crack faces, bars and ghosts.
/// \param scale   factor on the displacements; 0: automatic
/// \param colors  absent: usual_colors()
/// \param box     shown part; absent: the body
Svg draw_fields(const PlotBody& body, const FieldsCaption& caption, const PlotLabels& labels,
                double scale, const std::optional<ParticleColors>& colors = {},
                const std::optional<ViewBox>& box = {});

}  // namespace perilink

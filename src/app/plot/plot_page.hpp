#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "app/plot/plot_body.hpp"
#include "app/plot/plot_labels.hpp"
#include "app/plot/svg.hpp"

/// \file
/// Page of a picture of the body: position, axes, scale bar, colour bar and key.

namespace perilink {

/// Rectangle of the page on which the deformed body is drawn.
struct BodyPage {
  double left = 0.0, right = 0.0, top = 0.0, bottom = 0.0;  ///< [px]
  double width = 0.0, height = 0.0;                         ///< whole page [px]
  double pixels = 1.0;                                      ///< per unit of length
  Vector3 low{};  ///< corner of the view, at (left, bottom)

  SvgPoint at(const Vector3& seen) const {
    return {left + (seen[0] - low[0]) * pixels, bottom - (seen[1] - low[1]) * pixels};
  }
};

/// Rectangle of the projected points that a picture shows [length].
struct ViewBox {
  std::array<double, 2> low{infinity, infinity}, high{-infinity, -infinity};

  /// Grows to hold another rectangle.
  void add(const ViewBox& other);
};

/// Returns the rectangle of the drawn points, without particles that lost all bonds, with room for
/// the arrows of loads.
ViewBox view_of(const PlotBody& body, const std::vector<Vector3>& seen);

/// Returns a page that shows the rectangle.
BodyPage make_page(const ViewBox& box);

/// Entry of the key under the picture: a sample drawn with `style` and its name.
struct KeyEntry {
  std::string name;
  std::string style;
  bool dot = false;  ///< the sample is a dot, not a line
};

/// Draws supports as short lines along the held axes, and forces and prescribed displacements as
/// arrows outside of the body, at most 60 of each.
/// \param seen     deformed and projected particles
/// \param visible  per particle: it is not hidden by others
/// \return entries of the key
std::vector<KeyEntry> draw_conditions(Svg& svg, const BodyPage& page, const PlotBody& body,
                                      const std::vector<Vector3>& seen,
                                      const std::vector<std::uint8_t>& visible);

/// Meaning of the particle colours.
struct ColorBar {
  std::string label = "damage";
  double low = 0.0;
  double high = 1.0;
};

/// Draws title, caption, axes (in space their directions in a corner), scale bar, colour bar and
/// key.
void draw_page(Svg& svg, const BodyPage& page, int dim, const PlotLabels& labels,
               const std::string& caption, const ColorBar& colors,
               const std::vector<KeyEntry>& key);

}  // namespace perilink

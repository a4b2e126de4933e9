#include "draw.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "app/plot/plot_axes.hpp"

namespace perilink::verification {
namespace {

constexpr const char* text_style = "font-family=\"sans-serif\" font-size=\"13\" fill=\"#333\"";
constexpr std::array<const char*, 5> colors = {"#c1440e", "#2f5d9b", "#3d7d3a", "#7a4b9b",
                                               "#a07800"};

struct Panel {
  const char* label;
  double LayerModuli::*entry;
  Axis x;
  Axis y;
};

/// Rows of one Poisson's ratio come together.
void draw_panel(Svg& svg, const Panel& panel, const std::vector<NeighbourhoodRow>& rows) {
  draw_axes(svg, panel.x, panel.y, "a / horizon", panel.label, Grid::lines);
  std::size_t color = 0;
  for (std::size_t first = 0; first < rows.size(); ++color) {
    SvgPath line;
    std::size_t k = first;
    for (; k < rows.size() && rows[k].poissons_ratio == rows[first].poissons_ratio; ++k) {
      const double x = panel.x.map(rows[k].depth);
      svg.circle({x, panel.y.map(rows[k].found.*panel.entry)}, 3.0,
                 fmt::format("fill=\"none\" stroke=\"{}\"", colors[color % colors.size()]));
      const SvgPoint at{x, panel.y.map(rows[k].exact.*panel.entry)};
      if (line.empty()) {
        line.move_to(at);
      } else {
        line.line_to(at);
      }
    }
    svg.path(line, fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.2\"",
                               colors[color % colors.size()]));
    first = k;
  }
}

void draw_key(Svg& svg, SvgPoint at, const std::vector<NeighbourhoodRow>& rows) {
  std::size_t color = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (k > 0 && rows[k].poissons_ratio == rows[k - 1].poissons_ratio) continue;
    svg.line(at, {at.x + 26, at.y},
             fmt::format("stroke=\"{}\" stroke-width=\"1.5\"", colors[color++ % colors.size()]));
    svg.text({at.x + 34, at.y + 4.5}, fmt::format("ν = {}", rows[k].poissons_ratio), "start",
             text_style);
    at.x += 115;
  }
  svg.text({at.x, at.y + 4.5}, "lines: closed form, circles: bonds", "start", text_style);
}

}  // namespace

Svg draw_neighbourhoods(const std::vector<NeighbourhoodRow>& rows) {
  Svg svg(1000, 790);
  const std::array<Panel, 4> panels = {{
      {"E₁ / E", &LayerModuli::e1, {0, 1.02, 90, 480}, {0.4, 1.05, 330, 30}},
      {"E₂ / E", &LayerModuli::e2, {0, 1.02, 590, 980}, {0.4, 1.05, 330, 30}},
      {"ν₁₂", &LayerModuli::nu12, {0, 1.02, 90, 480}, {-0.05, 0.3, 700, 400}},
      {"ν₂₃", &LayerModuli::nu2, {0, 1.02, 590, 980}, {-0.05, 0.3, 700, 400}},
  }};
  for (const Panel& panel : panels) draw_panel(svg, panel, rows);
  draw_key(svg, {90, 770}, rows);
  return svg;
}

Svg draw_bars(const std::vector<BarRow>& rows) {
  Svg svg(640, 430);
  const Axis x{0, rows.back().width * 1.05, 90, 620}, y{0.5, 1.05, 340, 30};
  draw_axes(svg, x, y, "width / horizon", "apparent modulus / E", Grid::lines);
  SvgPath exact;
  for (const BarRow& row : rows) {
    const SvgPoint at{x.map(row.width), y.map(row.exact)};
    if (exact.empty()) {
      exact.move_to(at);
    } else {
      exact.line_to(at);
    }
    if (!std::isnan(row.calibrated)) {
      svg.circle({at.x, y.map(row.calibrated)}, 4.0, "fill=\"#2f5d9b\"");
    }
    svg.circle({at.x, y.map(row.uncorrected)}, 4.0,
               "fill=\"none\" stroke=\"#c1440e\" stroke-width=\"1.5\"");
  }
  svg.path(exact, "fill=\"none\" stroke=\"#c1440e\" stroke-width=\"1.2\"");
  svg.circle({100, 409}, 4.0, "fill=\"none\" stroke=\"#c1440e\" stroke-width=\"1.5\"");
  svg.text({112, 413.5}, "uncorrected (line: closed form)", "start", text_style);
  svg.circle({370, 409}, 4.0, "fill=\"#2f5d9b\"");
  svg.text({382, 413.5}, "calibrated", "start", text_style);
  return svg;
}

}  // namespace perilink::verification

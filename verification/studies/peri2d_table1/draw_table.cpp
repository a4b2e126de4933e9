#include "draw_table.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "app/plot/plot_axes.hpp"

namespace perilink::verification {
namespace {

struct Curve {
  const char* name;
  const char* color;
  double BarErrors::*entry;
};

constexpr std::array<Curve, 3> curves = {{
    {"strain x", "#c1440e", &BarErrors::strain_x},
    {"strain y", "#2f5d9b", &BarErrors::strain_y},
    {"displacement", "#3d7d3a", &BarErrors::displacement},
}};

constexpr const char* text_style = "font-family=\"sans-serif\" font-size=\"13\" fill=\"#333\"";

struct Panel {
  Pattern pattern;
  const char* title;
  Axis x;
  Axis y;
};

void draw_curve(Svg& svg, const Panel& panel, const Curve& curve,
                const std::vector<TableRow>& rows) {
  SvgPath line;
  for (const TableRow& row : rows) {
    if (row.grid.pattern != panel.pattern) continue;
    const double x = panel.x.map(row.grid.columns);
    const double found = row.found.*curve.entry;
    if (found < panel.y.low) continue;  // n = 4 of the rectangular pattern: -100
    const SvgPoint at{x, panel.y.map(found)};
    if (line.empty()) {
      line.move_to(at);
    } else {
      line.line_to(at);
    }
    const double printed = row.printed.*curve.entry;
    if (std::isnan(printed)) continue;
    svg.circle({x, panel.y.map(printed)}, 4.0,
               fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"", curve.color));
  }
  svg.path(line, fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.2\"", curve.color));
}

void draw_key(Svg& svg, SvgPoint at) {
  for (const Curve& curve : curves) {
    svg.line(at, {at.x + 26, at.y}, fmt::format("stroke=\"{}\" stroke-width=\"1.2\"", curve.color));
    svg.circle({at.x + 13, at.y}, 4.0,
               fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"", curve.color));
    svg.text({at.x + 34, at.y + 4.5}, curve.name, "start", text_style);
    at.x += 140;
  }
  svg.text({at.x, at.y + 4.5}, "circles: printed, lines: this program", "start", text_style);
}

}  // namespace

Svg draw_table(const std::vector<TableRow>& rows) {
  Svg svg(1000, 470);
  const std::array<Panel, 2> panels = {{
      {Pattern::rectangular, "rectangular", {3.5, 18.5, 90, 480}, {-45, 35, 370, 50}},
      {Pattern::hexagonal, "hexagonal", {3.5, 18.5, 590, 980}, {-20, 5, 370, 50}},
  }};
  for (const Panel& panel : panels) {
    draw_axes(svg, panel.x, panel.y, "particles across the bar", "error in percent", Grid::lines);
    svg.text({panel.x.pixel_low, 32}, panel.title, "start", text_style);
    for (const Curve& curve : curves) draw_curve(svg, panel, curve, rows);
  }
  draw_key(svg, {90, 450});
  return svg;
}

}  // namespace perilink::verification

#include "pictures.hpp"

#include <cmath>

#include <fmt/format.h>

#include "app/plot/plot_axes.hpp"

namespace perilink::verification {
namespace {

constexpr const char* text_style = "font-family=\"sans-serif\" font-size=\"13\" fill=\"#333\"";

const char* color_of(const std::string& body) {
  return body == "lattice" ? "#2f5d9b" : body == "mesh" ? "#c1440e" : "#3d7d3a";
}

void draw_line(Svg& svg, const Axis& x, const Axis& y,
               const std::vector<std::pair<double, double>>& points, const std::string& style) {
  SvgPath path;
  for (const auto& [at, value] : points) {
    const SvgPoint point{x.map(at), y.map(value)};
    path.empty() ? path.move_to(point) : path.line_to(point);
  }
  svg.path(path, "fill=\"none\" " + style);
}

void draw_key(Svg& svg, SvgPoint at, const std::string& body, const std::string& text) {
  svg.circle(at, 3.5, fmt::format("fill=\"{}\"", color_of(body)));
  svg.text({at.x + 10, at.y + 4.5}, text, "start", text_style);
}

double compressive_strength(const std::vector<PlateRow>& rows, const std::string& body) {
  for (const PlateRow& row : rows) {
    if (row.body == body && row.x == 0.0 && row.y < 0.0) return row.strength;
  }
  return 1.0;
}

struct Panels {
  Axis x[2], y[2];
};

Panels draw_panels(Svg& svg, double tensile, double compressive) {
  const Panels panels{{{0, tensile, 90, 430}, {0, compressive, 550, 890}},
                      {{0, 5, 360, 30}, {0, 40, 360, 30}}};
  for (int k = 0; k < 2; ++k) {
    draw_axes(svg, panels.x[k], panels.y[k], k ? "shortening" : "extension",
              k ? "compression (MPa)" : "tension (MPa)", Grid::lines);
  }
  return panels;
}

}  // namespace

Svg draw_uniform(const std::vector<UniformRow>& rows) {
  Svg svg(930, 450);
  const Panels panels = draw_panels(svg, 3.6e-4, 3.6e-3);
  for (int k = 0; k < 4; ++k) {
    const int panel = k / 2;
    const bool shear_softens = k % 2 == 1;
    std::vector<std::pair<double, double>> line{{0.0, 0.0}};
    for (const UniformRow& row : rows) {
      if (row.shear_softens != shear_softens || (row.reference < 0.0) != (panel == 1)) continue;
      const double strain = std::abs(row.strain);
      line.emplace_back(strain, std::abs(row.reference));
      svg.circle({panels.x[panel].map(strain), panels.y[panel].map(std::abs(row.stress))}, 2.5,
                 fmt::format("fill=\"{}\"", color_of("mesh")));
    }
    draw_line(svg, panels.x[panel], panels.y[panel], line,
              fmt::format("stroke=\"#888\" stroke-width=\"1.4\"{}",
                          shear_softens ? " stroke-dasharray=\"5 4\"" : ""));
  }
  draw_key(svg, {95, 435}, "mesh", "particles in no rows, horizon of 4 edges");
  svg.text({550, 439.5}, "grey: integration of the law; broken: shear falls", "start", text_style);
  return svg;
}

Svg draw_envelope(const std::vector<PlateRow>& rows) {
  Svg svg(640, 630);
  const Axis x{-1.6, 0.3, 90, 600}, y{-1.6, 0.3, 540, 30};
  draw_axes(svg, x, y, "σ₁ / f_c", "σ₂ / f_c", Grid::lines);
  svg.line({x.map(-1.6), y.map(0)}, {x.map(0.3), y.map(0)}, "stroke=\"#333\"");
  svg.line({x.map(0), y.map(-1.6)}, {x.map(0), y.map(0.3)}, "stroke=\"#333\"");
  for (const PlateRow& row : rows) {
    const double scale = row.strength / compressive_strength(rows, row.body);
    if (scale == 0.0 || scale > 1.6) continue;  // did not fail, or far outside
    for (const auto& [a, b] : {std::pair{row.x, row.y}, std::pair{row.y, row.x}}) {
      svg.circle({x.map(a * scale), y.map(b * scale)}, 4,
                 fmt::format("fill=\"{}\"", color_of(row.body)));
    }
  }
  for (const auto& [a, b] :
       {std::pair{-1.16, -1.16}, std::pair{-1.25, -0.625}, std::pair{-0.625, -1.25},
        std::pair{-1.0, 0.0}, std::pair{0.0, -1.0}}) {
    svg.circle({x.map(a), y.map(b)}, 7, "fill=\"none\" stroke=\"#333\" stroke-width=\"1.4\"");
  }
  draw_key(svg, {95, 612}, "lattice", "lattice");
  draw_key(svg, {190, 612}, "mesh", "mesh");
  draw_key(svg, {270, 612}, "slab", "slab in space");
  svg.text({410, 616.5}, "circles: Kupfer et al. (1969)", "start", text_style);
  return svg;
}

Svg draw_curves(const std::vector<PlateCurve>& plates) {
  Svg svg(930, 450);
  const Panels panels = draw_panels(svg, 3e-4, 3e-3);
  for (const PlateCurve& plate : plates) {
    for (int k = 0; k < 2; ++k) {
      draw_line(svg, panels.x[k], panels.y[k], k ? plate.compression : plate.tension,
                fmt::format("stroke=\"{}\" stroke-width=\"1\"", color_of(plate.body)));
    }
  }
  draw_key(svg, {95, 435}, "lattice", "lattice");
  draw_key(svg, {200, 435}, "mesh", "mesh");
  return svg;
}

}  // namespace perilink::verification

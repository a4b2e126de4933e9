#include "pictures.hpp"

#include <algorithm>
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

bool is_uniaxial(const PlateRun& run, bool compression) {
  return compression ? run.x == 0.0 && run.y < 0.0 : run.y == 0.0;
}

double compressive_strength(const std::vector<PlateRun>& runs, const std::string& body) {
  for (const PlateRun& run : runs) {
    if (run.body == body && is_uniaxial(run, true)) return run.result.strength;
  }
  return 1.0;
}

}  // namespace

Svg draw_uniform(const std::vector<UniformRun>& runs) {
  Svg svg(900, 430);
  const Axis x[] = {{0, 3.6e-4, 70, 420}, {0, 3.6e-3, 510, 860}};
  const Axis y[] = {{0, 5, 360, 30}, {0, 40, 360, 30}};
  for (int panel = 0; panel < 2; ++panel) {
    draw_axes(svg, x[panel], y[panel], panel ? "shortening ε₁" : "extension ε₁",
              panel ? "compression (MPa)" : "tension (MPa)", Grid::lines);
    for (const UniformRun& run : runs) {
      const bool compression = run.reference.points.front().strain < 0.0;
      if (run.reference.held_across || compression != (panel == 1)) continue;
      std::vector<std::pair<double, double>> line{{0.0, 0.0}};
      for (const HomogeneousPoint& point : run.reference.points) {
        line.emplace_back(std::abs(point.strain), std::abs(point.stress));
      }
      draw_line(svg, x[panel], y[panel], line,
                fmt::format("stroke=\"#888\" stroke-width=\"1.4\"{}",
                            run.reference.shear_softens ? " stroke-dasharray=\"5 4\"" : ""));
      for (const HomogeneousPoint& point : run.points) {
        svg.circle({x[panel].map(std::abs(point.strain)), y[panel].map(std::abs(point.stress))},
                   2.5, fmt::format("fill=\"{}\"", color_of("mesh")));
      }
    }
  }
  draw_key(svg, {90, 415}, "mesh", "bonds of a mesh, horizon of 4 edges");
  svg.text({510, 419.5}, "grey: integration of the law; broken: shear falls", "start", text_style);
  return svg;
}

Svg draw_envelope(const std::vector<PlateRun>& runs) {
  Svg svg(560, 600);
  const Axis x{-1.6, 0.3, 70, 530}, y{-1.6, 0.3, 530, 70};
  draw_axes(svg, x, y, "σ₁ / f_c", "σ₂ / f_c", Grid::lines);
  svg.line({x.map(-1.6), y.map(0)}, {x.map(0.3), y.map(0)}, "stroke=\"#333\"");
  svg.line({x.map(0), y.map(-1.6)}, {x.map(0), y.map(0.3)}, "stroke=\"#333\"");
  for (const PlateRun& run : runs) {
    const double scale = run.result.strength / compressive_strength(runs, run.body);
    if (run.result.broken == 0) continue;
    for (const auto& [a, b] : {std::pair{run.x, run.y}, std::pair{run.y, run.x}}) {
      svg.circle({x.map(a * scale), y.map(b * scale)}, 4,
                 fmt::format("fill=\"{}\"", color_of(run.body)));
    }
  }
  for (const auto& [a, b] :
       {std::pair{-1.16, -1.16}, std::pair{-1.25, -0.625}, std::pair{-0.625, -1.25},
        std::pair{-1.0, 0.0}, std::pair{0.0, -1.0}}) {
    svg.circle({x.map(a), y.map(b)}, 6, "fill=\"none\" stroke=\"#333\" stroke-width=\"1.4\"");
  }
  draw_key(svg, {80, 575}, "lattice", "lattice");
  draw_key(svg, {170, 575}, "mesh", "mesh");
  draw_key(svg, {250, 575}, "slab", "slab in space");
  svg.text({380, 579.5}, "circles: Kupfer et al. (1969)", "start", text_style);
  return svg;
}

Svg draw_curves(const std::vector<PlateRun>& runs) {
  Svg svg(900, 430);
  const Axis x[] = {{0, 4e-4, 70, 420}, {0, 4e-3, 510, 860}};
  const Axis y[] = {{0, 5, 360, 30}, {0, 40, 360, 30}};
  for (int panel = 0; panel < 2; ++panel) {
    draw_axes(svg, x[panel], y[panel], panel ? "mean shortening" : "mean extension",
              panel ? "compression (MPa)" : "tension (MPa)", Grid::lines);
    for (const PlateRun& run : runs) {
      if (!is_uniaxial(run, panel == 1)) continue;
      std::vector<std::pair<double, double>> line{{0.0, 0.0}};
      for (const auto& point : run.result.curve) {
        if (point.first < x[panel].high) line.push_back(point);
      }
      draw_line(svg, x[panel], y[panel], line,
                fmt::format("stroke=\"{}\" stroke-width=\"1\"", color_of(run.body)));
    }
  }
  draw_key(svg, {90, 415}, "lattice", "lattice");
  draw_key(svg, {200, 415}, "mesh", "mesh");
  draw_key(svg, {310, 415}, "slab", "slab in space");
  return svg;
}

}  // namespace perilink::verification

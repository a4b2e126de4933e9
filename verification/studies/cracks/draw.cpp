#include "draw.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "app/plot/plot_axes.hpp"

namespace perilink::verification {
namespace {

constexpr const char* text_style = "font-family=\"sans-serif\" font-size=\"13\" fill=\"#333\"";
constexpr std::array<Surface, 3> surfaces = {Surface::calibrated, Surface::none, Surface::ghost};
constexpr std::array<const char*, 3> colors = {"#2f5d9b", "#c1440e", "#3d7d3a"};
constexpr double panel_width = 400.0, panel_height = 400.0;

const char* color_of(Surface surface) {
  return colors[std::find(surfaces.begin(), surfaces.end(), surface) - surfaces.begin()];
}

struct PathPanel {
  Shape shape;
  const char* title;
  const char* x_label;
  const char* y_label;
  Axis x, y;
};

void draw_key(Svg& svg, SvgPoint at, const std::string& note) {
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    svg.line(at, {at.x + 26, at.y}, fmt::format("stroke=\"{}\" stroke-width=\"2\"", colors[k]));
    svg.text({at.x + 34, at.y + 4.5}, surface_word(surfaces[k]), "start", text_style);
    at.x += 130;
  }
  svg.text({at.x, at.y + 4.5}, note, "start", text_style);
}

double finest_spacing(const std::vector<CrackRun>& runs, Shape shape) {
  double finest = INFINITY;
  for (const CrackRun& run : runs) {
    if (run.specimen.shape == shape) finest = std::min(finest, run.specimen.spacing);
  }
  return finest;
}

void draw_path(Svg& svg, const PathPanel& panel, const CrackRun& run, double finest) {
  SvgPath line;
  for (const CrackedRow& row : run.path.rows) {
    const bool rising = run.specimen.along == 1;
    const SvgPoint at = {panel.x.map(rising ? row.across : row.along),
                         panel.y.map(rising ? row.along : row.across)};
    if (line.empty()) {
      line.move_to(at);
    } else {
      line.line_to(at);
    }
  }
  const double refinement = run.specimen.spacing / finest;
  svg.path(line, fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" opacity=\"{}\"",
                             color_of(run.specimen.surface), refinement < 1.5 ? 2.0 : 1.2,
                             refinement < 1.5 ? 1.0 : 0.6 / refinement + 0.2));
}

void draw_growth(Svg& svg, const Axis& x, const Axis& y, const CrackRun& run) {
  SvgPath line;
  line.move_to({x.map(0.0), y.map(0.0)});
  for (const GrowthPoint& point : run.growth) {
    line.line_to({x.map(point.crack_energy), y.map(point.dissipated)});
  }
  svg.path(line, fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\"",
                             color_of(run.specimen.surface)));
}

}  // namespace

Svg draw_paths(const std::vector<CrackRun>& runs) {
  const std::array<PathPanel, 3> panels = {{
      {Shape::block,
       "Block in tension",
       "x (in)",
       "y (in)",
       {0, 100, 100, 430},
       {50, 150, 360, 30}},
      {Shape::notched_beam,
       "Notched beam",
       "x (mm)",
       "y (mm)",
       {184, 248, 520, 850},
       {32, 96, 360, 30}},
      {Shape::cracked_beam,
       "Cracked beam",
       "x (mm)",
       "y (mm)",
       {192, 240, 940, 1270},
       {48, 96, 360, 30}},
  }};
  Svg svg(3 * panel_width + 100, panel_height + 50);
  for (const PathPanel& panel : panels) {
    draw_axes(svg, panel.x, panel.y, panel.x_label, panel.y_label, Grid::lines);
    svg.text({0.5 * (panel.x.pixel_low + panel.x.pixel_high), 20}, panel.title, "middle",
             text_style);
    const double finest = finest_spacing(runs, panel.shape);
    for (const CrackRun& run : runs) {
      if (run.specimen.shape == panel.shape) draw_path(svg, panel, run, finest);
    }
  }
  draw_key(svg, {100, panel_height + 30}, "coarser lattices fainter");
  return svg;
}

Svg draw_energies(const std::vector<CrackRun>& runs) {
  Svg svg(3 * panel_width + 100, panel_height + 50);
  const std::array<const char*, 3> titles = {"Block in tension", "Notched beam", "Cracked beam"};
  double left = 100.0;
  for (const Shape shape : {Shape::block, Shape::notched_beam, Shape::cracked_beam}) {
    const double finest = finest_spacing(runs, shape);
    double most = 0.0, most_dissipated = 0.0;
    for (const CrackRun& run : runs) {
      if (run.specimen.shape != shape || run.specimen.spacing != finest) continue;
      most = std::max(most, run.path.energy);
      most_dissipated = std::max(most_dissipated, run.result.last.dissipated_energy);
    }
    const Axis x{0.0, 1.05 * most, left, left + 330}, y{0.0, 1.05 * most_dissipated, 360, 30};
    const std::string unit = shape == Shape::block ? "kip in" : "N mm";
    draw_axes(svg, x, y, fmt::format("G_F times area of the crack ({})", unit),
              fmt::format("dissipated energy ({})", unit), Grid::lines);
    svg.text({left + 165, 20}, titles[static_cast<std::size_t>(shape)], "middle", text_style);
    const double end = std::min(x.high, y.high);
    svg.line({x.map(0.0), y.map(0.0)}, {x.map(end), y.map(end)},
             "stroke=\"#888\" stroke-width=\"1.2\" stroke-dasharray=\"5 4\"");
    for (const CrackRun& run : runs) {
      if (run.specimen.shape == shape && run.specimen.spacing == finest)
        draw_growth(svg, x, y, run);
    }
    left += 420.0;
  }
  draw_key(svg, {100, panel_height + 30}, "broken line: G_F exactly");
  return svg;
}

}  // namespace perilink::verification

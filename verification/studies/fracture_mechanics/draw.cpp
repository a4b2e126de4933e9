#include "draw.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "app/plot/plot_axes.hpp"
#include "problems/handbook.hpp"

namespace perilink::verification {
namespace {

constexpr const char* label = "font-family=\"sans-serif\" font-size=\"13\" fill=\"#333\"";
constexpr std::array<const char*, 4> columns = {"bond-based, brittle", "micropolar, brittle",
                                                "bond-based, softening", "micropolar, softening"};

int column_of(const Make& make) { return (make.softens ? 2 : 0) + (make.micropolar ? 1 : 0); }

constexpr double panel_width = 190.0, panel_height = 130.0, left = 150.0, top = 40.0;

}  // namespace

Svg draw_cracks(const std::vector<CrackPicture>& pictures) {
  std::vector<std::string> rows;
  int first = 3;
  for (const CrackPicture& picture : pictures) {
    first = std::min(first, column_of(picture.make));
    const std::string name = name_of(picture.make.arrangement);
    if (rows.empty() || rows.back() != name) rows.push_back(name);
  }
  Svg svg(left + (4 - first) * panel_width + 10,
          top + static_cast<double>(rows.size()) * panel_height + 10);
  for (int k = first; k < 4; ++k) {
    svg.text({left + (k - first + 0.5) * panel_width, 25}, columns[k], "middle", label);
  }
  std::size_t row = 0;
  bool is_named = false;
  for (const CrackPicture& picture : pictures) {
    if (rows[row] != name_of(picture.make.arrangement)) {
      ++row;
      is_named = false;
    }
    const int column = column_of(picture.make) - first;
    const SvgPoint corner = {left + column * panel_width,
                             top + static_cast<double>(row) * panel_height};
    const double scale = panel_width / (9.0 * picture.crack.horizon);
    const SvgPoint tip = {corner.x + 0.25 * panel_width, corner.y + 0.5 * panel_height};
    svg.rect({corner.x + 3, corner.y + 3}, panel_width - 6, panel_height - 6,
             "fill=\"none\" stroke=\"#bbb\"");
    svg.line({corner.x + 3, tip.y}, tip, "stroke=\"#333\" stroke-width=\"2\"");
    svg.line(tip, {corner.x + panel_width - 3, tip.y}, "stroke=\"#999\" stroke-dasharray=\"4 3\"");
    SvgPath dots;
    for (const Place& place : picture.crack.broken) {
      const double x = tip.x + scale * (place[0] - picture.tip[0]);
      const double y = tip.y - scale * (place[1] - picture.tip[1]);
      const bool inside = x > corner.x + 3 && x < corner.x + panel_width - 3 && y > corner.y + 3 &&
                          y < corner.y + panel_height - 3;
      if (inside) dots.dot({x, y});
    }
    svg.path(dots, "stroke=\"#c1440e\" stroke-width=\"3\" stroke-linecap=\"round\" fill=\"none\"");
    svg.text({corner.x + panel_width - 10, corner.y + panel_height - 12},
             fmt::format("{:.1f}°", picture.angle), "end", label);
    if (!is_named) svg.text({left - 8, tip.y + 4}, rows[row], "end", label);
    is_named = true;
  }
  return svg;
}

Svg draw_kinks(const std::vector<Kink>& kinks) {
  constexpr double size = 260.0;
  Svg svg(4 * (size + 70) + 35, size + 130);
  const std::array<std::string, 3> names = {"rectangular", "hexagonal", "cloud 5"};
  const std::array<const char*, 3> colors = {"#2f5d9b", "#c1440e", "#3d7d3a"};
  for (int k = 0; k < 4; ++k) {
    const double x0 = 75 + k * (size + 70);
    const Axis x{0.0, 95.0, x0, x0 + size}, y{0.0, 90.0, size + 40, 40};
    draw_axes(svg, x, y, "atan(K_II / K_I) (degrees)", k == 0 ? "kink (degrees)" : "", Grid::lines);
    svg.text({x0 + 0.5 * size, 25}, columns[k], "middle", label);
    SvgPath curve;
    for (int degrees = 0; degrees <= 90; ++degrees) {
      const double to = 180.0 / std::numbers::pi;
      const SvgPoint at = {x.map(degrees), y.map(-hoop_stress_kink(degrees / to) * to)};
      if (degrees == 0) {
        curve.move_to(at);
      } else {
        curve.line_to(at);
      }
    }
    svg.path(curve, "fill=\"none\" stroke=\"#333\" stroke-width=\"1.5\"");
    for (const Kink& kink : kinks) {
      if (column_of(kink.make) != k || !std::isfinite(kink.angle)) continue;
      for (std::size_t n = 0; n < names.size(); ++n) {
        if (name_of(kink.make.arrangement) != names[n]) continue;
        svg.circle({x.map(kink.mixity + static_cast<double>(n) - 1.0), y.map(-kink.angle)}, 4,
                   fmt::format("fill=\"{}\"", colors[n]));
      }
    }
  }
  for (std::size_t n = 0; n < names.size(); ++n) {
    const double x0 = 75 + 170 * static_cast<double>(n);
    svg.circle({x0, size + 110}, 4, fmt::format("fill=\"{}\"", colors[n]));
    svg.text({x0 + 10, size + 114}, n == 2 ? "cloud" : names[n], "start", label);
  }
  svg.text({600, size + 114}, "line: largest hoop stress", "start", label);
  return svg;
}

}  // namespace perilink::verification

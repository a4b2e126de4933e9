#include "app/plot/plot_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>

namespace perilink {
namespace {

constexpr double legend_gap = 24.0;     ///< between frame and legend
constexpr double row_of_legend = 22.0;  ///< distance of lines of the legend
constexpr double letter_width = 7.0;    ///< approximate width of a letter in the legend

/// Colours for colour-blind readers (Okabe & Ito 2008), without yellow, which is too pale.
constexpr std::array<const char*, 7> line_colors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                    "#56b4e9", "#e69f00", "#000000"};

std::string color_of_line(std::size_t line) { return line_colors[line % line_colors.size()]; }

/// Returns the stroke of a line; lines beyond the number of colours are dashed.
std::string stroke_of(std::size_t line, bool filled) {
  const std::string fill =
      filled ? color_of_line(line) + "\" fill-opacity=\"0.25" : std::string("none");
  return fmt::format("fill=\"{}\" stroke=\"{}\" stroke-width=\"1.8\"{}", fill, color_of_line(line),
                     line / line_colors.size() % 2 == 1 ? " stroke-dasharray=\"6 4\"" : "");
}

void draw_mark(Svg& svg, std::size_t line, SvgPoint at) {
  const std::string fill = fmt::format("fill=\"{}\"", color_of_line(line));
  const auto polygon = [&](std::initializer_list<SvgPoint> offsets) {
    SvgPath path;
    for (const SvgPoint offset : offsets) {
      const SvgPoint corner{at.x + offset.x, at.y + offset.y};
      path.empty() ? path.move_to(corner) : path.line_to(corner);
    }
    svg.path(path, fill);
  };
  switch (line % 4) {
    case 0: svg.circle(at, 4.0, fill); break;
    case 1: polygon({{-3.6, -3.6}, {3.6, -3.6}, {3.6, 3.6}, {-3.6, 3.6}}); break;
    case 2: polygon({{0.0, -4.8}, {4.4, 3.4}, {-4.4, 3.4}}); break;
    default: polygon({{0.0, -5.0}, {5.0, 0.0}, {0.0, 5.0}, {-5.0, 0.0}});
  }
}

}  // namespace

SvgPoint room_of_lines(std::span<const MarkedLine> lines) {
  std::size_t longest = 0;
  for (const MarkedLine& line : lines) longest = std::max(longest, line.name.size());
  return {legend_gap + 48.0 + letter_width * static_cast<double>(longest),
          row_of_legend * static_cast<double>(lines.size()) + 20.0};
}

void draw_marked_lines(Svg& svg, std::span<const MarkedLine> lines, SvgPoint corner) {
  for (std::size_t k = 0; k < lines.size(); ++k) {
    SvgPath path;
    for (const SvgPoint point : lines[k].points) {
      path.empty() ? path.move_to(point) : path.line_to(point);
    }
    svg.path(path, stroke_of(k, lines[k].filled));
    if (lines[k].filled) continue;
    for (const SvgPoint point : lines[k].points) draw_mark(svg, k, point);
  }
  const double left = corner.x + legend_gap;
  double y = corner.y + 10.0;
  for (std::size_t k = 0; k < lines.size(); ++k, y += row_of_legend) {
    SvgPath sample;
    sample.move_to({left, y});
    sample.line_to({left + 28, y});
    svg.path(sample, stroke_of(k, false));
    if (!lines[k].filled) draw_mark(svg, k, {left + 14, y});
    svg.text({left + 36, y + 4.5}, lines[k].name, "start", "font-size=\"13\" fill=\"#333\"");
  }
}

}  // namespace perilink

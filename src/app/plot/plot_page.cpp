#include "app/plot/plot_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/plot/color_map.hpp"
#include "app/plot/plot_axes.hpp"

namespace perilink {
namespace {

constexpr double left_margin = 92.0;
constexpr double right_margin = 104.0;
constexpr double top_margin = 82.0;
constexpr double bottom_margin = 96.0;
constexpr double largest_width = 760.0;
constexpr double largest_height = 640.0;
constexpr double smallest_width = 420.0;
constexpr const char* small_style = "font-size=\"13\" fill=\"#444\"";

void draw_headings(Svg& svg, const BodyPage& page, const std::string& title,
                   const std::string& caption) {
  // Letters are about 0.56 of their size wide.
  const auto fitting = [&](const std::string& text, double size) {
    const double room = page.width - left_margin - 20.0;
    return std::min(size,
                    room / (0.56 * static_cast<double>(std::max<std::size_t>(text.size(), 1))));
  };
  svg.text(
      {left_margin, 32}, title, "start",
      fmt::format("font-size=\"{:.1f}\" font-weight=\"bold\" fill=\"#222\"", fitting(title, 18.0)));
  svg.text({left_margin, 54}, caption, "start",
           fmt::format("font-size=\"{:.1f}\" fill=\"#444\"", fitting(caption, 13.5)));
}

void draw_color_bar(Svg& svg, const BodyPage& page, const ColorBar& colors) {
  constexpr int steps = 50;
  const double height = std::clamp(page.bottom - page.top, 120.0, 260.0);
  const double x = page.right + 24.0;
  const double y = page.top + std::max(0.0, (page.bottom - page.top - height) / 2);
  for (int k = 0; k < steps; ++k) {
    const double step = height / steps;
    // Half a pixel of overlap, or viewers show hairlines between the shades.
    svg.rect({x, y + height - (k + 1) * step}, 14.0, step + (k > 0 ? 0.5 : 0.0),
             fmt::format("fill=\"{}\"", damage_color((k + 0.5) / steps)));
  }
  svg.rect({x, y}, 14.0, height, "fill=\"none\" stroke=\"#444\" stroke-width=\"0.8\"");
  const Ticks ticks = nice_ticks(colors.low, colors.high, height > 160.0 ? 6 : 3);
  const int exponent = common_exponent(colors.low, colors.high);
  for (const double value : ticks.values) {
    const double at = y + height * (colors.high - value) / (colors.high - colors.low);
    svg.line({x + 14, at}, {x + 18, at}, "stroke=\"#444\"");
    svg.text({x + 22, at + 4.5}, tick_label(value, ticks.step, exponent), "start", small_style);
  }
  svg.text({x, y - 8}, exponent_text(exponent), "start", small_style);
  const SvgPoint label{x + 62.0, y + height / 2};
  svg.open_group(fmt::format("transform=\"rotate(-90 {:.1f} {:.1f})\"", label.x, label.y));
  svg.text(label, colors.label, "middle", "font-size=\"14\" fill=\"#222\"");
  svg.close_group();
}

void draw_scale_bar(Svg& svg, const BodyPage& page, const std::string& length_unit) {
  const double length = round_down_to_nice(0.22 * (page.right - page.left) / page.pixels);
  const double y = page.height - 22.0;
  const double end = page.left + length * page.pixels;
  constexpr const char* style = "stroke=\"#222\" stroke-width=\"2\"";
  svg.line({page.left, y}, {end, y}, style);
  svg.line({page.left, y - 4}, {page.left, y + 4}, style);
  svg.line({end, y - 4}, {end, y + 4}, style);
  svg.text({end + 10, y + 4.5}, in_unit(short_number(length), length_unit), "start", small_style);
}

/// Width of a letter of the key, also in wide fonts.
constexpr double letter = 7.6;

/// Draws the key from the right end of the line with the scale bar, with further entries above it.
void draw_key(Svg& svg, const BodyPage& page, const std::vector<KeyEntry>& key) {
  const double first = page.width - 20.0;
  double x = first, y = page.height - 22.0;
  double least = page.left + 0.22 * (page.right - page.left) + 70.0;  // right end of the scale bar
  const auto width_of = [](const std::string& name) {
    return letter * static_cast<double>(name.size());
  };
  for (auto entry = key.rbegin(); entry != key.rend(); ++entry) {
    if (x < first && x - width_of(entry->name) - 32.0 < least) {
      x = first;
      y -= 17.0;
      least = 0.0;
    }
    svg.text({x, y + 4.5}, entry->name, "end", small_style);
    x -= width_of(entry->name) + 10.0;
    SvgPath sample;
    if (entry->dot) {
      sample.dot({x, y});
    } else {
      sample.move_to({x - 22, y});
      sample.line_to({x, y});
    }
    svg.path(sample, entry->style);
    x -= 44.0;
  }
}

/// Draws the directions of the axes in space, in the upper right corner.
void draw_triad(Svg& svg, const BodyPage& page) {
  constexpr double length = 30.0, beyond = 1.36;  // position of the letter's centre
  const SvgPoint origin{page.width - 64.0, 48.0};
  const auto end = [&](int axis, double part) {
    Vector3 unit{};
    unit[axis] = part * length;
    const Vector3 seen = view(unit, 3);
    return SvgPoint{origin.x + seen[0], origin.y - seen[1]};
  };
  constexpr std::array<const char*, 3> names = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    svg.line(origin, end(axis, 1.0),
             "stroke=\"#444\" stroke-width=\"1.6\" stroke-linecap=\"round\"");
    const SvgPoint letter_at = end(axis, beyond);
    svg.text({letter_at.x, letter_at.y + 4.5}, names[axis], "middle", small_style);
  }
  svg.circle(origin, 2.2, "fill=\"#444\"");
}

}  // namespace

BodyPage make_page(const PlotBody& body, const std::vector<Vector3>& seen) {
  double low[2] = {infinity, infinity};
  double high[2] = {-infinity, -infinity};
  for (Index i = 0; i < body.size(); ++i) {
    if (body.is_loose(i)) continue;
    for (std::size_t c = 0; c < 2; ++c) {
      low[c] = std::min(low[c], seen[i][c]);
      high[c] = std::max(high[c], seen[i][c]);
    }
  }
  if (!(high[0] >= low[0])) low[0] = low[1] = high[0] = high[1] = 0.0;  // no point is drawn
  const double margin = std::max(body.spacing, 0.02 * std::max(high[0] - low[0], high[1] - low[1]));
  for (std::size_t c = 0; c < 2; ++c) {
    low[c] -= margin;
    high[c] += margin;
  }
  BodyPage page;
  page.low = {low[0], low[1], 0.0};
  page.pixels = std::min(largest_width / (high[0] - low[0]), largest_height / (high[1] - low[1]));
  page.left = left_margin;
  page.right = left_margin + (high[0] - low[0]) * page.pixels;
  page.top = top_margin;
  page.bottom = top_margin + (high[1] - low[1]) * page.pixels;
  if (page.right - page.left < smallest_width) {  // a narrow body is centred on its page
    const double shift = (smallest_width - (page.right - page.left)) / 2;
    page.low[0] -= shift / page.pixels;
    page.right = page.left + smallest_width;
  }
  page.width = page.right + right_margin;
  page.height = page.bottom + bottom_margin;
  return page;
}

void draw_page(Svg& svg, const BodyPage& page, int dim, const PlotLabels& labels,
               const std::string& caption, const ColorBar& colors,
               const std::vector<KeyEntry>& key) {
  draw_headings(svg, page, labels.title, caption);
  if (dim == 2) {
    const double wide = (page.right - page.left) / page.pixels;
    const double tall = (page.bottom - page.top) / page.pixels;
    draw_axes(svg, {page.low[0], page.low[0] + wide, page.left, page.right},
              {page.low[1], page.low[1] + tall, page.bottom, page.top},
              with_unit("x", labels.length), with_unit("y", labels.length), Grid::none);
  }
  if (dim == 3) draw_triad(svg, page);
  draw_color_bar(svg, page, colors);
  draw_scale_bar(svg, page, labels.length);
  draw_key(svg, page, key);
}

}  // namespace perilink

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
constexpr double right_margin = 112.0;
constexpr double top_margin = 82.0;
constexpr double bottom_margin = 96.0;
constexpr double largest_width = 760.0;
constexpr double largest_height = 640.0;
constexpr double smallest_width = 420.0;
/// Width of a small letter, also in wide fonts.
constexpr double letter = 7.6;
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
  std::size_t longest = 0;
  for (const double value : ticks.values) {
    const double at = y + height * (colors.high - value) / (colors.high - colors.low);
    const std::string text = tick_label(value, ticks.step, exponent);
    svg.line({x + 14, at}, {x + 18, at}, "stroke=\"#444\"");
    svg.text({x + 22, at + 4.5}, text, "start", small_style);
    longest =
        std::max(longest, text.size() - (value < 0.0 ? 2 : 0));  // a minus sign has three bytes
  }
  svg.text({x, y - 8}, exponent_text(exponent), "start", small_style);
  const SvgPoint label{x + std::clamp(36.0 + letter * static_cast<double>(longest), 62.0, 84.0),
                       y + height / 2};
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

namespace {

constexpr const char* held_color = "#00875a";
constexpr const char* force_color = "#0b62c4";
constexpr const char* move_color = "#c2410c";

std::string line_style(const char* color, double width) {
  return fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"{:.1f}\" stroke-linecap=\"round\"",
                     color, width);
}

/// Adds an arrow along a direction of the page. It ends at the point if it points to the middle of
/// the body, else it begins there.
void add_arrow(SvgPath& path, SvgPoint at, SvgPoint along, SvgPoint middle, double length) {
  const double size = std::hypot(along.x, along.y);
  const SvgPoint unit{along.x / size, along.y / size};
  const bool inwards = unit.x * (middle.x - at.x) + unit.y * (middle.y - at.y) > 0.0;
  const double begin = inwards ? -length : 0.0;
  const SvgPoint tail{at.x + begin * unit.x, at.y + begin * unit.y};
  const SvgPoint tip{tail.x + length * unit.x, tail.y + length * unit.y};
  path.move_to(tail);
  path.line_to(tip);
  for (const double side : {-1.0, 1.0}) {
    const double back = 0.3 * length, across = 0.18 * length * side;
    path.move_to(
        {tip.x - back * unit.x - across * unit.y, tip.y - back * unit.y + across * unit.x});
    path.line_to(tip);
  }
}

/// Returns the particles at which arrows are drawn, at most 60, at some distance from each other.
/// \param apart  smallest distance [px]
std::vector<Index> arrow_places(const std::vector<Vector3>& vectors, const BodyPage& page,
                                const std::vector<Vector3>& seen,
                                const std::vector<std::uint8_t>& visible, double apart) {
  constexpr std::size_t most = 60;
  std::vector<Index> places;
  for (Index i = 0; i < static_cast<Index>(vectors.size()) && places.size() < most; ++i) {
    const Vector3& v = vectors[i];
    if (visible[i] == 0 || (v[0] == 0.0 && v[1] == 0.0 && v[2] == 0.0)) continue;
    const SvgPoint at = page.at(seen[i]);
    const bool is_free = std::ranges::none_of(places, [&](Index j) {
      const SvgPoint other = page.at(seen[j]);
      return std::hypot(at.x - other.x, at.y - other.y) < apart;
    });
    if (is_free) places.push_back(i);
  }
  return places;
}

/// Length of an arrow over the larger side of the body.
constexpr double arrow_length = 0.055;

}  // namespace

std::vector<KeyEntry> draw_conditions(Svg& svg, const BodyPage& page, const PlotBody& body,
                                      const std::vector<Vector3>& seen,
                                      const std::vector<std::uint8_t>& visible) {
  std::vector<KeyEntry> key;
  const auto draw = [&](const SvgPath& path, const char* name, const char* color, double width) {
    if (path.empty()) return;
    svg.path(path, line_style(color, width));
    key.push_back({name, line_style(color, width)});
  };
  const double half = std::clamp(0.32 * body.spacing * page.pixels, 1.2, 7.0);
  SvgPath held;
  for (Index i = 0; i < static_cast<Index>(body.held.size()); ++i) {
    if (visible[i] == 0) continue;
    for (int axis = 0; axis < body.dim; ++axis) {
      if ((body.held[i] & (1 << axis)) == 0) continue;
      Vector3 unit{};
      unit[static_cast<std::size_t>(axis)] = half;
      const Vector3 line = view(unit, body.dim);
      const SvgPoint at = page.at(seen[i]);
      held.move_to({at.x - line[0], at.y + line[1]});
      held.line_to({at.x + line[0], at.y - line[1]});
    }
  }
  draw(held, "held", held_color, std::clamp(0.5 * half, 0.6, 1.4));
  const SvgPoint middle{0.5 * (page.left + page.right), 0.5 * (page.top + page.bottom)};
  const double length = arrow_length * std::max(page.right - page.left, page.bottom - page.top);
  const auto draw_arrows = [&](const std::vector<Vector3>& vectors, const char* name,
                               const char* color) {
    SvgPath arrows;
    for (const Index i : arrow_places(vectors, page, seen, visible, 0.4 * length)) {
      const Vector3 along = view(vectors[i], body.dim);
      if (along[0] == 0.0 && along[1] == 0.0) continue;
      add_arrow(arrows, page.at(seen[i]), {along[0], -along[1]}, middle, length);
    }
    draw(arrows, name, color, 1.6);
  };
  draw_arrows(body.forces, "load", force_color);
  draw_arrows(body.moves, "prescribed displacement", move_color);
  return key;
}

void ViewBox::add(const ViewBox& other) {
  for (std::size_t c = 0; c < 2; ++c) {
    low[c] = std::min(low[c], other.low[c]);
    high[c] = std::max(high[c], other.high[c]);
  }
}

ViewBox view_of(const PlotBody& body, const std::vector<Vector3>& seen) {
  ViewBox box;
  for (Index i = 0; i < body.size(); ++i) {
    if (!body.is_loose(i)) box.add({{seen[i][0], seen[i][1]}, {seen[i][0], seen[i][1]}});
  }
  if (!(box.high[0] >= box.low[0])) box = {{0.0, 0.0}, {0.0, 0.0}};  // no point is drawn
  const bool has_arrows = !body.forces.empty() || !body.moves.empty();
  const double margin =
      std::max(body.spacing, (has_arrows ? 1.3 * arrow_length : 0.02) *
                                 std::max(box.high[0] - box.low[0], box.high[1] - box.low[1]));
  for (std::size_t c = 0; c < 2; ++c) {
    box.low[c] -= margin;
    box.high[c] += margin;
  }
  return box;
}

BodyPage make_page(const ViewBox& box) {
  const auto& [low, high] = box;
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

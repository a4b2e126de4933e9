#include "app/plot/plot_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>
#include <vector>

#include "app/plot/color_map.hpp"
#include "app/plot/plot_axes.hpp"
#include "app/plot/plot_page.hpp"
#include "base/plain_text.hpp"

namespace perilink {
namespace {

constexpr int shades = 40;
constexpr const char* ghost_style =
    "stroke=\"#9aa3ad\" stroke-linecap=\"round\" fill=\"none\" stroke-opacity=\"0.7\"";
constexpr const char* element_style = "stroke=\"#7d8894\" stroke-width=\"0.8\"";

std::string stroke_width(double pixels) { return fmt::format("stroke-width=\"{:.2f}\"", pixels); }

/// Data shared by the parts of the picture.
struct Scene {
  const PlotBody& body;
  const std::vector<Vector3>& seen;  ///< deformed, projected
  const BodyPage& page;
  const ParticleColors& colors;
  bool square = false;  ///< square lattice in the plane

  double spacing_px() const { return body.spacing * page.pixels; }
  double size_px(Index i) const { return body.sizes[i] * page.pixels; }
  SvgPoint at(Index i) const { return page.at(seen[i]); }
  /// Returns the shade of a particle; 0 is undamaged.
  int shade(Index i) const {
    const double value = colors.values[i];
    if (colors.grey_zero && !(value > 0.0)) return 0;
    const double part =
        std::clamp((value - colors.bar.low) / (colors.bar.high - colors.bar.low), 0.0, 1.0);
    return 1 + std::clamp(static_cast<int>(part * shades), 0, shades - 1);
  }
};

std::string shade_color(int shade) {
  return shade == 0 ? undamaged_color : damage_color((shade - 0.5) / shades);
}

/// Draws particles of a square lattice as cells, one path per shade. Small cells overlap slightly,
/// to avoid a moiré pattern of the page.
void draw_squares(Svg& svg, const Scene& scene) {
  const double size = scene.spacing_px() * (scene.spacing_px() < 7.0 ? 1.1 : 0.94);
  std::map<int, SvgPath> cells;  // light ones first, so that the damaged ones stay visible
  for (Index i = 0; i < scene.body.size(); ++i) {
    if (scene.body.kind[i] == 0) cells[scene.shade(i)].square(scene.at(i), size);
  }
  svg.open_group("stroke=\"none\"");
  for (const auto& [shade, path] : cells) {
    svg.path(path, fmt::format("fill=\"{}\"", shade_color(shade)));
  }
  svg.close_group();
}

/// Draws particles off a square lattice as dots, by the round caps of strokes. Widths follow
/// particle sizes in steps of a quarter of a pixel.
void draw_dots(Svg& svg, const Scene& scene) {
  constexpr double step = 0.25;
  std::map<std::pair<int, long>, SvgPath> dots;
  for (Index i = 0; i < scene.body.size(); ++i) {
    if (scene.body.kind[i] != 0) continue;
    const double size = scene.size_px(i) * (scene.size_px(i) < 7.0 ? 1.18 : 1.0);
    const long steps = std::max(1L, std::lround(size / step));
    dots[{scene.shade(i), steps}].dot(scene.at(i));
  }
  svg.open_group("fill=\"none\" stroke-linecap=\"round\"");
  for (const auto& [look, path] : dots) {
    svg.path(path, fmt::format("stroke=\"{}\" {}", shade_color(look.first),
                               stroke_width(step * static_cast<double>(look.second))));
  }
  svg.close_group();
}

/// Returns per particle whether it is solid and, in space, not hidden by others.
/// \param reach  others hide it up to this number of half spacings beside it
std::vector<std::uint8_t> visible_particles(const Scene& scene, long reach) {
  constexpr long next_row = 1000003;
  std::vector<std::uint8_t> visible(scene.seen.size(), 0);
  const double pixel = 0.5 * scene.spacing_px();
  const auto place = [&](Index i) {
    const SvgPoint at = scene.at(i);
    return static_cast<long>(at.x / pixel) * next_row + static_cast<long>(at.y / pixel);
  };
  for (Index i = 0; i < scene.body.size(); ++i) visible[i] = scene.body.kind[i] == 0 ? 1 : 0;
  if (scene.body.dim == 2) return visible;
  std::unordered_map<long, double> front;
  for (Index i = 0; i < scene.body.size(); ++i) {
    if (visible[i] == 0) continue;
    double& depth = front.try_emplace(place(i), scene.seen[i][2]).first->second;
    depth = std::max(depth, scene.seen[i][2]);
  }
  for (Index i = 0; i < scene.body.size(); ++i) {
    for (long k = -reach; k <= reach && visible[i] != 0; ++k) {
      for (long j = -reach; j <= reach; ++j) {
        const auto other = front.find(place(i) + k * next_row + j);
        const bool hides =
            other != front.end() && scene.seen[i][2] < other->second - 1.5 * scene.body.spacing;
        if (hides) visible[i] = 0;
      }
    }
  }
  return visible;
}

/// Draws particles in space as balls, from back to front, without hidden ones.
void draw_balls(Svg& svg, const Scene& scene) {
  const std::vector<std::uint8_t> visible = visible_particles(scene, 0);
  std::vector<Index> order;
  for (Index i = 0; i < scene.body.size(); ++i) {
    if (visible[i] != 0) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return scene.seen[a][2] < scene.seen[b][2]; });
  // Surface particles of meshes have half a cell or less.
  const double wide = on_square_lattice(scene.body) ? 1.1 : 1.4;
  svg.open_group("fill=\"none\" stroke-linecap=\"round\"");
  for (const Index i : order) {
    const double size = wide * scene.size_px(i);
    SvgPath dot;
    dot.dot(scene.at(i));
    svg.path(dot, fmt::format("stroke=\"#6b7076\" {}", stroke_width(size)));
    svg.path(dot, fmt::format("stroke=\"{}\" {}", shade_color(scene.shade(i)),
                              stroke_width(0.86 * size)));
  }
  svg.close_group();
}

/// Number of shades of crack faces, from closed to the widest opening.
constexpr int opening_steps = 6;

std::string face_style(int step, double width) {
  const double part = static_cast<double>(step) / opening_steps;
  const auto mixed = [&](int from, int to) { return std::lround(from + part * (to - from)); };
  return fmt::format("fill=\"none\" stroke=\"#{:02x}{:02x}{:02x}\" stroke-linecap=\"round\" {}",
                     mixed(0x5a, 0x12), mixed(0x0a, 0x8c), mixed(0x12, 0xff),
                     stroke_width(width * (1.0 + part)));
}

/// Returns the largest opening of a broken bond; zero where the file has no openings.
double largest_opening(const PlotBody& body) {
  double largest = 0.0;
  for (const double opening : body.openings) largest = std::max(largest, opening);
  return largest;
}

/// Draws crack faces. A broken bond between nearest neighbours is drawn on both sides as the face
/// between their cells: closed cracks become one line, open ones two. Longer bonds would hide the
/// crack.
void draw_crack_faces(Svg& svg, const Scene& scene) {
  const double nearest = scene.square ? 1.2 : 1.5;  // surface particles have sizes of half cells
  const double widest = largest_opening(scene.body);
  std::map<int, SvgPath> paths;
  for (std::size_t k = 0; k < scene.body.broken_bonds.size(); ++k) {
    const auto [i, j] = scene.body.broken_bonds[k];
    const Vector3& from = scene.body.positions[i];
    const Vector3& to = scene.body.positions[j];
    const double dx = to[0] - from[0];
    const double dy = to[1] - from[1];
    const double length = std::hypot(dx, dy);
    const double size = std::max(scene.body.sizes[i], scene.body.sizes[j]);
    if (!(length > 0.0) || length > nearest * size) continue;
    const int step =
        widest > 0.0
            ? static_cast<int>(std::lround(opening_steps * scene.body.openings[k] / widest))
            : 0;
    SvgPath& path = paths[step];
    const double face = (scene.square ? 1.0 : 0.62) * size * scene.page.pixels;
    const SvgPoint half_face{0.5 * face * dy / length, 0.5 * face * dx / length};
    for (const auto& [end, side] : {std::pair{i, 0.5}, std::pair{j, -0.5}}) {
      if (scene.body.is_loose(end)) continue;
      const SvgPoint at = scene.at(end);
      const SvgPoint middle{at.x + side * dx * scene.page.pixels,
                            at.y - side * dy * scene.page.pixels};
      path.move_to({middle.x - half_face.x, middle.y - half_face.y});
      path.line_to({middle.x + half_face.x, middle.y + half_face.y});
    }
  }
  const double width = std::clamp(0.12 * scene.spacing_px(), 0.7, 2.2);
  for (const auto& [step, path] : paths) svg.path(path, face_style(step, width));
}

/// Returns the elongation of the line between two particles on the page, in spacings.
double drawn_opening(const Scene& scene, const Ends& ends) {
  const auto [i, j] = ends;
  const Vector3 a = view(scene.body.positions[i], scene.body.dim);
  const Vector3 b = view(scene.body.positions[j], scene.body.dim);
  const double before = std::hypot(b[0] - a[0], b[1] - a[1]);
  const double after =
      std::hypot(scene.seen[j][0] - scene.seen[i][0], scene.seen[j][1] - scene.seen[i][1]);
  return (after - before) / scene.body.spacing;
}

/// Draws broken bonds as hairlines, fainter the more there are. On coarse lattices they show long
/// bonds that broke first. Bonds across a visible gap are not drawn.
void draw_bond_hairlines(Svg& svg, const Scene& scene, std::vector<KeyEntry>& key) {
  constexpr std::size_t too_many = 2000;
  constexpr double visible_gap = 0.5;
  const std::size_t count = scene.body.broken_bonds.size();
  if (count > too_many) return;
  SvgPath path;
  for (std::size_t k = 0; k < count; ++k) {
    const Ends& ends = scene.body.broken_bonds[k];
    if (scene.body.is_loose(ends.first) || scene.body.is_loose(ends.second)) continue;
    if (drawn_opening(scene, ends) > visible_gap) continue;
    path.move_to(scene.at(ends.first));
    path.line_to(scene.at(ends.second));
  }
  const double opacity = std::clamp(60.0 / static_cast<double>(count + 1), 0.15, 0.6);
  if (path.empty()) return;
  const std::string style = fmt::format(
      "fill=\"none\" stroke=\"#8b1020\" stroke-opacity=\"{:.2f}\" {}", opacity, stroke_width(0.8));
  svg.path(path, style);
  key.push_back({"broken bond", style});
}

/// Draws finite elements over the particles that they constrain, unless intact particles have
/// colours.
void draw_elements(Svg& svg, const Scene& scene) {
  SvgPath path;
  for (Index e = 0; e < scene.body.elements.rows(); ++e) {
    const auto corners = scene.body.elements.row(e);
    path.move_to(scene.at(corners.back()));
    for (const Index i : corners) path.line_to(scene.at(i));
  }
  const char* fill = scene.colors.grey_zero ? undamaged_color : "none";
  svg.path(path, fmt::format("fill=\"{}\" {}", fill, element_style));
}

std::string bar_width(const Scene& scene) {
  return stroke_width(std::clamp(0.35 * scene.spacing_px(), 2.0, 5.0));
}

/// Draws bars coloured by stress where the file has it: grey to red in tension, to blue in
/// compression.
/// \param labels  for the unit of stress
void draw_bars(Svg& svg, const Scene& scene, const PlotLabels& labels, std::vector<KeyEntry>& key) {
  if (scene.body.segments.empty()) return;
  const std::vector<double>& stress = scene.body.bar_stress;
  constexpr int steps = 8;  // on either side of zero
  double most = 0.0, least = 0.0;
  for (const double value : stress) {
    most = std::max(most, value);
    least = std::min(least, value);
  }
  const double largest = std::max(most, -least);
  std::map<int, SvgPath> paths;
  for (std::size_t k = 0; k < scene.body.segments.size(); ++k) {
    const int shade = stress.empty() || !(largest > 0.0)
                          ? 0
                          : static_cast<int>(std::lround(steps * stress[k] / largest));
    paths[shade].move_to(scene.at(scene.body.segments[k].first));
    paths[shade].line_to(scene.at(scene.body.segments[k].second));
  }
  const auto style = [&](int shade) {
    const double part = std::abs(shade) / static_cast<double>(steps);
    const auto mixed = [&](int to) { return std::lround(90 + part * (to - 90)); };
    const std::array<int, 3> color = shade > 0 ? std::array{214, 20, 20} : std::array{20, 60, 214};
    return fmt::format("fill=\"none\" stroke-linecap=\"round\" stroke=\"#{:02x}{:02x}{:02x}\" {}",
                       mixed(color[0]), mixed(color[1]), mixed(color[2]), bar_width(scene));
  };
  for (const auto& [shade, path] : paths) svg.path(path, style(shade));
  if (!(largest > 0.0)) {
    key.push_back({"reinforcing bar", style(0)});
    return;
  }
  const auto name = [&](double value) {
    return "bar, stress to " + in_unit(short_number(value), labels.stress());
  };
  if (most > 0.0) key.push_back({name(most), style(steps)});
  if (least < 0.0) key.push_back({name(least), style(-steps)});
}

std::vector<KeyEntry> draw_body(Svg& svg, const Scene& scene, const PlotLabels& labels) {
  std::vector<KeyEntry> key;
  SvgPath ghosts;
  for (Index i = 0; i < scene.body.size(); ++i) {
    if (scene.body.kind[i] == 1) ghosts.dot(scene.at(i));
  }
  if (scene.body.dim == 3) {
    draw_balls(svg, scene);
    // In solid bodies bonds of the far side would be visible.
    if (scene.body.is_mid_surface) draw_bond_hairlines(svg, scene, key);
  } else {
    if (scene.square) {
      draw_squares(svg, scene);
    } else {
      draw_dots(svg, scene);
    }
    draw_elements(svg, scene);
    if (scene.body.elements.rows() > 0) key.push_back({"finite element", element_style});
    draw_bond_hairlines(svg, scene, key);
    draw_crack_faces(svg, scene);
    const double widest = largest_opening(scene.body);
    if (!scene.body.broken_bonds.empty()) {
      key.push_back({widest > 0.0 ? "crack face: closed" : "crack face", face_style(0, 2.0)});
    }
    if (widest > 0.0) {
      key.push_back(
          {fmt::format("open by {} (largest)", in_unit(short_number(widest), labels.length)),
           face_style(opening_steps, 2.0)});
    }
  }
  draw_bars(svg, scene, labels, key);
  if (!ghosts.empty()) {
    const std::string style = std::string(ghost_style) + " " +
                              stroke_width(std::clamp(0.22 * scene.spacing_px(), 1.0, 5.0));
    svg.path(ghosts, style);
    key.push_back({"ghost", style, true});
  }
  return key;
}

/// Returns the deformed positions as seen on the page.
std::vector<Vector3> seen_positions(const PlotBody& body, double scale) {
  std::vector<Vector3> seen = deformed_positions(body, scale);
  for (Vector3& point : seen) point = view(point, body.dim);
  return seen;
}

std::string caption_text(const FieldsCaption& caption, const PlotBody& body,
                         const PlotLabels& labels, double scale) {
  std::string begin;
  if (caption.time) {
    begin = fmt::format("time {} · ", short_number(*caption.time));
  } else if (body.stress.empty()) {
    begin = counted(caption.broken_bonds, "broken bond") + " · ";
  }
  return fmt::format("{}load factor {} · load {} · displacements × {}", begin,
                     short_number(caption.load_factor),
                     in_unit(short_number(caption.load), labels.force), short_number(scale));
}

}  // namespace

ParticleColors usual_colors(const PlotBody& body, const PlotLabels& labels) {
  if (body.stress.empty()) return {body.damage, {}, true};
  ParticleColors colors{body.stress, {}, false};
  colors.bar.label = body.is_mid_surface ? with_unit("displacement", labels.length)
                                         : with_unit("von Mises stress", labels.stress());
  const double largest = *std::max_element(body.stress.begin(), body.stress.end());
  if (largest > 0.0) colors.bar.high = largest;
  return colors;
}

ViewBox view_of_body(const PlotBody& body, double scale) {
  return view_of(body, seen_positions(body, scale));
}

Svg draw_fields(const PlotBody& body, const FieldsCaption& caption, const PlotLabels& labels,
                double scale, const std::optional<ParticleColors>& chosen,
                const std::optional<ViewBox>& box) {
  if (!(scale > 0.0)) scale = automatic_scale(body);
  const std::vector<Vector3> seen = seen_positions(body, scale);
  const BodyPage page = make_page(box ? *box : view_of(body, seen));
  const ParticleColors colors = chosen ? *chosen : usual_colors(body, labels);
  const Scene scene{body, seen, page, colors, body.dim == 2 && on_square_lattice(body)};

  Svg svg(page.width, page.height);
  svg.clip_rect("body", {page.left, page.top}, page.right - page.left, page.bottom - page.top);
  svg.open_group("clip-path=\"url(#body)\"");
  std::vector<KeyEntry> key = draw_body(svg, scene, labels);
  const std::vector<KeyEntry> conditions =
      draw_conditions(svg, page, body, seen, visible_particles(scene, 1));
  svg.close_group();
  key.insert(key.end(), conditions.begin(), conditions.end());
  draw_page(svg, page, body.dim, labels, caption_text(caption, body, labels, scale), colors.bar,
            key);
  return svg;
}

}  // namespace perilink

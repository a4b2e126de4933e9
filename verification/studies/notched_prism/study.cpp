#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "../../problems/program.hpp"
#include "app/plot/color_map.hpp"
#include "app/plot/plot_axes.hpp"
#include "app/plot/svg.hpp"
#include "io/fields/vtu.hpp"

/// \file
/// Draws the crack of a run of prism.toml as it lies in its plane.

namespace perilink::verification {
namespace {

/// The notch, from which the crack runs up, and how far to its sides bonds belong to it [mm].
constexpr double notch_plane = 1.5625, horizon = 6.25, height = 100.0, thickness = 12.5;
constexpr double spacing = 3.125;
/// Opening of the darkest colour [mm].
constexpr double largest_opening = 0.02;
constexpr double scale = 4.0, gap = 90.0;  ///< pixels per mm, and between panels
constexpr const char* text_style = "font-family=\"sans-serif\" font-size=\"13\" fill=\"#333\"";

const std::vector<double>& field_of(const VtuGrid& grid, const std::string& name) {
  const auto found = std::ranges::find(grid.point_data, name, &VtuArray::name);
  if (found == grid.point_data.end()) throw std::runtime_error("there is no field " + name);
  return found->values;
}

/// What is seen along the prism: the largest opening at each place of the section.
using Surface = std::map<std::pair<long, long>, double>;

struct Picture {
  Surface surface;
  double load_factor = 0.0;
  double far = 0.0;  ///< largest opening farther than a horizon from the plane of the notch [mm]
};

Picture picture_of(const VtuGrid& grid) {
  Picture picture;
  for (const auto& [name, value] : grid.field_data) {
    if (name == "load_factor") picture.load_factor = value;
  }
  const std::vector<double>& opening = field_of(grid, "crack_opening");
  for (std::size_t p = 0; p < opening.size(); ++p) {
    const double* at = grid.points.data() + 3 * p;
    if (std::abs(at[0] - notch_plane) > horizon) {
      picture.far = std::max(picture.far, opening[p]);
      continue;
    }
    double& place = picture.surface[{std::lround(at[1] / spacing), std::lround(at[2] / spacing)}];
    place = std::max(place, opening[p]);
  }
  return picture;
}

void draw(Svg& svg, const Picture& picture, double left) {
  for (const auto& [place, opening] : picture.surface) {
    const double y = std::clamp((static_cast<double>(place.first) - 0.5) * spacing, 0.0, height);
    const double top = std::min((static_cast<double>(place.first) + 0.5) * spacing, height);
    const double z =
        std::clamp((static_cast<double>(place.second) - 0.5) * spacing, 0.0, thickness);
    const double end = std::min((static_cast<double>(place.second) + 0.5) * spacing, thickness);
    const std::string color = opening > 0.0 ? damage_color(std::min(1.0, opening / largest_opening))
                                            : std::string(undamaged_color);
    svg.rect({left + scale * z, 40.0 + scale * (height - top)}, scale * (end - z),
             scale * (top - y), fmt::format("fill=\"{}\"", color));
  }
  svg.text({left, 30.0}, fmt::format("load factor {:.3f}", picture.load_factor), "start",
           text_style);
}

void draw_key(Svg& svg, double left) {
  constexpr int steps = 40;
  for (int k = 0; k < steps; ++k) {
    const double part = (k + 0.5) / steps;
    svg.rect({left, 40.0 + scale * height * (1.0 - part - 0.5 / steps)}, 14.0,
             scale * height / steps + 0.5, fmt::format("fill=\"{}\"", damage_color(part)));
  }
  svg.text({left + 20.0, 52.0}, fmt::format("{} mm", largest_opening), "start", text_style);
  svg.text({left + 20.0, 40.0 + scale * height}, "0", "start", text_style);
}

}  // namespace
}  // namespace perilink::verification

bool perilink::verification::run_program(const std::vector<std::string>& arguments) {
  if (arguments.empty()) throw std::runtime_error("give the directory of a run of prism.toml");
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(arguments[0])) {
    if (entry.path().extension() == ".vtu") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  std::vector<Picture> pictures;
  bool in_plane = true;
  for (const auto& file : files) {
    pictures.push_back(picture_of(read_vtu(file.string())));
    double widest = 0.0;
    for (const auto& [place, opening] : pictures.back().surface) {
      widest = std::max(widest, opening);
    }
    fmt::print("{}: widest {:.4f} mm, beside the crack {:.4f} mm\n", file.filename().string(),
               widest, pictures.back().far);
    in_plane = in_plane && pictures.back().far <= 0.1 * widest;
  }
  const double step = scale * thickness + gap;
  Svg svg(40.0 + step * static_cast<double>(pictures.size()) + 80.0, scale * height + 60.0);
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    draw(svg, pictures[k], 20.0 + step * static_cast<double>(k));
  }
  draw_key(svg, 20.0 + step * static_cast<double>(pictures.size()));
  svg.save(PERILINK_STUDY_DIR "/surface.svg");
  return in_plane;
}

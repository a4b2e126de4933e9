#include "app/plot/plot_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "app/plot/plot_axes.hpp"
#include "base/error.hpp"
#include "results/field_file.hpp"

namespace perilink {
namespace {

const std::vector<double>& values_of(const VtuArray* array, const std::string& name, int components,
                                     const std::string& path) {
  if (!array || array->components != components) {
    throw FileError(path + ": array '" + name + "' of " + std::to_string(components) +
                    " component(s) is missing; was it written by perilink run?");
  }
  return array->values;
}

std::vector<Vector3> as_vectors(const std::vector<double>& values) {
  std::vector<Vector3> vectors(values.size() / 3);
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    vectors[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  }
  return vectors;
}

void read_lines(const VtuGrid& grid, const std::vector<double>& element, PlotBody& body) {
  // A body of linear elements only is drawn by its nodes.
  const bool has_particles =
      !element.empty() && element.front() == static_cast<double>(FieldElement::particle);
  const VtuArray* stress = grid.find_cell_data("axial_stress");
  const VtuArray* opening = grid.find_cell_data("crack_opening");
  const VtuArray* broken_at = grid.find_cell_data("broken_at");
  for (std::size_t cell = 0; cell < grid.types.size(); ++cell) {
    const std::size_t end = static_cast<std::size_t>(grid.offsets[cell]);
    const bool outlined = element[cell] == static_cast<double>(FieldElement::host) ||
                          element[cell] == static_cast<double>(FieldElement::cell);
    if (body.dim == 2 && has_particles && outlined) {
      const auto begin = static_cast<std::size_t>(cell > 0 ? grid.offsets[cell - 1] : 0);
      for (std::size_t k = begin; k < end; ++k) {
        body.elements.values.push_back(static_cast<Index>(grid.connectivity[k]));
      }
      body.elements.offsets.push_back(static_cast<Index>(body.elements.values.size()));
    }
    if (outlined || grid.types[cell] != VtuCell::line) continue;
    if (end < 2) continue;
    const Ends ends{grid.connectivity[end - 2], grid.connectivity[end - 1]};
    const bool bar = element[cell] == static_cast<double>(FieldElement::rebar_segment);
    (bar ? body.segments : body.broken_bonds).push_back(ends);
    if (!bar) {
      const double number = broken_at == nullptr ? 0.0 : broken_at->values[cell];
      const bool counts = number >= 0.0 && number <= std::numeric_limits<Index>::max();
      body.broken_at.push_back(counts ? static_cast<Index>(number) : 0);
    }
    if (!bar && opening != nullptr) body.openings.push_back(opening->values[cell]);
    if (bar && stress != nullptr) body.bar_stress.push_back(stress->values[cell]);
  }
}

/// Returns the drawn size of each particle. Square and cubic lattices have one size. Others fill
/// the plane with hexagons, or space with cubes, of the particle volumes. Files without volumes use
/// the spacing.
std::vector<double> particle_sizes(const VtuGrid& grid, const PlotBody& body) {
  std::vector<double> sizes(body.positions.size(), body.spacing);
  const VtuArray* volumes = grid.find_point_data("volume");
  if (volumes == nullptr || volumes->values.size() != sizes.size() || on_square_lattice(body)) {
    return sizes;
  }
  const double thickness = grid.field("thickness", 1.0);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const double volume = volumes->values[i];
    if (!(volume > 0.0)) continue;
    const bool flat = body.dim == 2 || body.is_mid_surface;
    sizes[i] = flat ? std::sqrt(volume / thickness * 2.0 / std::numbers::sqrt3) : std::cbrt(volume);
  }
  return sizes;
}

/// Reads supports and loads, where the file has them.
void read_conditions(const VtuGrid& grid, PlotBody& body) {
  if (const VtuArray* held = grid.find_point_data("held"); held && held->components == 1) {
    for (const double code : held->values) body.held.push_back(static_cast<int>(code) & 7);
  }
  for (const auto& [name, vectors] : {std::pair{"applied_force", &body.forces},
                                      std::pair{"prescribed_displacement", &body.moves}}) {
    const VtuArray* found = grid.find_point_data(name);
    if (found && found->components == 3) *vectors = as_vectors(found->values);
  }
}

double length(const Vector3& v) { return std::hypot(v[0], v[1], v[2]); }

}  // namespace

double von_mises(const double* stress) {
  const double* s = stress;
  const double normal =
      std::pow(s[0] - s[1], 2) + std::pow(s[1] - s[2], 2) + std::pow(s[2] - s[0], 2);
  return std::sqrt(0.5 * normal + 3.0 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

PlotBody read_body(const VtuGrid& grid, const std::string& path) {
  const auto point_values = [&](const char* name, int components) -> const std::vector<double>& {
    return values_of(grid.find_point_data(name), name, components, path);
  };
  PlotBody body;
  body.dim = grid.field("dimension", 2.0) == 3.0 ? 3 : 2;
  body.spacing = grid.field("spacing", 0.0);
  if (!(body.spacing > 0.0)) throw FileError(path + ": field 'spacing' is missing");
  body.positions = as_vectors(grid.points);
  body.displacements = as_vectors(point_values("displacement", 3));
  body.damage = point_values("damage", 1);
  for (const double kind : point_values("kind", 1)) {
    if (!(kind >= 0.0 && kind <= 3.0)) throw FileError(path + ": a particle has an unknown 'kind'");
    body.kind.push_back(static_cast<int>(kind));
  }
  read_lines(grid, values_of(grid.find_cell_data("element"), "element", 1, path), body);
  read_conditions(grid, body);
  body.is_mid_surface = body.dim == 3 && grid.field("thickness", 0.0) > 0.0;
  body.sizes = particle_sizes(grid, body);
  // Breakable bodies are coloured by damage.
  const VtuArray* stress = grid.find_point_data("stress");
  const bool breaks = grid.find_point_data("crack_opening") != nullptr;
  if (!breaks && stress != nullptr && stress->components == 6) {
    for (std::size_t i = 0; i < body.positions.size(); ++i) {
      body.stress.push_back(von_mises(stress->values.data() + 6 * i));
    }
  }
  const auto is_damaged = [](double damage) { return damage > 0.0; };
  if (body.is_mid_surface && std::none_of(body.damage.begin(), body.damage.end(), is_damaged)) {
    for (const Vector3& u : body.displacements) body.stress.push_back(length(u));
  }
  return body;
}

double automatic_scale(const PlotBody& body) {
  constexpr double share_of_size = 0.08;
  Vector3 low{infinity, infinity, infinity};
  Vector3 high{-infinity, -infinity, -infinity};
  double largest = 0.0;
  for (Index i = 0; i < body.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], body.positions[i][c]);
      high[c] = std::max(high[c], body.positions[i][c]);
    }
    if (!body.is_loose(i)) largest = std::max(largest, length(body.displacements[i]));
  }
  if (!(largest > 0.0)) return 1.0;
  double size = 0.0;
  for (std::size_t c = 0; c < 3; ++c) size = std::max(size, high[c] - low[c]);
  if (!(size > 0.0)) return 1.0;
  // Rounding down could halve the scale, so aim a quarter higher.
  return round_down_to_nice(1.25 * share_of_size * size / largest);
}

std::vector<Vector3> deformed_positions(const PlotBody& body, double scale) {
  std::vector<Vector3> deformed = body.positions;
  for (std::size_t i = 0; i < deformed.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) deformed[i][c] += scale * body.displacements[i][c];
  }
  return deformed;
}

bool on_square_lattice(const PlotBody& body) {
  const auto near_whole = [](double steps) { return std::abs(steps - std::round(steps)) < 0.05; };
  Index solid = 0, fitting = 0, first = no_index;
  for (Index i = 0; i < body.size(); ++i) {
    if (body.kind[i] != 0) continue;
    if (first == no_index) first = i;
    ++solid;
    bool fits = true;
    for (int a = 0; a < body.dim; ++a) {
      fits = fits && near_whole((body.positions[i][a] - body.positions[first][a]) / body.spacing);
    }
    fitting += fits;
  }
  return fitting > 0.95 * solid;
}

Vector3 view(const Vector3& point, int dim) {
  if (dim == 2) return {point[0], point[1], 0.0};
  const double turn = std::numbers::pi / 6.0;
  const double tilt = std::numbers::pi / 8.0;
  const double right = point[0] * std::cos(turn) - point[1] * std::sin(turn);
  const double away = point[0] * std::sin(turn) + point[1] * std::cos(turn);
  return {right, point[2] * std::cos(tilt) + away * std::sin(tilt),
          point[2] * std::sin(tilt) - away * std::cos(tilt)};
}

}  // namespace perilink

#include "model/from_case/unstructured_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/plain_text.hpp"
#include "discretization/lattices/triangulate.hpp"
#include "discretization/mesh_faces.hpp"
#include "discretization/meshes/mesh_body.hpp"
#include "discretization/meshes/scatter.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/mesh/gmsh_mesher.hpp"
#include "io/text/toml_tree.hpp"
#include "model/body/solid_boxes.hpp"

namespace perilink {
namespace {

/// Cell size over the mean distance of neighbours that it gives, in the plane and in space.
constexpr std::array<double, 2> size_of_cells = {1.0, 0.78};

/// Variation of the cell size between the corners of the body: other meshes of another seed.
constexpr double variation_of_sizes = 0.05;

/// Largest random move of a particle along each axis [spacings]. Frontal meshes are even, but have
/// rows, which lead cracks astray by 5 degrees (root mean square); moved ones by 2 to 3.
constexpr double largest_move = 0.2;

/// Particles this near to a face of a box lie on it [spacings]. gmsh's kernel rounds to 1e-7.
constexpr double on_face = 1e-5;

/// Shortest edge that particles of a body without narrow parts may have [spacings].
constexpr double shortest_edge = 0.1;

/// Draws the regions of a case in gmsh's script language. Lengths are spacings from a corner of the
/// body, because gmsh's kernel has absolute tolerances. Plane bodies are the bottoms of bodies of
/// unit height: only unions of volumes lose the faces between their parts.
class Drawing {
 public:
  Drawing(const CaseFile& input, int dim, const Vector3& origin, double spacing)
      : input_(input), dim_(dim), origin_(origin), spacing_(spacing) {}

  std::string text() {
    text_ = "SetFactory(\"OpenCASCADE\");\n";
    for (const MaterialSection& material : input_.materials) add_material(material);
    text_ += joints_;
    if (input_.materials.size() > 1) text_ += "BooleanFragments{ Volume{:}; Delete; }{ }\n";
    if (dim_ == 2) {
      text_ +=
          "s() = Surface In BoundingBox{-1e9, -1e9, -0.1, 1e9, 1e9, 0.1};\n"
          "Delete { Volume{:}; }\na() = Surface{:};\na() -= s();\nDelete { Surface{a()}; }\n";
    }
    const char* part = dim_ == 2 ? "Surface" : "Volume";
    text_ += fmt::format(
        "s() = {0}{{:}};\nFor k In {{0:#s()-1}}\n  Physical {0}(k + 1) = {{s(k)}};\nEndFor\n",
        part);
    std::mt19937 random(static_cast<std::uint32_t>(input_.body.seed));
    const auto angle = [&] { return 1e-3 * static_cast<double>(random() % 6283); };
    const double size = size_of_cells[dim_ - 2], first = angle(), next = angle();
    text_ += fmt::format(
        "p() = Point{{:}};\nFor k In {{0:#p()-1}}\n"
        "  MeshSize{{p(k)}} = {} + {} * Sin({} + {} * k);\nEndFor\n",
        size, size * variation_of_sizes, first, next);
    return text_ +
           fmt::format("Mesh.Algorithm = 6;\nMesh.RandomSeed = {};\n", 1 + random() % 1000000);
  }

 private:
  /// Draws a region. Numbers have twelve digits: the last ones depend on the unit of length, and
  /// other digits make another mesh.
  /// \return gmsh's number of it
  int add_shape(const Region& region) {
    std::array<double, 3> start{}, side{0.0, 0.0, 1.0}, center{}, axis{};
    for (int a = 0; a < dim_; ++a) {
      start[a] = (region.box.lower[a] - origin_[a]) / spacing_;
      side[a] = (region.box.upper[a] - region.box.lower[a]) / spacing_;
    }
    const auto three = [](const std::array<double, 3>& v) {
      return fmt::format("{:.12g}, {:.12g}, {:.12g}", v[0], v[1], v[2]);
    };
    ++count_;
    if (!region.round) {
      text_ += fmt::format("Box({}) = {{{}, {}}};\n", count_, three(start), three(side));
      return count_;
    }
    const std::optional<int> along = dim_ == 2 ? 2 : region.round->axis;
    for (int a = 0; a < 3; ++a) {
      center[a] = along == a ? start[a] : (region.round->center[a] - origin_[a]) / spacing_;
      axis[a] = along == a ? side[a] : 0.0;
    }
    const double radius = region.round->radius / spacing_;
    text_ += along ? fmt::format("Cylinder({}) = {{{}, {}, {:.12g}}};\n", count_, three(center),
                                 three(axis), radius)
                   : fmt::format("Sphere({}) = {{{}, {:.12g}}};\n", count_, three(center), radius);
    return count_;
  }

  std::string add_shapes(std::span<const std::string> names) {
    std::vector<int> numbers;
    for (const std::string& name : names) numbers.push_back(add_shape(region_named(input_, name)));
    return fmt::format("{}", fmt::join(numbers, ", "));
  }

  /// Draws the regions of a material, joined, without its holes. It replaces the materials before.
  void add_material(const MaterialSection& material) {
    const std::span<const std::string> regions = material.regions;
    const std::string first = add_shapes(regions.first(1));
    const auto join = [&](const char* result, const char* what, const std::string& object,
                          const std::string& tool, const char* after) {
      joints_ += fmt::format("{}() = Boolean{}{{ Volume{{{}}}; Delete; }}{{ Volume{{{}}}; {}}};\n",
                             result, what, object, tool, after);
    };
    joints_ += fmt::format("m() = {{{}}};\n", first);
    if (regions.size() > 1) join("m", "Union", "m()", add_shapes(regions.subspan(1)), "Delete; ");
    if (!material.holes.empty()) {
      join("m", "Difference", "m()", add_shapes(material.holes), "Delete; ");
    }
    if (&material != &input_.materials.front()) join("e", "Difference", "e()", "m()", "");
    joints_ += &material == &input_.materials.front() ? "e() = m();\n" : "e() += m();\n";
  }

  const CaseFile& input_;
  int dim_;
  Vector3 origin_;
  double spacing_;
  std::string text_;    ///< first all shapes, because gmsh numbers what the others leave
  std::string joints_;  ///< unions and cuts
  int count_ = 0;
};

/// Returns the material of a point, no_index outside the body. Later materials count.
Index material_at(const CaseFile& input, std::span<const double> point) {
  const auto contains = [&](const std::string& name) {
    return region_named(input, name).contains(point, 0.0);
  };
  for (std::size_t m = input.materials.size(); m-- > 0;) {
    const MaterialSection& material = input.materials[m];
    if (std::any_of(material.regions.begin(), material.regions.end(), contains) &&
        std::none_of(material.holes.begin(), material.holes.end(), contains)) {
      return static_cast<Index>(m);
    }
  }
  return no_index;
}

/// Returns the material of every cell. The group of a part of the geometry has the material at the
/// centre of its largest cell: cells beside a curved face may have their centre beyond it.
std::vector<Index> materials_of_parts(const CaseFile& input, const Mesh& mesh) {
  std::vector<Index> material(static_cast<std::size_t>(mesh.num_cells()), no_index);
  Simplices cells;
  cells.dim = mesh.dim;
  cells.vertices = mesh.cells;
  cells.material = material;
  const std::vector<double> volumes = cell_volumes(cells, mesh.positions, 1.0);
  for (const MeshGroup& group : mesh.groups) {
    const Index largest = *std::max_element(
        group.elements.begin(), group.elements.end(),
        [&](Index a, Index b) { return std::abs(volumes[a]) < std::abs(volumes[b]); });
    Vector3 centre{};
    for (const Index i : cells.cell(largest)) {
      const Vector3 x = point_of(mesh.positions, mesh.dim, i);
      for (int a = 0; a < mesh.dim; ++a) centre[a] += x[a] / (mesh.dim + 1);
    }
    const Index own = material_at(input, {centre.data(), static_cast<std::size_t>(mesh.dim)});
    for (const Index cell : group.elements) material[cell] = own;
  }
  return material;
}

/// Turns spacings into lengths. Particles on faces of boxes lie on them exactly.
void place(const CaseFile& input, const Vector3& origin, double spacing, Mesh& mesh) {
  std::array<std::vector<double>, 3> faces;
  for (const Region& region : input.regions) {
    for (int a = 0; a < mesh.dim; ++a) {
      if (region.round && region.round->axis != a) continue;
      faces[a].insert(faces[a].end(), {region.box.lower[a], region.box.upper[a]});
    }
  }
  for (std::vector<double>& own : faces) std::sort(own.begin(), own.end());
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    const auto axis = k % static_cast<std::size_t>(mesh.dim);
    double& x = mesh.positions[k];
    x = origin[axis] + spacing * x;
    const auto face =
        std::lower_bound(faces[axis].begin(), faces[axis].end(), x - on_face * spacing);
    if (face != faces[axis].end() && *face <= x + on_face * spacing) x = *face;
  }
}

void refuse_narrow_parts(const CaseFile& input, const Body& body, double spacing) {
  const Bonds edges = edges_of(body.cells, body.particles);
  const auto shortest = std::min_element(edges.lengths.begin(), edges.lengths.end());
  if (*shortest > shortest_edge * spacing) return;
  const auto at = static_cast<std::size_t>(shortest - edges.lengths.begin());
  throw InputError(
      input.where(input.body.spacing ? "body.spacing" : "body.columns"),
      fmt::format("is {:.6g}, but faces of regions are only {:.3g} apart at ({})", spacing,
                  *shortest, joined(body.particles.position(edges.first[at]))),
      "move the faces of the regions together or apart, or choose a finer spacing");
}

void refuse_small_rounds(const CaseFile& input, double spacing) {
  const auto refuse = [&](const std::string& key, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      const auto& round = region_named(input, name).round;
      if (!round || round->radius >= spacing) continue;
      throw InputError(input.where(key),
                       fmt::format("is {}, whose radius {:.6g} is less than the spacing {:.6g}",
                                   quoted(name), round->radius, spacing),
                       "choose a finer spacing, or leave the region out");
    }
  };
  for (std::size_t m = 0; m < input.materials.size(); ++m) {
    const std::string list = item_key("materials", m, "regions");
    refuse(input.source.lines.count(list) > 0 ? list : item_key("materials", m, "region"),
           input.materials[m].regions);
    refuse(item_key("materials", m, "holes"), input.materials[m].holes);
  }
}

}  // namespace

Box box_of_materials(const CaseFile& input) {
  Box all = region_named(input, input.materials.front().regions.front()).box;
  for (const MaterialSection& material : input.materials) {
    for (const std::string& name : material.regions) {
      const Box& box = region_named(input, name).box;
      for (int a = 0; a < 3; ++a) {
        all.lower[a] = std::min(all.lower[a], box.lower[a]);
        all.upper[a] = std::max(all.upper[a], box.upper[a]);
      }
    }
  }
  return all;
}

Body make_unstructured_body(const CaseFile& input, int dim, double spacing) {
  refuse_small_rounds(input, spacing);
  const Vector3 origin = box_of_materials(input).lower;
  const SourceLocation where = input.where("body.pattern");
  Mesh mesh;
  try {
    mesh = mesh_drawing(Drawing(input, dim, origin, spacing).text(), dim, 1.0);
  } catch (const CellSizeError& error) {
    throw InputError(input.where(input.body.spacing ? "body.spacing" : "body.columns"),
                     error.what(), "choose a coarser spacing");
  } catch (const Error& error) {
    throw InputError(where, fmt::format("is \"unstructured\": {}", error.what()), "");
  }
  place(input, origin, spacing, mesh);
  const std::vector<Index> material = materials_of_parts(input, mesh);
  scatter_points(mesh, material, largest_move * spacing,
                 static_cast<std::uint32_t>(input.body.seed));
  mesh.groups.clear();
  try {
    Body body = make_mesh_body(mesh, material, dim == 2 ? input.body.thickness : 1.0);
    refuse_narrow_parts(input, body, spacing);
    return body;
  } catch (const std::invalid_argument& error) {
    throw InputError(where, fmt::format("is \"unstructured\": {}", error.what()), "");
  }
}

}  // namespace perilink

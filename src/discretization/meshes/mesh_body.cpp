#include "discretization/meshes/mesh_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "base/plain_text.hpp"
#include "discretization/facet_geometry.hpp"
#include "discretization/lattices/triangulate.hpp"
#include "discretization/mesh_faces.hpp"
#include "discretization/meshes/cell_corners.hpp"
#include "discretization/meshes/mesh_conformity.hpp"
#include "discretization/meshes/mesh_overlap.hpp"

namespace perilink {
namespace {

/// Returns the particle of every point of the mesh; no_index if no cell with a material uses it.
std::vector<Index> number_particles(const Mesh& mesh, std::span<const Index> material) {
  std::vector<Index> particle(static_cast<std::size_t>(mesh.num_points()), no_index);
  const int width = mesh.dim + 1;
  for (Index cell = 0; cell < mesh.num_cells(); ++cell) {
    if (material[cell] == no_index) continue;
    for (int k = 0; k < width; ++k) {
      particle[mesh.cells[static_cast<std::size_t>(cell) * width + k]] = 0;
    }
  }
  Index count = 0;
  for (Index& number : particle) {
    if (number != no_index) number = count++;
  }
  return particle;
}

void add_particles(const Mesh& mesh, std::span<const Index> particle, Particles& particles) {
  particles.dim = mesh.dim;
  for (Index point = 0; point < mesh.num_points(); ++point) {
    if (particle[point] == no_index) continue;
    const double* x = mesh.positions.data() + static_cast<std::size_t>(point) * mesh.dim;
    particles.positions.insert(particles.positions.end(), x, x + mesh.dim);
    particles.volumes.push_back(0.0);
    particles.material.push_back(no_index);
    particles.kind.push_back(ParticleKind::solid);
  }
}

/// Adds the cells with positive orientation and divides their volume and material among their
/// particles.
/// \return number in the body of every cell of the mesh
std::vector<Index> add_cells(const Mesh& mesh, std::span<const Index> material, double thickness,
                             std::span<const Index> particle, Body& body) {
  const int dim = mesh.dim;
  const std::size_t width = static_cast<std::size_t>(dim) + 1;
  std::vector<Index> number(material.size(), no_index);
  body.cells.dim = dim;
  std::vector<Index> corners(width);
  for (Index cell = 0; cell < mesh.num_cells(); ++cell) {
    if (material[cell] == no_index) continue;
    for (std::size_t k = 0; k < width; ++k) corners[k] = particle[mesh.cells[cell * width + k]];
    const auto& positions = body.particles.positions;
    const double volume = signed_volume(positions, dim, corners);
    const CellCorners shape(positions, dim, corners);
    if (!(std::abs(volume) > CellCorners::flattest * std::pow(shape.size, dim))) {
      shape.refuse_flat();
    }
    if (volume < 0.0) std::swap(corners[width - 2], corners[width - 1]);
    number[cell] = body.cells.size();
    body.cells.vertices.insert(body.cells.vertices.end(), corners.begin(), corners.end());
    body.cells.material.push_back(material[cell]);
    const double share =
        std::abs(volume) * (dim == 2 ? thickness : 1.0) / static_cast<double>(width);
    for (const Index i : corners) {
      body.particles.volumes[i] += share;
      body.particles.material[i] = std::max(body.particles.material[i], material[cell]);
    }
  }
  return number;
}

/// Returns the surface facet of every face, no_index for inner faces; facets have the order of
/// faces.
std::vector<Index> number_surface_facets(const CellFaces& faces, const Simplices& cells) {
  std::vector<Index> number(static_cast<std::size_t>(faces.size()), no_index);
  Index count = 0;
  for (Index f = 0; f < faces.size(); ++f) {
    const auto [inner, outer] = faces.cells[f];
    if (outer == no_index) {
      number[f] = count++;
    } else if (cells.material[inner] != cells.material[outer]) {
      ++count;
    }
  }
  return number;
}

/// Returns a lattice with mean values over the cells that have bonds.
Lattice lattice_of(const Body& body, double thickness) {
  const Simplices cells = cells_of(body, false);
  const Bonds edges = edges_of(cells, body.particles);
  const std::vector<double> volumes = shape_integrals(cells, body.particles.positions, thickness);
  const auto without = std::count(volumes.begin(), volumes.end(), 0.0);
  Lattice lattice;
  lattice.pattern = Pattern::irregular;
  lattice.dim = body.particles.dim;
  lattice.spacing = std::accumulate(edges.lengths.begin(), edges.lengths.end(), 0.0) /
                    static_cast<double>(edges.size());
  lattice.cell_volume = std::accumulate(volumes.begin(), volumes.end(), 0.0) /
                        static_cast<double>(static_cast<std::ptrdiff_t>(volumes.size()) - without);
  return lattice;
}

/// Numbers in the body of the mesh's points, cells and faces.
struct Numbering {
  std::vector<Index> particle;       ///< per point
  std::vector<Index> cell;           ///< per cell
  std::vector<Index> surface_facet;  ///< per face
  bool whole = true;                 ///< whether every cell has a material
};

void refuse_overlap(const Mesh& mesh, const CellFaces& faces, const Numbering& numbering,
                    const Body& body) {
  const auto overlap = find_overlap(body.cells, body.particles.positions, faces);
  if (!overlap) return;
  const auto tag_of = [&](Index cell) {
    const auto found = std::find(numbering.cell.begin(), numbering.cell.end(), cell);
    return mesh.tag_of(static_cast<Index>(found - numbering.cell.begin()));
  };
  Vector3 centre{};
  for (const Index i : body.cells.cell((*overlap)[0])) {
    const Vector3 x = point_of(body.particles.positions, mesh.dim, i);
    for (int axis = 0; axis < mesh.dim; ++axis) centre[axis] += x[axis] / (mesh.dim + 1);
  }
  throw std::invalid_argument(fmt::format(
      "the elements {} and {} overlap at ({}), so their material would count twice; join the "
      "parts of the geometry before they are meshed: BooleanFragments or Coherence in gmsh",
      tag_of((*overlap)[0]), tag_of((*overlap)[1]),
      joined({centre.data(), static_cast<std::size_t>(mesh.dim)})));
}

/// Adds the surface facets of a group of facets. Facets between cells are not on the surface, and
/// facets of omitted cells are not in the body. Lines that are no sides can be curves for bars.
void add_facets_of_facets(const Mesh& mesh, const MeshGroup& group, const CellFaces& faces,
                          const Numbering& numbering, Group& result) {
  std::vector<Index> corners(static_cast<std::size_t>(mesh.dim));
  for (const Index element : group.elements) {
    const Index* own = mesh.facets.data() + static_cast<std::size_t>(element) * mesh.dim;
    for (int k = 0; k < mesh.dim; ++k) corners[k] = numbering.particle[own[k]];
    const bool known = std::find(corners.begin(), corners.end(), no_index) == corners.end();
    const Index face = known ? find_face(faces, corners) : no_index;
    if (face != no_index) {
      result.sides.insert(result.sides.end(), corners.begin(), corners.end());
      if (numbering.surface_facet[face] != no_index) {
        result.facets.push_back(numbering.surface_facet[face]);
      }
    } else if (numbering.whole) {
      if (!result.loose) result.loose = point_of(mesh.positions, mesh.dim, own[0]);
    }
  }
}

/// Adds the points of a group of points or lines, and the ends of its lines.
void add_lines(const Mesh& mesh, const MeshGroup& group, const Numbering& numbering,
               Group& result) {
  const std::vector<Index>& lines = mesh.dim == 2 ? mesh.facets : mesh.lines;
  for (const Index point : group.points) {
    const Vector3 x = point_of(mesh.positions, mesh.dim, point);
    result.line_points.insert(result.line_points.end(), x.begin(), x.end());
    const bool is_own = group.dim == 1 && numbering.particle[point] == no_index;
    if (is_own && numbering.whole && !result.loose) result.loose = x;
  }
  for (const Index element : group.elements) {
    for (const std::size_t k : {0, 1}) {
      const Index point = lines[2 * static_cast<std::size_t>(element) + k];
      const auto place = std::lower_bound(group.points.begin(), group.points.end(), point);
      result.lines.push_back(static_cast<Index>(place - group.points.begin()));
    }
  }
}

void add_cells_of_group(const MeshGroup& group, const CellFaces& faces, const Numbering& numbering,
                        Index num_cells, Group& result) {
  std::vector<bool> member(static_cast<std::size_t>(num_cells), false);
  for (const Index element : group.elements) {
    if (numbering.cell[element] != no_index) member[numbering.cell[element]] = true;
  }
  for (Index cell = 0; cell < num_cells; ++cell) {
    if (member[cell]) result.cells.push_back(cell);
  }
  for (Index f = 0; f < faces.size(); ++f) {
    if (numbering.surface_facet[f] != no_index && member[faces.cells[f][0]]) {
      result.facets.push_back(numbering.surface_facet[f]);
    }
  }
}

Group body_group(const Mesh& mesh, const MeshGroup& group, const CellFaces& faces,
                 const Numbering& numbering, Index num_cells) {
  Group result;
  result.name = group.name;
  for (const Index point : group.points) {
    if (numbering.particle[point] != no_index) {
      result.particles.push_back(numbering.particle[point]);
    }
  }
  if (group.dim == mesh.dim) add_cells_of_group(group, faces, numbering, num_cells, result);
  if (group.dim == mesh.dim - 1) add_facets_of_facets(mesh, group, faces, numbering, result);
  if (group.dim <= 1) add_lines(mesh, group, numbering, result);
  std::sort(result.facets.begin(), result.facets.end());
  result.facets.erase(std::unique(result.facets.begin(), result.facets.end()), result.facets.end());
  return result;
}

}  // namespace

std::vector<Index> materials_of_cells(const Mesh& mesh, std::span<const Region> regions,
                                      std::span<const Index> material) {
  std::vector<Index> result(static_cast<std::size_t>(mesh.num_cells()), no_index);
  const std::size_t width = static_cast<std::size_t>(mesh.dim) + 1;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    if (!regions[r].group.empty()) {
      for (const MeshGroup& group : mesh.groups) {
        if (group.name != regions[r].group || group.dim != mesh.dim) continue;
        for (const Index cell : group.elements) result[cell] = material[r];
      }
      continue;
    }
    for (Index cell = 0; cell < mesh.num_cells(); ++cell) {
      Vector3 centre{};
      for (std::size_t k = 0; k < width; ++k) {
        const Vector3 x = point_of(mesh.positions, mesh.dim, mesh.cells[cell * width + k]);
        for (int axis = 0; axis < mesh.dim; ++axis) {
          centre[axis] += x[axis] / static_cast<double>(width);
        }
      }
      const std::span<const double> point(centre.data(), static_cast<std::size_t>(mesh.dim));
      if (regions[r].contains(point, 0.0)) result[cell] = material[r];
    }
  }
  return result;
}

Simplices cells_of(const Body& body, bool tied) {
  if (body.tied.empty() && !tied) return body.cells;
  Simplices chosen;
  chosen.dim = body.cells.dim;
  for (Index k = 0; k < static_cast<Index>(body.tied.size()); ++k) {
    if ((body.tied[k] != 0) != tied) continue;
    const auto cell = body.cells.cell(k);
    chosen.vertices.insert(chosen.vertices.end(), cell.begin(), cell.end());
    chosen.material.push_back(body.cells.material[k]);
  }
  return chosen;
}

Body make_mesh_body(const Mesh& mesh, std::span<const Index> material, double thickness,
                    std::span<const std::uint8_t> tied) {
  if (material.size() != static_cast<std::size_t>(mesh.num_cells())) {
    throw std::invalid_argument("every cell of the mesh needs a material or none");
  }
  if (!(thickness > 0.0)) throw std::invalid_argument("the thickness must be positive");
  if (std::all_of(material.begin(), material.end(), [](Index m) { return m == no_index; })) {
    throw std::invalid_argument("the body is empty: no cell of the mesh has a material");
  }
  Body body;
  Numbering numbering;
  numbering.whole = std::find(material.begin(), material.end(), no_index) == material.end();
  numbering.particle = number_particles(mesh, material);
  add_particles(mesh, numbering.particle, body.particles);
  numbering.cell = add_cells(mesh, material, thickness, numbering.particle, body);
  const CellFaces faces = find_faces(body.cells, body.particles.positions);
  body.facets = facets_of(body.cells, body.particles.positions, thickness);
  refuse_overlap(mesh, faces, numbering, body);
  numbering.surface_facet = number_surface_facets(faces, body.cells);
  refuse_unjoined_parts(body.particles, body.facets);
  for (const MeshGroup& group : mesh.groups) {
    body.groups.push_back(body_group(mesh, group, faces, numbering, body.cells.size()));
  }
  for (Index cell = 0; !tied.empty() && cell < mesh.num_cells(); ++cell) {
    if (numbering.cell[cell] != no_index) body.tied.push_back(tied[cell]);
  }
  body.lattice = lattice_of(body, thickness);
  return body;
}

}  // namespace perilink

#include "discretization/facets.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <tuple>

namespace perilink {
namespace {

/// Sorts after every particle.
constexpr Index no_corner = std::numeric_limits<Index>::max();

/// Side of a cell; its corners are ascending, so that sides of neighbouring cells match.
struct Side {
  std::array<Index, 3> corners;  // the third is no_corner in two dimensions
  Index material;
  Vector3 area_vector;  // out of the cell
};

Vector3 point(std::span<const double> positions, int dim, Index i) {
  Vector3 x{};
  for (int axis = 0; axis < dim; ++axis) {
    x[axis] = positions[static_cast<std::size_t>(i) * dim + axis];
  }
  return x;
}

/// Returns the area vector of the side opposite to `apex`, pointing away from it.
Vector3 area_vector_of(std::span<const double> positions, int dim,
                       const std::array<Index, 3>& corners, Index apex, double thickness) {
  const Vector3 a = point(positions, dim, corners[0]);
  const Vector3 b = point(positions, dim, corners[1]);
  const Vector3 p = point(positions, dim, apex);
  Vector3 normal{};
  if (dim == 2) {
    normal = {thickness * (b[1] - a[1]), thickness * (a[0] - b[0]), 0.0};
  } else {
    const Vector3 c = point(positions, dim, corners[2]);
    for (int axis = 0; axis < 3; ++axis) {
      const int y = (axis + 1) % 3, z = (axis + 2) % 3;
      normal[axis] = 0.5 * ((b[y] - a[y]) * (c[z] - a[z]) - (b[z] - a[z]) * (c[y] - a[y]));
    }
  }
  double inward = 0.0;
  for (int axis = 0; axis < dim; ++axis) inward += normal[axis] * (p[axis] - a[axis]);
  if (inward > 0.0) {
    for (double& component : normal) component = -component;
  }
  return normal;
}

std::vector<Side> sides_of(const Simplices& cells, std::span<const double> positions,
                           double thickness) {
  std::vector<Side> sides;
  sides.reserve(cells.vertices.size());
  for (Index number = 0; number < cells.size(); ++number) {
    const std::span<const Index> cell = cells.cell(number);
    for (const Index apex : cell) {
      Side side{{no_corner, no_corner, no_corner}, cells.material[number], {}};
      std::copy_if(cell.begin(), cell.end(), side.corners.begin(),
                   [apex](Index i) { return i != apex; });
      std::sort(side.corners.begin(), side.corners.end());
      side.area_vector = area_vector_of(positions, cells.dim, side.corners, apex, thickness);
      sides.push_back(side);
    }
  }
  std::stable_sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.corners, a.material) < std::tie(b.corners, b.material);
  });
  return sides;
}

}  // namespace

Vector3 Facets::centre(Index facet, std::span<const double> positions) const {
  Vector3 mean{};
  const std::span<const Index> ends = corners.row(facet);
  for (const Index i : ends) {
    for (int axis = 0; axis < dim; ++axis) {
      mean[axis] +=
          positions[static_cast<std::size_t>(i) * dim + axis] / static_cast<double>(ends.size());
    }
  }
  return mean;
}

void Facets::append(std::span<const Index> corner_particles, const Vector3& area_vector,
                    Index material_inside, Index material_outside) {
  corners.values.insert(corners.values.end(), corner_particles.begin(), corner_particles.end());
  corners.offsets.push_back(static_cast<Index>(corners.values.size()));
  shares.resize(corners.values.size(), 1.0 / static_cast<double>(corner_particles.size()));
  area_vectors.insert(area_vectors.end(), area_vector.begin(), area_vector.begin() + dim);
  inside.push_back(material_inside);
  outside.push_back(material_outside);
}

Facets facets_of(const Simplices& cells, std::span<const double> positions, double thickness) {
  const std::vector<Side> sides = sides_of(cells, positions, thickness);
  Facets facets;
  facets.dim = cells.dim;
  for (std::size_t k = 0; k < sides.size();) {
    std::size_t end = k + 1;
    while (end < sides.size() && sides[end].corners == sides[k].corners) ++end;
    if (end - k > 2) throw std::invalid_argument("more than two cells of the mesh share a side");
    const std::span<const Index> corners(sides[k].corners.data(),
                                         static_cast<std::size_t>(cells.dim));
    if (end - k == 1) {
      facets.append(corners, sides[k].area_vector, sides[k].material, no_index);
    } else if (sides[k].material != sides[k + 1].material) {
      facets.append(corners, sides[k].area_vector, sides[k].material, sides[k + 1].material);
    }
    k = end;
  }
  return facets;
}

}  // namespace perilink

#include "discretization/meshes/scatter.hpp"

#include <algorithm>
#include <array>
#include <random>
#include <utility>
#include <vector>

#include "discretization/facet_geometry.hpp"

namespace perilink {
namespace {

/// Least share of its volume that a cell keeps.
constexpr double least_share = 0.4;

std::span<const Index> cell_of(const Mesh& mesh, Index cell) {
  const auto width = static_cast<std::size_t>(mesh.dim) + 1;
  return std::span(mesh.cells).subspan(static_cast<std::size_t>(cell) * width, width);
}

/// Per point, whether it lies neither on the surface nor on a face between parts.
std::vector<bool> inner_points(const Mesh& mesh, std::span<const Index> part) {
  using Side = std::pair<std::array<Index, 3>, Index>;  // ascending corners, part
  std::vector<Side> sides;
  for (Index cell = 0; cell < mesh.num_cells(); ++cell) {
    const std::span<const Index> corners = cell_of(mesh, cell);
    for (std::size_t left_out = 0; left_out < corners.size(); ++left_out) {
      std::array<Index, 3> side{no_index, no_index, no_index};
      std::size_t count = 0;
      for (std::size_t k = 0; k < corners.size(); ++k) {
        if (k != left_out) side[count++] = corners[k];
      }
      std::sort(side.begin(), side.end());
      sides.emplace_back(side, part[cell]);
    }
  }
  std::sort(sides.begin(), sides.end());
  std::vector<bool> inner(static_cast<std::size_t>(mesh.num_points()), true);
  for (std::size_t k = 0; k < sides.size(); ++k) {
    if (k + 1 < sides.size() && sides[k] == sides[k + 1]) {
      ++k;  // both cells belong to one part
      continue;
    }
    for (const Index point : sides[k].first) {
      if (point != no_index) inner[point] = false;
    }
  }
  return inner;
}

std::vector<double> volumes_of(const Mesh& mesh) {
  std::vector<double> volumes;
  for (Index cell = 0; cell < mesh.num_cells(); ++cell) {
    volumes.push_back(signed_volume(mesh.positions, mesh.dim, cell_of(mesh, cell)));
  }
  return volumes;
}

}  // namespace

void scatter_points(Mesh& mesh, std::span<const Index> part, double amount, std::uint32_t seed) {
  const std::vector<double> before = mesh.positions, volumes = volumes_of(mesh);
  std::vector<bool> moved = inner_points(mesh, part);
  const auto dim = static_cast<std::size_t>(mesh.dim);
  std::mt19937 random(seed);
  for (std::size_t k = 0; k < before.size(); ++k) {
    if (!moved[k / dim]) continue;
    mesh.positions[k] += amount * (static_cast<double>(random()) / 2147483648.0 - 1.0);
  }
  for (bool returned = true; returned;) {
    returned = false;
    const std::vector<double> now = volumes_of(mesh);
    for (Index cell = 0; cell < mesh.num_cells(); ++cell) {
      // A negative share means a cell that is turned over.
      if (now[cell] / volumes[cell] >= least_share) continue;
      for (const Index point : cell_of(mesh, cell)) {
        if (!moved[point]) continue;
        moved[point] = false;
        returned = true;
        const std::size_t at = static_cast<std::size_t>(point) * dim;
        std::copy_n(before.begin() + at, dim, mesh.positions.begin() + at);
      }
    }
  }
}

}  // namespace perilink

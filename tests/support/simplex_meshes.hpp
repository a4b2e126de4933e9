#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "discretization/meshes/mesh.hpp"

/// \file
/// Meshes of boxes without groups.

namespace perilink::test {

/// Returns a box [0, 1]^dim with `count` steps along each axis: two triangles per square, six
/// tetrahedra around the diagonal of each cube. Inner points are shifted at random by a tenth of a
/// step, and every third cell has negative orientation.
inline Mesh box_mesh(int dim, int count) {
  Mesh mesh;
  mesh.dim = dim;
  const int layers = dim == 3 ? count : 0;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.1, 0.1);
  const auto number = [count](int i, int j, int k) {
    return i + (count + 1) * (j + (count + 1) * k);
  };
  for (int k = 0; k <= layers; ++k) {
    for (int j = 0; j <= count; ++j) {
      for (int i = 0; i <= count; ++i) {
        const std::array<int, 3> step = {i, j, k};
        const bool inside = std::all_of(step.begin(), step.begin() + dim,
                                        [count](int s) { return s > 0 && s < count; });
        for (int axis = 0; axis < dim; ++axis) {
          mesh.positions.push_back((step[axis] + (inside ? shift(random) : 0.0)) / count);
        }
      }
    }
  }
  // Each path along the axes to the opposite corner, one per order of axes, is a simplex.
  for (int k = 0; k < std::max(layers, 1); ++k) {
    for (int j = 0; j < count; ++j) {
      for (int i = 0; i < count; ++i) {
        std::array<int, 3> order = {0, 1, 2};
        do {
          std::array<int, 3> at = {i, j, k};
          std::vector<Index> cell = {number(at[0], at[1], at[2])};
          for (int step = 0; step < dim; ++step) {
            ++at[order[step]];
            cell.push_back(number(at[0], at[1], at[2]));
          }
          if (mesh.num_cells() % 3 == 0) std::swap(cell[0], cell[1]);
          mesh.cells.insert(mesh.cells.end(), cell.begin(), cell.end());
        } while (std::next_permutation(order.begin(), order.begin() + dim));
      }
    }
  }
  return mesh;
}

/// Returns a mesh in gmsh's format, with points scaled by `scale` and moved by `shift`.
inline std::string gmsh_text(const Mesh& mesh, const std::array<double, 3>& scale,
                             const std::array<double, 3>& shift) {
  const Index points = mesh.num_points(), cells = mesh.num_cells();
  std::string text = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
  text += fmt::format("$Nodes\n1 {0} 1 {0}\n{1} 1 0 {0}\n", points, mesh.dim);
  for (Index i = 1; i <= points; ++i) text += fmt::format("{}\n", i);
  for (Index i = 0; i < points; ++i) {
    for (int a = 0; a < 3; ++a) {
      const double x = a < mesh.dim ? mesh.positions[i * mesh.dim + a] : 0.0;
      text += fmt::format("{} ", scale[a] * x + shift[a]);
    }
    text += "\n";
  }
  text += fmt::format("$EndNodes\n$Elements\n1 {0} 1 {0}\n{1} 1 {2} {0}\n", cells, mesh.dim,
                      mesh.dim == 2 ? 2 : 4);
  for (Index e = 0; e < cells; ++e) {
    text += fmt::format("{}", e + 1);
    for (int k = 0; k <= mesh.dim; ++k) {
      text += fmt::format(" {}", mesh.cells[e * (mesh.dim + 1) + k] + 1);
    }
    text += "\n";
  }
  return text + "$EndElements\n";
}

}  // namespace perilink::test

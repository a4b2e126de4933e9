#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "support/simplex_meshes.hpp"

/// \file
/// Meshes of squares and cubes with two halves, rotated against the axes.

namespace perilink::test {

/// Rotates by 30 degrees about z, in space then by 20 degrees about x.
inline std::array<double, 3> turned(const std::array<double, 3>& x, int dim) {
  const double a = std::acos(-1.0) / 6.0, b = dim == 3 ? std::acos(-1.0) / 9.0 : 0.0;
  const double along = x[0] * std::cos(a) - x[1] * std::sin(a);
  const double across = x[0] * std::sin(a) + x[1] * std::cos(a);
  return {along, across * std::cos(b) - x[2] * std::sin(b),
          across * std::sin(b) + x[2] * std::cos(b)};
}

/// Group of cells or of their sides.
struct HalvedGroup {
  std::string name;
  int dim;
  std::set<std::vector<Index>> elements;  ///< points of each element
};

/// Returns the halves "first" and "second", the body's sides "left" and "right", and the "face"
/// between the halves, which consists of sides of cells.
inline std::vector<HalvedGroup> halves_of(const Mesh& mesh) {
  std::vector<HalvedGroup> groups = {{"first", mesh.dim, {}},
                                     {"second", mesh.dim, {}},
                                     {"left", mesh.dim - 1, {}},
                                     {"right", mesh.dim - 1, {}},
                                     {"face", mesh.dim - 1, {}}};
  const std::map<double, std::size_t> planes = {{0.0, 2}, {1.0, 3}, {0.5, 4}};
  const int width = mesh.dim + 1;
  for (Index e = 0; e < mesh.num_cells(); ++e) {
    const std::vector<Index> cell(mesh.cells.begin() + e * width,
                                  mesh.cells.begin() + (e + 1) * width);
    double middle = 0.0;
    for (const Index i : cell) middle += mesh.positions[i * mesh.dim] / width;
    groups[middle < 0.5 ? 0 : 1].elements.insert(cell);
    for (const auto& [plane, group] : planes) {
      std::vector<Index> side;
      for (const Index i : cell) {
        if (mesh.positions[i * mesh.dim] == plane) side.push_back(i);
      }
      std::sort(side.begin(), side.end());
      if (static_cast<int>(side.size()) == mesh.dim) groups[group].elements.insert(side);
    }
  }
  return groups;
}

/// Returns a mesh in gmsh's format with `count` cells, an even number, along each side of length
/// `side`.
inline std::string halved_mesh_text(int dim, int count, double side) {
  Mesh mesh = box_mesh(dim, count);
  for (Index i = 0; i < mesh.num_points(); ++i) {
    double& x = mesh.positions[i * dim];
    if (std::abs(x - 0.5) < 0.2 / count) x = 0.5;
  }
  const std::vector<HalvedGroup> groups = halves_of(mesh);
  std::string names, elements;
  std::array<std::string, 4> entities;
  std::array<int, 4> entities_of = {};
  Index number = 0;
  int tag = 0;
  for (const HalvedGroup& group : groups) {
    names += fmt::format("{} {} \"{}\"\n", group.dim, ++tag, group.name);
    entities[group.dim] += fmt::format("{0} -1 -1 -1 1 1 1 1 {0} 0\n", tag);
    ++entities_of[group.dim];
    const int type = group.dim == 1 ? 1 : group.dim == 2 ? 2 : 4;
    elements += fmt::format("{} {} {} {}\n", group.dim, tag, type, group.elements.size());
    for (const std::vector<Index>& element : group.elements) {
      elements += fmt::format("{}", ++number);
      for (const Index i : element) elements += fmt::format(" {}", i + 1);
      elements += "\n";
    }
  }
  std::string text = fmt::format(
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n{}$EndPhysicalNames\n"
      "$Entities\n0 {} {} {}\n{}{}{}$EndEntities\n",
      groups.size(), names, entities_of[1], entities_of[2], entities_of[3], entities[1],
      entities[2], entities[3]);
  text += fmt::format("$Nodes\n1 {0} 1 {0}\n{1} 1 0 {0}\n", mesh.num_points(), dim);
  for (Index i = 1; i <= mesh.num_points(); ++i) text += fmt::format("{}\n", i);
  for (Index i = 0; i < mesh.num_points(); ++i) {
    std::array<double, 3> x{};
    for (int a = 0; a < dim; ++a) x[a] = side * mesh.positions[i * dim + a];
    const auto [px, py, pz] = turned(x, dim);
    text += fmt::format("{} {} {}\n", px, py, pz);
  }
  return text + fmt::format("$EndNodes\n$Elements\n{0} {1} 1 {1}\n{2}$EndElements\n", groups.size(),
                            number, elements);
}

}  // namespace perilink::test

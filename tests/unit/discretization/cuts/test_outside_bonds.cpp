#include "discretization/cuts/outside_bonds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <utility>

#include "discretization/facet_geometry.hpp"
#include "discretization/mesh_faces.hpp"
#include "discretization/meshes/mesh_body.hpp"
#include "support/simplex_meshes.hpp"

namespace perilink {
namespace {

using test::box_mesh;

/// The cells of a box mesh whose centre is wanted.
Body carved(int dim, int count, const std::function<bool(const Vector3&)>& wanted) {
  const Mesh mesh = box_mesh(dim, count);
  std::vector<Index> material;
  for (Index cell = 0; cell < mesh.num_cells(); ++cell) {
    Vector3 centre{};
    for (int k = 0; k <= dim; ++k) {
      const Vector3 x = point_of(mesh.positions, dim, mesh.cells[cell * (dim + 1) + k]);
      for (int axis = 0; axis < dim; ++axis) centre[axis] += x[axis] / (dim + 1);
    }
    material.push_back(wanted(centre) ? 0 : no_index);
  }
  return make_mesh_body(mesh, material, 1.0);
}

Bonds remaining(const Body& body, double horizon) {
  Bonds bonds = make_bonds(body.particles, horizon);
  remove_bonds_outside(body.particles, bonds, body.facets, body.lattice.spacing);
  return bonds;
}

/// Greatest distance from the cells among many points of the segment, by looking at every cell:
/// barycentric coordinates say whether it holds the point; a point outside is as far away as the
/// nearest facet.
double excursion(const Body& body, const Vector3& from, const Vector3& to) {
  double greatest = 0.0;
  for (int station = 1; station < 40; ++station) {
    const Vector3 x = between(from, to, station / 40.0);
    bool inside = false;
    for (Index cell = 0; cell < body.cells.size() && !inside; ++cell) {
      const auto corners = body.cells.cell(cell);
      const auto corner = [&](int k) { return point_of(body.particles.positions, 2, corners[k]); };
      inside = true;
      for (int k = 0; k < 3; ++k) {
        inside =
            inside && cross(minus(corner((k + 1) % 3), corner(k)), minus(x, corner(k)))[2] > -1e-12;
      }
    }
    if (inside) continue;
    double nearest = 1e9;
    for (Index f = 0; f < body.facets.size(); ++f) {
      const FacetGeometry facet = facet_geometry(body.particles, body.facets, f);
      nearest = std::min(nearest, norm(minus(x, nearest_point(facet, x))));
    }
    greatest = std::max(greatest, nearest);
  }
  return greatest;
}

TEST(OutsideBonds, ConvexBodiesKeepAllBonds) {
  for (const int dim : {2, 3}) {
    const Body body = carved(dim, 4, [](const Vector3&) { return true; });
    Bonds bonds = make_bonds(body.particles, 3.0 * body.lattice.spacing);
    const Index before = bonds.size();
    EXPECT_EQ(remove_bonds_outside(body.particles, bonds, body.facets, body.lattice.spacing), 0);
    EXPECT_EQ(bonds.size(), before);
  }
}

TEST(OutsideBonds, AgreeWithALookAtEveryCell) {
  // An L and a square with a square hole, their inner sides a little uneven.
  for (const auto& wanted :
       {std::function([](const Vector3& x) { return x[0] < 0.5 || x[1] < 0.5; }),
        std::function([](const Vector3& x) {
          return std::max(std::abs(x[0] - 0.5), std::abs(x[1] - 0.5)) > 0.2;
        })}) {
    const Body body = carved(2, 10, wanted);
    const double spacing = body.lattice.spacing;
    const Bonds all = make_bonds(body.particles, 3.0 * spacing);
    const Bonds kept = remaining(body, 3.0 * spacing);
    std::set<std::pair<Index, Index>> pairs;
    for (Index b = 0; b < kept.size(); ++b) pairs.emplace(kept.first[b], kept.second[b]);
    Index judged = 0, removed = 0;
    for (Index b = 0; b < all.size(); ++b) {
      const double way = excursion(body, point_of(body.particles.positions, 2, all.first[b]),
                                   point_of(body.particles.positions, 2, all.second[b])) /
                         spacing;
      const bool is_kept = pairs.count({all.first[b], all.second[b]}) > 0;
      // Both look at points only: near the limit they may differ.
      if (way > 0.8 * allowed_excursion && way < 1.25 * allowed_excursion) continue;
      ++judged;
      removed += way > allowed_excursion;
      EXPECT_EQ(is_kept, way < allowed_excursion)
          << all.first[b] << " " << all.second[b] << " " << way;
    }
    EXPECT_GT(removed, 10);
    EXPECT_GT(judged, 1000);
  }
}

/// A strip with a slit of width 2e-3 spacings from the left to the middle.
Body slit() {
  Mesh mesh;
  const int columns = 8;
  const double width = 2e-3;
  for (const double y : {0.0, 1.0, 1.0 + width, 2.0 + width}) {
    for (int i = 0; i <= columns; ++i) mesh.positions.insert(mesh.positions.end(), {1.0 * i, y});
  }
  const auto at = [](int i, int row) { return row * (columns + 1) + i; };
  for (const int row : {0, 1, 2}) {
    for (int i = row == 1 ? columns / 2 : 0; i < columns; ++i) {
      mesh.cells.insert(mesh.cells.end(), {at(i, row), at(i + 1, row), at(i + 1, row + 1)});
      mesh.cells.insert(mesh.cells.end(), {at(i, row), at(i + 1, row + 1), at(i, row + 1)});
    }
  }
  return make_mesh_body(mesh, std::vector<Index>(mesh.num_cells(), 0), 1.0);
}

TEST(OutsideBonds, NoBondCrossesANarrowSlit) {
  const Body body = slit();
  const Bonds bonds = remaining(body, 3.1);
  Index beside = 0;
  for (Index b = 0; b < bonds.size(); ++b) {
    const Vector3 from = point_of(body.particles.positions, 2, bonds.first[b]);
    const Vector3 to = point_of(body.particles.positions, 2, bonds.second[b]);
    if ((from[1] < 1.001) == (to[1] < 1.001)) {
      beside += from[0] < 4.0 && to[0] < 4.0;
      continue;
    }
    // Along a flank and through the blunt end of the slit a bond may go; it leaves by the width.
    if (std::abs(to[1] - from[1]) < 0.1 && std::max(from[0], to[0]) > 4.0) continue;
    // All others pass the middle of the slit's height right of its end.
    const double x = from[0] + (to[0] - from[0]) * (1.001 - from[1]) / (to[1] - from[1]);
    EXPECT_GE(x, 4.0 - 2e-3);
  }
  EXPECT_GT(beside, 50) << "bonds along the flanks stay";
}

TEST(OutsideBonds, SidesOfAFineHoleKeepTheirChords) {
  // A ring of one layer of cells inside radius 1 at the hole: chords of k sides leave it by
  // 1 - cos(k pi / n).
  const int n = 48;
  Mesh mesh;
  for (const double radius : {1.0, 1.0 + 2.0 * std::numbers::pi / n}) {
    for (int i = 0; i < n; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / n;
      mesh.positions.insert(mesh.positions.end(),
                            {radius * std::cos(angle), radius * std::sin(angle)});
    }
  }
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    mesh.cells.insert(mesh.cells.end(), {i, i + n, next + n, i, next + n, next});
  }
  const Body body = make_mesh_body(mesh, std::vector<Index>(mesh.num_cells(), 0), 1.0);
  const double side = 2.0 * std::sin(std::numbers::pi / n);
  const Bonds bonds = remaining(body, 4.5 * side);
  std::vector<Index> count(6, 0);
  for (Index b = 0; b < bonds.size(); ++b) {
    if (bonds.second[b] >= n) continue;  // not both at the hole
    const Index apart = bonds.second[b] - bonds.first[b];
    ++count[std::min(apart, n - apart)];
  }
  for (int sides = 1; sides <= 4; ++sides) {
    // The deepest point lies above a vertex or above the middle of a side.
    const double depth = std::cos(sides % 2 == 0 ? 0.0 : std::numbers::pi / n) -
                         std::cos(sides * std::numbers::pi / n);
    EXPECT_EQ(count[sides], depth <= allowed_excursion * body.lattice.spacing ? n : 0) << sides;
  }
  EXPECT_EQ(count[1], n);
  EXPECT_EQ(count[4], 0);
}

TEST(OutsideBonds, NoBondCrossesTheVoidOfAHollowCube) {
  const Body body = carved(3, 6, [](const Vector3& x) {
    return std::max({std::abs(x[0] - 0.5), std::abs(x[1] - 0.5), std::abs(x[2] - 0.5)}) > 1.0 / 6.0;
  });
  const Bonds all = make_bonds(body.particles, 0.6);
  const Bonds bonds = remaining(body, 0.6);
  EXPECT_LT(bonds.size(), all.size());
  for (Index b = 0; b < bonds.size(); ++b) {
    const Vector3 from = point_of(body.particles.positions, 3, bonds.first[b]);
    const Vector3 to = point_of(body.particles.positions, 3, bonds.second[b]);
    for (int station = 1; station < 20; ++station) {
      const Vector3 x = between(from, to, station / 20.0);
      // The flanks of the void are moved by a tenth of a step; what lies deeper is outside.
      const double inward =
          std::max({std::abs(x[0] - 0.5), std::abs(x[1] - 0.5), std::abs(x[2] - 0.5)});
      EXPECT_GT(inward, 1.0 / 6.0 - 0.1 / 6.0 - allowed_excursion * body.lattice.spacing);
    }
  }
}

}  // namespace
}  // namespace perilink

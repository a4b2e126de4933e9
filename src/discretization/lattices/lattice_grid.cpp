#include "discretization/lattices/lattice_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "discretization/lattices/lattice_parts.hpp"

namespace perilink {
Index LatticeGrid::number(const GridWindow& window, const GridPoint& point) const {
  // How many of `count` consecutive numbers are even; the first is even (odd = 0) or odd (odd = 1).
  const auto evens = [&](Index count, Index odd) {
    return alternate ? (count + 1 - odd) / 2 : count;
  };
  const Index columns = window.last[0] - window.first[0] + 1;
  const Index rows = window.last[1] - window.first[1] + 1;
  const auto in_rows = [&](Index count, Index odd) {
    const Index even = evens(count, odd);
    return even * evens(columns, 0) + (count - even) * evens(columns, 1);
  };
  const Index layers = point[2] - window.first[2], before = point[1] - window.first[1];
  Index odd = (window.first[0] + window.first[1] + window.first[2]) % 2;
  const Index even_layers = evens(layers, odd);
  Index number = even_layers * in_rows(rows, 0) + (layers - even_layers) * in_rows(rows, 1);
  odd = (odd + layers) % 2;
  number += in_rows(before, odd);
  odd = (odd + before) % 2;
  return number + evens(point[0] - window.first[0], odd);
}

Vector3 LatticeGrid::position(const GridPoint& point) const {
  Vector3 x{};
  for (int a = 0; a < dim; ++a) {
    x[a] = point[a] == count[a] ? upper[a] : lower[a] + step[a] * point[a];
  }
  return x;
}

std::optional<LatticeGrid> grid_of(const Body& body) {
  const Particles& particles = body.particles;
  const Lattice& lattice = body.lattice;
  const bool fits = lattice.pattern == Pattern::rectangular || lattice.pattern == Pattern::cubic ||
                    lattice.pattern == Pattern::face_centred;
  if (!fits || lattice.surface == Surface::ghost || particles.size() == 0) return std::nullopt;
  LatticeGrid grid;
  grid.dim = particles.dim;
  grid.spacing = lattice.spacing;
  grid.alternate = lattice.pattern == Pattern::face_centred;
  for (int a = 0; a < grid.dim; ++a) {
    grid.lower[a] = grid.upper[a] = particles.position(0)[a];
    for (Index i = 0; i < particles.size(); ++i) {
      grid.lower[a] = std::min(grid.lower[a], particles.position(i)[a]);
      grid.upper[a] = std::max(grid.upper[a], particles.position(i)[a]);
    }
    grid.step[a] = lattice.step[a];
    grid.count[a] = static_cast<Index>(std::lround((grid.upper[a] - grid.lower[a]) / grid.step[a]));
  }
  if (grid.size(grid.all()) != particles.size()) return std::nullopt;
  // The body must fill all cells; round-off is far smaller than the half cell that may be missing.
  double cells = grid.alternate ? 0.5 : 1.0;
  for (int a = 0; a < grid.dim; ++a) cells *= grid.count[a];
  const double filled = std::accumulate(particles.volumes.begin(), particles.volumes.end(), 0.0);
  if (std::abs(filled / lattice.cell_volume - cells) > 0.1) return std::nullopt;
  bool same = true;
  Index i = 0;
  grid.for_each(grid.all(), [&](const GridPoint& point) {
    const Vector3 x = grid.position(point);
    same = same && std::equal(x.begin(), x.begin() + grid.dim, particles.position(i).begin());
    ++i;
  });
  return same ? std::optional(grid) : std::nullopt;
}

Body body_of(const LatticeGrid& grid, const Lattice& lattice, double thickness) {
  LatticeInput input;
  input.pattern = lattice.pattern;
  input.surface = lattice.surface;
  input.spacing = lattice.spacing;
  input.thickness = thickness;
  input.solid = {{grid.lower, grid.upper}};
  input.material = {0};
  const Outline outline =
      make_outline(input.solid, grid.dim, input.boundary_tolerance * input.spacing);
  Body body;
  body.lattice = lattice;
  body.particles = fill_conforming_grid(input, lattice, outline);
  body.facets = grid_facets(input, lattice, outline, body.particles);
  return body;
}

}  // namespace perilink

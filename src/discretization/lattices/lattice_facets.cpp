#include <array>
#include <vector>

#include "discretization/lattices/lattice_parts.hpp"

namespace perilink {
namespace {

/// Grid of a conforming lattice: materials of its cells and particles at its points.
class CellGrid {
 public:
  CellGrid(const LatticeInput& input, const Lattice& lattice, const Box& bounds,
           const Particles& particles)
      : dim_(lattice.dim),
        steps_(count_steps(lattice, bounds)),
        points_(lattice, bounds, particles) {
    if (dim_ == 2) steps_[2] = 1;  // one layer of cells
    for (Index k = 0; k < steps_[2]; ++k) {
      for (Index j = 0; j < steps_[1]; ++j) {
        for (Index i = 0; i < steps_[0]; ++i) {
          materials_.push_back(cell_material(input, lattice, bounds, {i, j, k}));
        }
      }
    }
  }

  const std::array<Index, 3>& steps() const { return steps_; }

  /// Returns the material of a cell, no_index outside the body.
  Index material(const std::array<Index, 3>& cell) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (cell[axis] < 0 || cell[axis] >= steps_[axis]) return no_index;
    }
    return materials_[cell[0] + static_cast<std::size_t>(steps_[0]) *
                                    (cell[1] + static_cast<std::size_t>(steps_[1]) * cell[2])];
  }

  /// Returns particles at the corners of the face below a cell along an axis.
  std::vector<Index> corners(const std::array<Index, 3>& cell, int axis) const {
    std::vector<Index> found;
    const int y = (axis + 1) % dim_;
    for (int b = 0; b < (dim_ == 3 ? 2 : 1); ++b) {
      for (int a = 0; a < 2; ++a) {
        std::array<Index, 3> point = cell;
        point[y] += b ? 1 - a : a;  // around the face, not along its diagonal
        if (dim_ == 3) point[(axis + 2) % 3] += b;
        if (points_.particle(point) != no_index) found.push_back(points_.particle(point));
      }
    }
    return found;
  }

 private:
  int dim_;
  std::array<Index, 3> steps_;
  PointGrid points_;
  std::vector<Index> materials_;  // per cell, x fastest
};

}  // namespace

Facets grid_facets(const LatticeInput& input, const Lattice& lattice, const Outline& outline,
                   const Particles& particles) {
  const CellGrid grid(input, lattice, outline.bounds, particles);
  Facets facets;
  facets.dim = lattice.dim;
  for (int axis = 0; axis < lattice.dim; ++axis) {
    double area = lattice.dim == 2 ? input.thickness : 1.0;
    for (int other = 0; other < lattice.dim; ++other) {
      if (other != axis) area *= lattice.step[other];
    }
    const std::array<Index, 3>& steps = grid.steps();
    std::array<Index, 3> last = {steps[0] - 1, steps[1] - 1, steps[2] - 1};
    ++last[axis];
    std::array<Index, 3> cell{};
    for (cell[2] = 0; cell[2] <= last[2]; ++cell[2]) {
      for (cell[1] = 0; cell[1] <= last[1]; ++cell[1]) {
        for (cell[0] = 0; cell[0] <= last[0]; ++cell[0]) {
          std::array<Index, 3> below = cell;
          --below[axis];
          const Index above_material = grid.material(cell);
          const Index below_material = grid.material(below);
          if (above_material == below_material) continue;
          Vector3 normal{};
          const bool upward = above_material == no_index ||
                              (below_material != no_index && below_material < above_material);
          normal[axis] = upward ? area : -area;
          facets.append(grid.corners(cell, axis), normal, upward ? below_material : above_material,
                        upward ? above_material : below_material);
        }
      }
    }
  }
  return facets;
}

}  // namespace perilink

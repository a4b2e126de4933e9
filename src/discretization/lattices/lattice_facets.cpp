#include <array>
#include <vector>

#include "discretization/lattices/lattice_parts.hpp"

namespace perilink {
namespace {

/// The grid of a conforming lattice: cells with their materials and points with their particles.
class Grid {
 public:
  Grid(const LatticeInput& input, const Lattice& lattice, const Outline& outline)
      : lattice_(lattice), steps_(count_steps(lattice, outline.bounds)) {
    if (lattice.dim == 2) steps_[2] = 1;  // one layer of cells
    for (Index k = 0; k < steps_[2]; ++k) {
      for (Index j = 0; j < steps_[1]; ++j) {
        for (Index i = 0; i < steps_[0]; ++i) {
          const Box& box = outline.bounds;
          const Vector3 centre = {box.lower[0] + (i + 0.5) * lattice.step[0],
                                  box.lower[1] + (j + 0.5) * lattice.step[1],
                                  box.lower[2] + (k + 0.5) * lattice.step[2]};
          materials_.push_back(
              material_at(input, {centre.data(), static_cast<std::size_t>(lattice.dim)}));
        }
      }
    }
    number_particles();
  }

  const std::array<Index, 3>& steps() const { return steps_; }

  /// Material of a cell, no_index outside the body.
  Index material(const std::array<Index, 3>& cell) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (cell[axis] < 0 || cell[axis] >= steps_[axis]) return no_index;
    }
    return materials_[cell[0] + static_cast<std::size_t>(steps_[0]) *
                                    (cell[1] + static_cast<std::size_t>(steps_[1]) * cell[2])];
  }

  /// Particles at the corners of the face below a cell along an axis.
  std::vector<Index> corners(const std::array<Index, 3>& cell, int axis) const {
    std::vector<Index> found;
    const int y = (axis + 1) % lattice_.dim;
    for (int b = 0; b < (lattice_.dim == 3 ? 2 : 1); ++b) {
      for (int a = 0; a < 2; ++a) {
        std::array<Index, 3> point = cell;
        point[y] += b ? 1 - a : a;  // around the face, not across
        if (lattice_.dim == 3) point[(axis + 2) % 3] += b;
        if (!is_particle(point)) continue;
        found.push_back(particles_[slot(point)]);
      }
    }
    return found;
  }

 private:
  bool is_particle(const std::array<Index, 3>& point) const {
    return lattice_.pattern != Pattern::face_centred || (point[0] + point[1] + point[2]) % 2 == 0;
  }
  std::size_t slot(const std::array<Index, 3>& point) const {
    return point[0] + static_cast<std::size_t>(steps_[0] + 1) *
                          (point[1] + static_cast<std::size_t>(steps_[1] + 1) * point[2]);
  }

  /// In the order of fill_conforming_grid: the points at the corners of solid cells, x fastest.
  void number_particles() {
    const Index layers = lattice_.dim == 3 ? steps_[2] : 0;
    particles_.assign(static_cast<std::size_t>(steps_[0] + 1) * (steps_[1] + 1) * (layers + 1),
                      no_index);
    Index count = 0;
    for (Index k = 0; k <= layers; ++k) {
      for (Index j = 0; j <= steps_[1]; ++j) {
        for (Index i = 0; i <= steps_[0]; ++i) {
          if (is_particle({i, j, k}) && touches_solid(i, j, k)) {
            particles_[slot({i, j, k})] = count++;
          }
        }
      }
    }
  }

  bool touches_solid(Index i, Index j, Index k) const {
    for (int corner = 0; corner < (lattice_.dim == 3 ? 8 : 4); ++corner) {
      const Index layer = lattice_.dim == 3 ? k - (corner >> 2) : 0;
      if (material({i - (corner & 1), j - ((corner >> 1) & 1), layer}) != no_index) return true;
    }
    return false;
  }

  const Lattice& lattice_;
  std::array<Index, 3> steps_;
  std::vector<Index> materials_;  // per cell, x fastest
  std::vector<Index> particles_;  // at the points, x fastest
};

}  // namespace

Facets grid_facets(const LatticeInput& input, const Lattice& lattice, const Outline& outline) {
  const Grid grid(input, lattice, outline);
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

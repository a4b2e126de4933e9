#include <array>
#include <vector>

#include "discretization/lattices/lattice_parts.hpp"

namespace perilink {
namespace {

/// Point of a hexagonal lattice in units of half a column; rows are counted from the bottom. Even
/// rows use the even numbers 0, 2, …, 2n. Odd rows use the odd numbers, and even numbers at
/// vertical sides of the body that end the row.
struct HalfColumn {
  Index row;
  Index number;
};

class HexagonalCells {
 public:
  HexagonalCells(const LatticeInput& input, const Lattice& lattice, const Box& bounds)
      : input_(input),
        lattice_(lattice),
        bounds_(bounds),
        columns_(count_steps(lattice, bounds)[0]),
        rows_(count_steps(lattice, bounds)[1]),
        volumes_(static_cast<std::size_t>(rows_ + 1) * stride(), 0.0) {
    for (Index row = 0; row < rows_; ++row) share_strip(row);
  }

  Index rows() const { return rows_; }
  Index stride() const { return 2 * columns_ + 1; }
  double volume(HalfColumn point) const { return volumes_[slot(point)]; }
  /// Returns triangles of the particles, numbered without points that have no volume.
  Simplices triangles() const {
    std::vector<Index> number(volumes_.size(), no_index);
    Index count = 0;
    for (std::size_t k = 0; k < volumes_.size(); ++k) {
      if (volumes_[k] != 0.0) number[k] = count++;
    }
    Simplices cells;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const auto& [a, b, c] = triangles_[t];
      const Vector3 x = position(a), y = position(b), z = position(c);
      const bool turned = (y[0] - x[0]) * (z[1] - x[1]) < (z[0] - x[0]) * (y[1] - x[1]);
      for (const HalfColumn& point : {a, turned ? c : b, turned ? b : c}) {
        cells.vertices.push_back(number[slot(point)]);
      }
      cells.material.push_back(materials_[t]);
    }
    return cells;
  }

  Vector3 position(HalfColumn point) const {
    const double x = point.number == 2 * columns_
                         ? bounds_.upper[0]
                         : bounds_.lower[0] + 0.5 * lattice_.step[0] * point.number;
    return {x, plane(bounds_, lattice_, 1, point.row, rows_), 0.0};
  }

 private:
  std::size_t slot(HalfColumn point) const {
    return static_cast<std::size_t>(point.row) * stride() + point.number;
  }

  bool in_grid(HalfColumn point) const { return point.number >= 0 && point.number <= 2 * columns_; }

  Index material_of(const std::array<HalfColumn, 3>& triangle) const {
    Vector3 centroid{};
    for (const HalfColumn point : triangle) {
      if (!in_grid(point)) return no_index;
      const Vector3 vertex = position(point);
      for (int axis = 0; axis < 2; ++axis) centroid[axis] += vertex[axis] / 3.0;
    }
    return material_at(input_, {centroid.data(), 2});
  }

  bool is_solid(const std::array<HalfColumn, 3>& triangle) const {
    return material_of(triangle) != no_index;
  }

  void share(const std::array<HalfColumn, 3>& triangle, double area) {
    for (const HalfColumn point : triangle) {
      volumes_[slot(point)] += area * input_.thickness / 3.0;
    }
    triangles_.push_back(triangle);
    materials_.push_back(material_of(triangle));
  }

  /// Adds the triangles between two rows. Triangles with their base on the even row lie between
  /// columns. Triangles with their base on the odd row straddle a column. At a vertical side only
  /// half of such a triangle counts, with a particle at its right angle.
  void share_strip(Index lower_row) {
    const Index even = lower_row % 2 == 0 ? lower_row : lower_row + 1;
    const Index odd = lower_row % 2 == 0 ? lower_row + 1 : lower_row;
    const double area = 0.5 * lattice_.step[0] * lattice_.step[1];
    for (Index column = 0; column <= columns_; ++column) {
      const HalfColumn apex{even, 2 * column};
      const HalfColumn foot{odd, 2 * column};
      const HalfColumn left{odd, 2 * column - 1};
      const HalfColumn right{odd, 2 * column + 1};
      const bool left_half = is_solid({foot, left, apex});
      const bool right_half = is_solid({foot, right, apex});
      if (left_half && right_half) {
        share({left, right, apex}, area);
      } else if (left_half) {
        share({foot, left, apex}, 0.5 * area);
      } else if (right_half) {
        share({foot, right, apex}, 0.5 * area);
      }
      if (column == columns_) continue;
      const HalfColumn next{even, 2 * column + 2};
      if (is_solid({apex, next, right})) share({apex, next, right}, area);
    }
  }

  const LatticeInput& input_;
  const Lattice& lattice_;
  const Box& bounds_;
  Index columns_;
  Index rows_;
  std::vector<double> volumes_;
  std::vector<std::array<HalfColumn, 3>> triangles_;
  std::vector<Index> materials_;  // per triangle
};

}  // namespace

Particles fill_conforming_hexagonal(const LatticeInput& input, const Lattice& lattice,
                                    const Outline& outline, Simplices& triangles) {
  const HexagonalCells cells(input, lattice, outline.bounds);
  triangles = cells.triangles();
  Particles particles;
  particles.dim = 2;
  for (Index row = 0; row <= cells.rows(); ++row) {
    for (Index number = 0; number < cells.stride(); ++number) {
      const double volume = cells.volume({row, number});
      if (volume == 0.0) continue;
      const Vector3 position = cells.position({row, number});
      add_particle(particles, position, volume, material_at(input, {position.data(), 2}),
                   ParticleKind::solid);
    }
  }
  return particles;
}

}  // namespace perilink

#include <initializer_list>
#include <vector>

#include "discretization/lattice_parts.hpp"

namespace perilink {
namespace {

/// Points of a hexagonal lattice in units of half a column, rows from the bottom. Even rows use the
/// even numbers 0, 2, …, 2n. Odd rows use the odd numbers, and the even ones where a vertical side
/// of the body ends the row.
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

  bool is_solid(std::initializer_list<HalfColumn> triangle) const {
    Vector3 centroid{};
    for (const HalfColumn point : triangle) {
      if (!in_grid(point)) return false;
      const Vector3 vertex = position(point);
      for (int axis = 0; axis < 2; ++axis) centroid[axis] += vertex[axis] / 3.0;
    }
    return material_at(input_, {centroid.data(), 2}) != no_index;
  }

  void share(std::initializer_list<HalfColumn> triangle, double area) {
    for (const HalfColumn point : triangle) {
      volumes_[slot(point)] += area * input_.thickness / 3.0;
    }
  }

  /// Triangles between two rows. Those that stand on the even row lie between columns. Those that
  /// stand on the odd row straddle a column: where a side of the body runs there, only half of the
  /// triangle counts, and its right angle is a particle of its own.
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
};

}  // namespace

Particles fill_conforming_hexagonal(const LatticeInput& input, const Lattice& lattice,
                                    const Outline& outline) {
  const HexagonalCells cells(input, lattice, outline.bounds);
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

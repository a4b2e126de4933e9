#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "calibration/bounded_least_squares/equations/point_equations.hpp"

namespace perilink {

/// Calls part(point, from, to, sign) for all rows on which a variable acts: [from, to) of a point,
/// with its coefficients times the sign. One-ended variables do not act on the rows of groups.
template <class Part>
void for_each_part(const PointEquations& equations, Index variable, Part part) {
  const Index p = equations.first[variable], q = equations.second[variable];
  const int own = equations.own_rows();
  part(p, 0, own, 1.0);
  part(q, 0, equations.odd, -1.0);
  if (variable >= equations.one_ended) return;
  part(q, equations.odd, own, 1.0);
  if (own == equations.rows) return;
  part(equations.group[p], own, equations.rows, 1.0);
  part(equations.group[q], own, equations.rows, 1.0);
}

/// Scales the last row of every group to the length one, so that a ridge has equal weight in large
/// and small groups. Switches off rows without variables.
inline void scale_last_rows(PointEquations& equations) {
  const std::size_t rows = static_cast<std::size_t>(equations.rows);
  std::vector<double> square(equations.group.size(), 0.0);
  for (Index v = 0; v < std::min(equations.num_variables(), equations.one_ended); ++v) {
    const double a = equations.coefficients[(v + 1) * rows - 1];
    const Index p = equations.group[equations.first[v]];
    const Index q = equations.group[equations.second[v]];
    square[p] += p == q ? 4.0 * a * a : a * a;
    if (p != q) square[q] += a * a;
  }
  for (std::size_t p = 0; p < square.size(); ++p) {
    equations.scale[(p + 1) * rows - 1] = square[p] > 0.0 ? 1.0 / std::sqrt(square[p]) : 0.0;
  }
}

/// A column of the equations by its blocks. A variable acts on at most four points.
template <class Vector>
struct ColumnBlocks {
  std::array<Index, 4> keys;
  std::array<Vector, 4> blocks;
  int count = 0;

  /// Returns the block of a point or subdomain, zero at first.
  Vector& of(Index key) {
    for (int k = 0; k < count; ++k) {
      if (keys[k] == key) return blocks[k];
    }
    keys[count] = key;
    blocks[count].setZero();
    return blocks[count++];
  }
};

/// Adds the scaled coefficients of a variable to its column.
template <class Vector>
void gather_column(const PointEquations& equations, Index variable, ColumnBlocks<Vector>& column) {
  const std::size_t rows = static_cast<std::size_t>(equations.rows);
  const double* a = equations.coefficients.data() + variable * rows;
  column.count = 0;
  for_each_part(equations, variable, [&](Index p, int from, int to, double sign) {
    Vector& part = column.of(p);
    for (int r = from; r < to; ++r) part[r] += sign * a[r] * equations.scale[p * rows + r];
  });
}

/// Calls visit with the number of rows as a compile-time constant for numbers of bodies in space,
/// else with -1 (Eigen::Dynamic).
template <class Visit>
void with_rows(int rows, Visit visit) {
  switch (rows) {
    case 10: return visit(std::integral_constant<int, 10>());
    case 11: return visit(std::integral_constant<int, 11>());
    case 18: return visit(std::integral_constant<int, 18>());
    case 19: return visit(std::integral_constant<int, 19>());
    default: return visit(std::integral_constant<int, -1>());
  }
}

}  // namespace perilink

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/block.hpp"
#include "calibration/bounded_least_squares/equations/point_equations.hpp"

namespace perilink {

/// Product A D A' of bodies in space without moments, for the steps of conjugate gradients.
/// Coefficients have single precision, multipliers double precision. Points are sorted so that
/// neighbours are close in memory. Each thread has one part of the order. A variable between two
/// parts is stored in both, so that sums have one order for any number of threads.
class PackedProduct {
 public:
  /// Whether each point has ten equations of forces, with or without one of a group, and every
  /// variable is a separate unknown.
  static bool serves(const PointEquations& equations) {
    return equations.odd == odd && equations.own_rows() == odd && equations.unknown.empty();
  }

  explicit PackedProduct(const PointEquations& equations);

  /// \param active_weight  D, per variable
  void set(std::span<const double> active_weight);

  /// Computes result = A D A' y, both of shape (points, rows).
  void apply(std::span<const double> y, std::span<double> result);

  /// Returns the blocks of the single points of A D A', shape (points, rows, rows).
  std::vector<double> blocks() const;

 private:
  static constexpr int odd = 10;
  /// Numbers per point: ten forces, the row of its group, and one unused.
  static constexpr std::size_t width = 12;
  /// Position of the active-set weight of a variable: the unused number.
  static constexpr std::size_t weight = 11;

  void order_points();
  void pack();
  void multiply(std::size_t part);
  void add_blocks(std::size_t part, double* sums) const;
  void add_last_rows(std::vector<double>& blocks) const;
  template <class Visit>
  void for_each_row(Index variable, Visit visit) const;

  const PointEquations& equations_;
  /// Scale of every row: the scale of its equation times a power of two. The power of two keeps
  /// the coefficients in the range of single precision in any units.
  std::vector<double> scale_;
  double unit_ = 1.0;
  std::vector<Index> place_, point_;   // position of a point in the order, and its inverse
  std::vector<std::size_t> part_end_;  // end of each part in the order
  std::vector<std::size_t> begin_;     // two rows per position: variables to later positions of its
                                       // part, and to other parts
  BlockVector<float> coefficients_;    // shape (row entries, width)
  std::vector<std::int32_t> other_;    // position of the other end
  std::vector<Index> variable_;
  BlockVector<double> values_, sums_;  // shape (places, width)
};

}  // namespace perilink

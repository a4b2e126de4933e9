#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/block.hpp"
#include "calibration/bounded_least_squares/equations/point_equations.hpp"

namespace perilink {

/// A D A' of bodies in space whose bonds carry no moments, for the steps of conjugate gradients:
/// coefficients have the seven digits of single precision, multipliers all of theirs. Points come
/// in an order in which neighbours are near each other. Threads take one part of the order each; a
/// variable between two parts is there twice, for the sum at either end, so that sums have one
/// order for any number of threads.
class PackedProduct {
 public:
  /// Whether the equations are ten of forces at each point, with or without that of a group, and
  /// every variable is an unknown of its own.
  static bool serves(const PointEquations& equations) {
    return equations.odd == odd && equations.own_rows() == odd && equations.unknown.empty();
  }

  explicit PackedProduct(const PointEquations& equations);

  /// \param active_weight  D, per variable
  void set(std::span<const double> active_weight);

  /// result = A D A' y, both of shape (points, rows).
  void apply(std::span<const double> y, std::span<double> result);

  /// Blocks of the single points of A D A', shape (points, rows, rows).
  std::vector<double> blocks() const;

 private:
  static constexpr int odd = 10;
  /// Numbers of a point: ten forces, that of its group, and one that is nothing.
  static constexpr std::size_t width = 12;
  /// Place of the active-set weight of a variable, in place of the unused number.
  static constexpr std::size_t weight = 11;

  void order_points();
  void pack();
  void multiply(std::size_t part);
  void add_blocks(std::size_t part, double* sums) const;
  void add_last_rows(std::vector<double>& blocks) const;
  template <class Visit>
  void for_each_row(Index variable, Visit visit) const;

  const PointEquations& equations_;
  /// By which numbers of points count: those of the equations times a power of two, over which
  /// coefficients have sizes that single precision holds in any units.
  std::vector<double> scale_;
  double unit_ = 1.0;
  std::vector<Index> place_, point_;   // where a point comes in the order, and back
  std::vector<std::size_t> part_end_;  // places up to which each part goes
  std::vector<std::size_t> begin_;     // two rows for each place: to places behind it in its part,
                                       // and to those of other parts
  BlockVector<float> coefficients_;    // shape (row entries, width)
  std::vector<std::int32_t> other_;    // place of the other end
  std::vector<Index> variable_;
  BlockVector<double> values_, sums_;  // shape (places, width)
};

}  // namespace perilink

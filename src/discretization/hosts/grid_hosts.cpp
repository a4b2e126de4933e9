#include <algorithm>
#include <cmath>

#include "discretization/hosts/fill_hosts.hpp"

namespace perilink {
namespace {

/// Cells of a grid, numbered along x first. An axis with one plane is not divided: cells have no
/// extent along it, and one layer of nodes.
class Grid {
 public:
  Grid(int dim, const Divisions& divisions, int order, double tolerance)
      : dim_(dim), divisions_(divisions), order_(order), tolerance_(tolerance) {}

  Index size() const {
    Index count = 1;
    for (int a = 0; a < dim_; ++a) count *= intervals(a);
    return count;
  }
  Index num_nodes() const {
    Index count = 1;
    for (int a = 0; a < dim_; ++a) count *= order(a) * intervals(a) + 1;
    return count;
  }
  int dim() const { return dim_; }
  /// Returns the number of nodes in a cell; they are numbered along x first.
  int nodes_per_cell() const { return (order(0) + 1) * (order(1) + 1) * (order(2) + 1); }

  /// Calls visit(cell) for every cell that contains the point, borders included.
  template <class Visit>
  void for_each_around(std::span<const double> point, Visit visit) const {
    std::array<Index, 3> lowest{}, highest{};
    for (int a = 0; a < dim_; ++a) {
      lowest[a] = interval(a, point[a] - tolerance_);
      highest[a] = interval(a, point[a] + tolerance_);
    }
    std::array<Index, 3> at{};
    for (at[2] = lowest[2]; at[2] <= highest[2]; ++at[2]) {
      for (at[1] = lowest[1]; at[1] <= highest[1]; ++at[1]) {
        for (at[0] = lowest[0]; at[0] <= highest[0]; ++at[0]) visit(number(at));
      }
    }
  }

  /// Returns whether a point of the cell is farther than the tolerance from its border.
  bool is_within(Index cell, std::span<const double> point) const {
    const std::array<Index, 3> at = place(cell);
    for (int a = 0; a < dim_; ++a) {
      if (order(a) == 0) continue;
      if (point[a] <= divisions_[a][at[a]] + tolerance_) return false;
      if (point[a] >= divisions_[a][at[a] + 1] - tolerance_) return false;
    }
    return true;
  }

  /// Returns the number of a cell's node in the grid of all nodes.
  Index node(Index cell, int local) const {
    const std::array<Index, 3> at = place(cell), in = place_in_cell(local);
    Index result = 0;
    for (int a = dim_ - 1; a >= 0; --a) {
      result = result * (order(a) * intervals(a) + 1) + order(a) * at[a] + in[a];
    }
    return result;
  }

  double lower(Index cell, int axis) const { return divisions_[axis][place(cell)[axis]]; }
  double upper(Index cell, int axis) const {
    return divisions_[axis][place(cell)[axis] + (order(axis) > 0 ? 1 : 0)];
  }

  int num_corners() const {
    return (order(0) > 0 ? 2 : 1) * (order(1) > 0 ? 2 : 1) * (order(2) > 0 ? 2 : 1);
  }
  /// Returns the node of a cell at a corner; corners run around the lower face along the last axis,
  /// then around the upper one.
  int corner(int number) const {
    constexpr std::array<unsigned, 8> around = {0, 1, 3, 2, 4, 5, 7, 6};  // bit a: end along axis a
    int local = 0;
    for (int a = dim_ - 1; a >= 0; --a) {
      local = local * (order(a) + 1) + ((around[number] >> a & 1U) != 0 ? order(a) : 0);
    }
    return local;
  }

  double coordinate(Index cell, int local, int axis) const {
    if (order(axis) == 0) return lower(cell, axis);
    const double part = static_cast<double>(place_in_cell(local)[axis]) / order_;
    return lower(cell, axis) + part * (upper(cell, axis) - lower(cell, axis));
  }

  /// Returns the shape function of a node at a point of the cell: product of Lagrange polynomials.
  double weight(Index cell, int local, std::span<const double> point) const {
    const std::array<Index, 3> in = place_in_cell(local);
    double product = 1.0;
    for (int a = 0; a < dim_; ++a) {
      if (order(a) == 0) continue;
      const double part = (point[a] - lower(cell, a)) / (upper(cell, a) - lower(cell, a));
      const double x = order_ * std::clamp(part, 0.0, 1.0);
      for (int k = 0; k <= order_; ++k) {
        if (k != in[a]) product *= (x - k) / static_cast<double>(in[a] - k);
      }
    }
    return product;
  }

 private:
  /// Returns the degree of the polynomials along an axis.
  int order(int axis) const { return axis < dim_ && divisions_[axis].size() > 1 ? order_ : 0; }
  Index intervals(int axis) const {
    return std::max<Index>(1, static_cast<Index>(divisions_[axis].size()) - 1);
  }

  Index interval(int axis, double x) const {
    const std::vector<double>& planes = divisions_[axis];
    const auto above = std::upper_bound(planes.begin(), planes.end(), x);
    return std::clamp<Index>(static_cast<Index>(above - planes.begin()) - 1, 0,
                             intervals(axis) - 1);
  }

  Index number(const std::array<Index, 3>& at) const {
    Index result = 0;
    for (int a = dim_ - 1; a >= 0; --a) result = result * intervals(a) + at[a];
    return result;
  }

  std::array<Index, 3> place_in_cell(int local) const {
    std::array<Index, 3> at{};
    for (int a = 0; a < dim_; ++a) {
      at[a] = local % (order(a) + 1);
      local /= order(a) + 1;
    }
    return at;
  }

  std::array<Index, 3> place(Index cell) const {
    std::array<Index, 3> at{};
    for (int a = 0; a < dim_; ++a) {
      at[a] = cell % intervals(a);
      cell /= intervals(a);
    }
    return at;
  }

  int dim_;
  const Divisions& divisions_;
  int order_;
  double tolerance_;
};

}  // namespace

Hosts hosts_on_grid(const Particles& particles, std::span<const double> faces,
                    const Divisions& divisions, int order, double tolerance) {
  return fill_hosts(particles, faces, Grid(particles.dim, divisions, order, tolerance));
}

}  // namespace perilink

#include "discretization/carriers/carriers.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace perilink {
namespace {

/// The cells of a grid, numbered along x first.
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
    for (int a = 0; a < dim_; ++a) count *= order_ * intervals(a) + 1;
    return count;
  }
  /// In one cell; they are numbered along x first.
  int nodes_per_cell() const {
    return dim_ == 2 ? (order_ + 1) * (order_ + 1) : (order_ + 1) * (order_ + 1) * (order_ + 1);
  }

  /// Calls visit(cell) for every cell that holds the point, borders included.
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

  /// Whether a point of the cell is farther than the tolerance from its border.
  bool is_within(Index cell, std::span<const double> point) const {
    const std::array<Index, 3> at = place(cell);
    for (int a = 0; a < dim_; ++a) {
      if (point[a] <= divisions_[a][at[a]] + tolerance_) return false;
      if (point[a] >= divisions_[a][at[a] + 1] - tolerance_) return false;
    }
    return true;
  }

  /// Number of a node of the cell in the grid of all nodes.
  Index node(Index cell, int local) const {
    const std::array<Index, 3> at = place(cell), in = place_in_cell(local);
    Index result = 0;
    for (int a = dim_ - 1; a >= 0; --a) {
      result = result * (order_ * intervals(a) + 1) + order_ * at[a] + in[a];
    }
    return result;
  }

  double lower(Index cell, int axis) const { return divisions_[axis][place(cell)[axis]]; }
  double upper(Index cell, int axis) const { return divisions_[axis][place(cell)[axis] + 1]; }

  double coordinate(Index cell, int local, int axis) const {
    const double part = static_cast<double>(place_in_cell(local)[axis]) / order_;
    return lower(cell, axis) + part * (upper(cell, axis) - lower(cell, axis));
  }

  /// Shape function of a node at a point of the cell: Lagrange's polynomials along the axes.
  double weight(Index cell, int local, std::span<const double> point) const {
    const std::array<Index, 3> in = place_in_cell(local);
    double product = 1.0;
    for (int a = 0; a < dim_; ++a) {
      const double part = (point[a] - lower(cell, a)) / (upper(cell, a) - lower(cell, a));
      const double x = order_ * std::clamp(part, 0.0, 1.0);
      for (int k = 0; k <= order_; ++k) {
        if (k != in[a]) product *= (x - k) / static_cast<double>(in[a] - k);
      }
    }
    // Exactly nothing at particles on the border that the node does not touch.
    return std::abs(product) < 1e-12 ? 0.0 : product;
  }

 private:
  Index intervals(int axis) const { return static_cast<Index>(divisions_[axis].size()) - 1; }

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
      at[a] = local % (order_ + 1);
      local /= order_ + 1;
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

/// Cells with particles, and no faces, inside their border.
std::vector<std::uint8_t> usable_cells(const Grid& grid, const Particles& particles,
                                       std::span<const double> faces) {
  std::vector<std::uint8_t> usable(static_cast<std::size_t>(grid.size()), 0);
  const auto mark = [&](std::span<const double> point, std::uint8_t value) {
    grid.for_each_around(point, [&](Index cell) {
      if (grid.is_within(cell, point)) usable[cell] = value;
    });
  };
  for (Index i = 0; i < particles.size(); ++i) {
    if (particles.kind[i] == ParticleKind::solid) mark(particles.position(i), 1);
  }
  const auto dim = static_cast<std::size_t>(particles.dim);
  for (std::size_t at = 0; at < faces.size(); at += dim) mark(faces.subspan(at, dim), 0);
  return usable;
}

}  // namespace

Carriers carriers_on_grid(const Particles& particles, std::span<const double> faces,
                          const Divisions& divisions, int order, double tolerance) {
  Carriers carriers;
  carriers.dim = particles.dim;
  const Grid grid(particles.dim, divisions, order, tolerance);
  const std::vector<std::uint8_t> usable = usable_cells(grid, particles, faces);
  std::vector<Index> node_of(static_cast<std::size_t>(grid.num_nodes()), no_index);
  std::vector<Index> element_of(usable.size(), no_index), cell_of;
  for (Index cell = 0; cell < grid.size(); ++cell) {
    if (usable[cell] == 0) continue;
    element_of[cell] = static_cast<Index>(cell_of.size());
    cell_of.push_back(cell);
    for (int local = 0; local < grid.nodes_per_cell(); ++local) {
      Index& node = node_of[grid.node(cell, local)];
      if (node == no_index) {
        node = carriers.num_nodes();
        for (int a = 0; a < particles.dim; ++a) {
          carriers.nodes.push_back(grid.coordinate(cell, local, a));
        }
      }
      carriers.nodes_of.values.push_back(node);
    }
    carriers.nodes_of.offsets.push_back(static_cast<Index>(carriers.nodes_of.values.size()));
    for (int a = 0; a < particles.dim; ++a) {
      carriers.lower.push_back(grid.lower(cell, a));
      carriers.upper.push_back(grid.upper(cell, a));
    }
  }
  carriers.inside = sorted_into_rows(static_cast<Index>(cell_of.size()), [&](const auto& add) {
    for (Index i = 0; i < particles.size(); ++i) {
      if (particles.kind[i] == ParticleKind::ghost) continue;
      grid.for_each_around(particles.position(i), [&](Index cell) {
        if (element_of[cell] != no_index) add(element_of[cell], i);
      });
    }
  });
  for (std::size_t e = 0; e < cell_of.size(); ++e) {
    carriers.first_weight.push_back(carriers.weights.size());
    for (const Index i : carriers.inside.row(static_cast<Index>(e))) {
      for (int local = 0; local < grid.nodes_per_cell(); ++local) {
        carriers.weights.push_back(grid.weight(cell_of[e], local, particles.position(i)));
      }
    }
  }
  return carriers;
}

}  // namespace perilink

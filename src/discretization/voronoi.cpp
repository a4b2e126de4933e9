#include "discretization/voronoi.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "discretization/neighbor_search.hpp"

namespace perilink {
namespace {

template <int Dim>
using Point = Eigen::Matrix<double, Dim, 1>;
template <int Dim>
using Simplex = std::array<Point<Dim>, Dim + 1>;

template <int Dim>
double volume_of(const Simplex<Dim>& simplex) {
  Eigen::Matrix<double, Dim, Dim> edges;
  for (int k = 0; k < Dim; ++k) edges.col(k) = simplex[k + 1] - simplex[0];
  return std::abs(edges.determinant()) / (Dim == 2 ? 2.0 : 6.0);
}

/// Appends the part of a simplex where normal.x <= offset, cut into simplices.
///
/// With k corners v_i inside and m corners w_j outside, the part is the product of a simplex of k
/// corners and one of m + 1. Its corners are v_i and the points on the edges (v_i, w_j). Its
/// staircase triangulation has one simplex per path from (0, 0) to (k - 1, m) by single steps.
template <int Dim>
void cut(const Simplex<Dim>& simplex, const Point<Dim>& normal, double offset,
         std::vector<Simplex<Dim>>& parts) {
  std::array<double, Dim + 1> height;
  std::array<int, Dim + 1> inside{}, outside{};
  int k = 0, m = 0;
  for (int c = 0; c <= Dim; ++c) {
    height[c] = normal.dot(simplex[c]) - offset;
    (height[c] <= 0.0 ? inside[k++] : outside[m++]) = c;
  }
  if (k == 0) return;
  if (m == 0) {
    parts.push_back(simplex);
    return;
  }
  const auto corner = [&](int i, int j) -> Point<Dim> {
    const int v = inside[i];
    if (j == 0) return simplex[v];
    const int w = outside[j - 1];
    return simplex[v] + height[v] / (height[v] - height[w]) * (simplex[w] - simplex[v]);
  };
  for (unsigned way = 0; way < 1U << Dim; ++way) {
    if (std::popcount(way) != k - 1) continue;  // bits: steps to the next inner corner
    Simplex<Dim> part;
    int i = 0, j = 0;
    part[0] = corner(0, 0);
    for (int step = 0; step < Dim; ++step) {
      ((way >> step & 1U) != 0U ? i : j) += 1;
      part[step + 1] = corner(i, j);
    }
    parts.push_back(part);
  }
}

template <int Dim>
class VoronoiShares {
 public:
  VoronoiShares(const Particles& particles, const Simplices& cells)
      : particles_(particles), cells_(cells), around_(around_cells()) {}

  std::vector<double> sum(double thickness) const {
    // Compute all parts first, so that sums have one order for any number of threads.
    std::vector<double> shares(around_.values.size(), 0.0);
#pragma omp parallel for schedule(dynamic, 256)
    for (Index number = 0; number < cells_.size(); ++number) share(number, shares);
    std::vector<double> volumes(static_cast<std::size_t>(particles_.size()), 0.0);
    for (std::size_t k = 0; k < shares.size(); ++k) {
      volumes[around_.values[k]] += thickness * shares[k];
    }
    return volumes;
  }

 private:
  Point<Dim> at(Index particle) const {
    return Eigen::Map<const Point<Dim>>(particles_.position(particle).data());
  }

  Simplex<Dim> corners(Index number) const {
    Simplex<Dim> simplex;
    for (int c = 0; c <= Dim; ++c) simplex[c] = at(cells_.cell(number)[c]);
    return simplex;
  }

  /// Particles that can be nearest to a point of each cell. A point of a cell is at most the
  /// longest edge away from a corner, so its nearest particle is no farther.
  Csr around_cells() const {
    std::vector<double> centers;
    std::vector<double> reach;
    for (Index number = 0; number < cells_.size(); ++number) {
      const Simplex<Dim> simplex = corners(number);
      Point<Dim> center = Point<Dim>::Zero();
      for (const auto& corner : simplex) center += corner / (Dim + 1.0);
      double farthest = 0.0, longest = 0.0;
      for (int a = 0; a <= Dim; ++a) {
        farthest = std::max(farthest, (simplex[a] - center).norm());
        for (int b = 0; b < a; ++b) longest = std::max(longest, (simplex[a] - simplex[b]).norm());
      }
      centers.insert(centers.end(), center.data(), center.data() + Dim);
      reach.push_back(farthest + longest);
    }
    return find_neighbors_within(particles_.positions, centers, Dim, reach);
  }

  void share(Index number, std::vector<double>& shares) const {
    const std::span<const Index> around = around_.row(number);
    const std::span<const Index> own = cells_.cell(number);
    const Simplex<Dim> simplex = corners(number);
    std::vector<Simplex<Dim>> parts, next;
    for (std::size_t k = 0; k < around.size(); ++k) {
      const Point<Dim> x = at(around[k]);
      parts.assign(1, simplex);
      const auto cut_by = [&](Index other) {
        const Point<Dim> y = at(other);
        next.clear();
        for (const auto& part : parts) {
          cut<Dim>(part, y - x, 0.5 * (y - x).dot(y + x), next);
        }
        parts.swap(next);
      };
      // The cell's own corners cut first, because they leave most other particles without a part.
      for (const Index other : own) {
        if (other != around[k] && !parts.empty()) cut_by(other);
      }
      for (std::size_t other = 0; other < around.size() && !parts.empty(); ++other) {
        const bool is_own = std::find(own.begin(), own.end(), around[other]) != own.end();
        if (other != k && !is_own) cut_by(around[other]);
      }
      double& sum = shares[around_.offsets[number] + k];
      for (const auto& part : parts) sum += volume_of<Dim>(part);
    }
  }

  const Particles& particles_;
  const Simplices& cells_;
  Csr around_;
};

}  // namespace

std::vector<double> voronoi_volumes(const Particles& particles, const Simplices& cells,
                                    double thickness) {
  return particles.dim == 2 ? VoronoiShares<2>(particles, cells).sum(thickness)
                            : VoronoiShares<3>(particles, cells).sum(1.0);
}

}  // namespace perilink

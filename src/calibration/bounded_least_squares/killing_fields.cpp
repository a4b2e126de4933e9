#include "calibration/bounded_least_squares/killing_fields.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include <Eigen/Dense>

#include "base/dense/decompositions.hpp"

namespace perilink {
namespace {

using Eigen::MatrixXd;
using Triple = std::array<int, 3>;

/// Squares of fields below this fraction of the largest are round-off. In space six of the 56
/// products are dependent, since the sum over the axes of translation times rotation is zero.
constexpr double smallest_square = 1e-10;

/// Returns all triples of numbers below `count` in ascending order.
std::vector<Triple> ascending_triples(int count) {
  std::vector<Triple> triples;
  for (int a = 0; a < count; ++a) {
    for (int b = a; b < count; ++b) {
      for (int c = b; c < count; ++c) triples.push_back({a, b, c});
    }
  }
  return triples;
}

/// Returns the coefficient of n_a n_b n_c in (u n) (v n) (w n).
double component(Triple abc, const Vector3& u, const Vector3& v, const Vector3& w) {
  double sum = 0.0;
  do {
    sum += u[abc[0]] * v[abc[1]] * w[abc[2]];
  } while (std::next_permutation(abc.begin(), abc.end()));
  return sum;
}

}  // namespace

MatrixXd killing_fields(const PointEquations& equations, std::span<const Index> points) {
  const std::size_t dim = static_cast<std::size_t>(equations.dim);
  const std::size_t rows = static_cast<std::size_t>(equations.rows);
  const auto position = [&](Index p) {
    return std::span(equations.positions).subspan(static_cast<std::size_t>(p) * dim, dim);
  };
  Vector3 lower, upper;
  lower.fill(std::numeric_limits<double>::max());
  upper.fill(std::numeric_limits<double>::lowest());
  for (const Index p : points) {
    for (std::size_t a = 0; a < dim; ++a) {
      lower[a] = std::min(lower[a], position(p)[a]);
      upper[a] = std::max(upper[a], position(p)[a]);
    }
  }
  const RigidMotions motions(equations.dim, lower, upper);
  const std::vector<Triple> products = ascending_triples(motions.count());
  const std::vector<Triple> components = ascending_triples(equations.dim);
  MatrixXd fields = MatrixXd::Zero(static_cast<Eigen::Index>(points.size() * rows),
                                   static_cast<Eigen::Index>(products.size()));
  std::array<Vector3, 6> motion;
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (int m = 0; m < motions.count(); ++m) motion[m] = motions.at(m, position(points[k]));
    for (std::size_t r = 0; r < components.size(); ++r) {
      const double scale = equations.scale[static_cast<std::size_t>(points[k]) * rows + r];
      if (scale == 0.0) continue;
      for (std::size_t f = 0; f < products.size(); ++f) {
        const auto [u, v, w] = products[f];
        fields(static_cast<Eigen::Index>(k * rows + r), static_cast<Eigen::Index>(f)) =
            component(components[r], motion[u], motion[v], motion[w]) / scale;
      }
    }
  }
  const Eigenvectors squares = eigenvectors(fields.transpose() * fields);
  const auto& values = squares.values;
  const auto kept = (values.array() > smallest_square * values[values.size() - 1]).count();
  return fields * squares.vectors.rightCols(kept) *
         values.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
}

}  // namespace perilink

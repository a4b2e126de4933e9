#include "calibration/least_change/killing_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

namespace perilink {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;

/// Squares of fields below this part of the largest are round-off of others.
constexpr double smallest_square = 1e-10;

/// Triples of numbers below `count` in ascending order.
std::vector<std::array<int, 3>> ascending_triples(int count) {
  std::vector<std::array<int, 3>> triples;
  for (int a = 0; a < count; ++a) {
    for (int b = a; b < count; ++b) {
      for (int c = b; c < count; ++c) triples.push_back({a, b, c});
    }
  }
  return triples;
}

/// Rigid motions at x: along the axes, and turns.
std::vector<Vector3d> motions_at(int dim, const Vector3d& x) {
  std::vector<Vector3d> motions;
  for (int axis = 0; axis < dim; ++axis) motions.push_back(Vector3d::Unit(axis));
  if (dim == 2) return motions.push_back({-x[1], x[0], 0.0}), motions;
  for (int axis = 0; axis < dim; ++axis) motions.push_back(Vector3d::Unit(axis).cross(x));
  return motions;
}

/// Triples of motions whose products do not make up each other: in space the sum over the axes of
/// motion times turn is zero.
std::vector<std::array<int, 3>> independent_products(int dim) {
  std::vector<std::array<int, 3>> products = ascending_triples(dim == 2 ? 3 : 6);
  if (dim == 2) return products;
  std::erase_if(products, [](const std::array<int, 3>& of) {
    return std::ranges::count(of, 2) > 0 && std::ranges::count(of, 5) > 0;
  });
  return products;
}

/// Component of (u n) (v n) (w n) with n_a n_b n_c.
double component(std::array<int, 3> abc, const Vector3d& u, const Vector3d& v, const Vector3d& w) {
  double sum = 0.0;
  do {
    sum += u[abc[0]] * v[abc[1]] * w[abc[2]];
  } while (std::next_permutation(abc.begin(), abc.end()));
  return sum;
}

}  // namespace

MatrixXd killing_fields(const PointEquations& equations, std::span<const Index> points) {
  const int dim = equations.dim;
  const auto position = [&](Index p) {
    Vector3d x = Vector3d::Zero();
    for (int a = 0; a < dim; ++a) x[a] = equations.positions[static_cast<std::size_t>(p) * dim + a];
    return x;
  };
  Vector3d centre = Vector3d::Zero();
  for (const Index p : points) centre += position(p) / static_cast<double>(points.size());
  double size = 0.0;
  for (const Index p : points) size = std::max(size, (position(p) - centre).norm());
  if (size == 0.0) size = 1.0;

  const auto products = independent_products(dim);
  const auto components = ascending_triples(dim);
  MatrixXd fields = MatrixXd::Zero(static_cast<Eigen::Index>(points.size()) * equations.rows,
                                   static_cast<Eigen::Index>(products.size()));
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto motions = motions_at(dim, (position(points[k]) - centre) / size);
    for (std::size_t r = 0; r < components.size(); ++r) {
      const double scale =
          equations.scale[static_cast<std::size_t>(points[k]) * equations.rows + r];
      if (scale == 0.0) continue;
      auto row = fields.row(static_cast<Eigen::Index>(k * equations.rows + r));
      for (std::size_t f = 0; f < products.size(); ++f) {
        const auto& [u, v, w] = products[f];
        row[static_cast<Eigen::Index>(f)] =
            component(components[r], motions[u], motions[v], motions[w]) / scale;
      }
    }
  }
  const Eigen::SelfAdjointEigenSolver<MatrixXd> squares(fields.transpose() * fields);
  const auto& values = squares.eigenvalues();
  const auto kept = (values.array() > smallest_square * values[values.size() - 1]).count();
  return fields * squares.eigenvectors().rightCols(kept) *
         values.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
}

}  // namespace perilink

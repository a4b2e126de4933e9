#include "discretization/embedded_points.hpp"

#include <Eigen/Dense>

#include <cmath>

#include "base/dense/decompositions.hpp"

namespace perilink {
namespace {

/// First radius of the search for particles [spacings], and its growth factor if they are too few.
constexpr double first_reach = 1.75;
constexpr double growth = 1.1;

/// Least eigenvalue of the moments over the largest one; below it the particles are too few.
constexpr double least_spread = 0.02;

/// Linear basis: one, and the vector to a particle [spacings].
template <int Dim>
using Basis = Eigen::Matrix<double, Dim + 1, 1>;

/// Returns a weight that falls smoothly from one to zero at the radius.
template <int Dim>
double kernel(const Basis<Dim>& basis, double reach) {
  const double square = (basis.squaredNorm() - 1.0) / (reach * reach);
  return square < 1.0 ? (1.0 - square) * (1.0 - square) : 0.0;
}

template <int Dim>
std::vector<double> weights_of(std::span<const double> arms, double spacing, int derivative) {
  std::vector<Basis<Dim>> bases;
  for (std::size_t k = 0; k < arms.size(); k += Dim) {
    bases.emplace_back()[0] = 1.0;
    for (int a = 0; a < Dim; ++a) bases.back()[a + 1] = arms[k + a] / spacing;
  }
  for (double reach = first_reach; reach < embedded_point_reach * (1.0 + 1e-9); reach *= growth) {
    using Moments = Eigen::Matrix<double, Dim + 1, Dim + 1>;
    Moments moments = Moments::Zero();
    for (const auto& basis : bases) {
      moments += kernel<Dim>(basis, reach) * basis * basis.transpose();
    }
    const Eigen::VectorXd spread = eigenvalues(Eigen::MatrixXd(moments));
    if (!(spread[0] > least_spread * spread[Dim])) continue;
    const Basis<Dim> factors =
        moments.ldlt().solve(Basis<Dim>::Unit(derivative)) * (derivative > 0 ? 1.0 / spacing : 1.0);
    std::vector<double> weights;
    for (const auto& basis : bases) {
      weights.push_back(kernel<Dim>(basis, reach) * factors.dot(basis));
    }
    return weights;
  }
  return {};
}

}  // namespace

std::vector<double> linear_weights(std::span<const double> arms, int dim, double spacing,
                                   int derivative) {
  return dim == 2 ? weights_of<2>(arms, spacing, derivative)
                  : weights_of<3>(arms, spacing, derivative);
}

}  // namespace perilink

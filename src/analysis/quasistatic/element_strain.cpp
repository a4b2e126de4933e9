#include "analysis/quasistatic/element_strain.hpp"

#include <Eigen/Dense>

#include "base/dense/decompositions.hpp"
#include "material/principal_values.hpp"

namespace perilink {

ElementStrain::ElementStrain(const Particles& particles, Index number,
                             std::span<const Index> inside)
    : dim_(particles.dim), number_(number), inside_(inside.begin(), inside.end()) {
  const auto count = static_cast<Index>(inside.size());
  Eigen::MatrixXd places(dim_, count);
  for (Index k = 0; k < count; ++k) {
    for (int a = 0; a < dim_; ++a) places(a, k) = particles.position(inside[k])[a];
  }
  places.colwise() -= Eigen::VectorXd(places.rowwise().mean());
  constexpr double flat = 1e-9;  // over the largest extent
  const Eigen::MatrixXd gradient = least_squares(places * places.transpose(), places, flat);
  gradient_.assign(gradient.data(), gradient.data() + gradient.size());
}

double ElementStrain::principal(std::span<const double> motion, int width) const {
  double slope[3][3] = {};
  for (std::size_t k = 0; k < inside_.size(); ++k) {
    const double* u = motion.data() + static_cast<std::size_t>(inside_[k]) * width;
    const double* g = gradient_.data() + k * dim_;
    for (int a = 0; a < dim_; ++a) {
      for (int b = 0; b < dim_; ++b) slope[a][b] += u[a] * g[b];
    }
  }
  const auto shear = [&](int a, int b) { return 0.5 * (slope[a][b] + slope[b][a]); };
  return principal_values(
             {slope[0][0], slope[1][1], slope[2][2], shear(0, 1), shear(1, 2), shear(2, 0)}, dim_)
      .first;
}

}  // namespace perilink

#include "material/state_fit.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

namespace perilink {
namespace {

constexpr double exact_fit = 1e-9;  ///< residuals of regular families are round-off
constexpr double same = 1e-6;  ///< singular values over the largest below which columns are alike

using Strain = Eigen::VectorXd;  ///< or n n', Mandel's components: 3 in the plane, 6 in space
using Tensor = Eigen::MatrixXd;

Strain product(const Vector3& n, int dim) {
  const double root = std::numbers::sqrt2;
  if (dim == 2) return Eigen::Vector3d(n[0] * n[0], n[1] * n[1], root * n[0] * n[1]);
  Strain result(6);
  result << n[0] * n[0], n[1] * n[1], n[2] * n[2], root * n[1] * n[2], root * n[0] * n[2],
      root * n[0] * n[1];
  return result;
}

Tensor hooke_tensor(Problem problem, double youngs_modulus, double poissons_ratio) {
  const HookeConstants hooke = hooke_constants(problem, youngs_modulus, poissons_ratio);
  const int dim = dimension_of(problem), size = dim == 2 ? 3 : 6;
  Tensor d = 2.0 * hooke.mu * Tensor::Identity(size, size);
  d.topLeftCorner(dim, dim).array() += hooke.lambda;
  return d;
}

/// What each constant contributes to the stiffness of a family.
struct Parts {
  Tensor own, far, state;
  bool any_far = false;
  bool singular = false;

  Parts(std::span<const FamilyBond> family, int dim, double volume) {
    const int size = dim == 2 ? 3 : 6;
    own = far = state = Tensor::Zero(size, size);
    Strain sum = Strain::Zero(size);
    for (const FamilyBond& bond : family) {
      const Strain n = product(bond.direction, dim);
      const Tensor part = 0.5 * bond.length / volume * n * n.transpose();
      own += part;
      if (bond.far) far += part;
      any_far = any_far || bond.far;
      sum += bond.length * n;
    }
    state = 0.5 / volume * sum * sum.transpose();
    const Eigen::SelfAdjointEigenSolver<Tensor> solver(own, Eigen::EigenvaluesOnly);
    singular = !(solver.eigenvalues()[0] > same * solver.eigenvalues()[size - 1]);
  }

  Tensor stiffness(const ParticleModuli& moduli) const {
    return moduli.own * own + moduli.far * far + moduli.state * state;
  }
};

/// The energy sum_j L_j (own + far_j) S_j^2 + state (sum_j L_j S_j)^2 is positive for every
/// deformation where each bond's part is and what the state takes away is less.
bool is_positive(const ParticleModuli& moduli, std::span<const FamilyBond> family) {
  double reach = 0.0;
  for (const FamilyBond& bond : family) {
    const double own = moduli.own + (bond.far ? moduli.far : 0.0);
    if (!(own > 0.0)) return false;
    reach += bond.length / own;
  }
  return 1.0 + moduli.state * reach > 0.0;
}

Eigen::Map<const Eigen::VectorXd> entries(const Tensor& tensor) {
  return {tensor.data(), tensor.size()};
}

}  // namespace

ParticleFit fit_particle_moduli(Problem problem, double youngs_modulus, double poissons_ratio,
                                std::span<const FamilyBond> family, double volume) {
  const int dim = dimension_of(problem);
  const Tensor wanted = hooke_tensor(problem, youngs_modulus, poissons_ratio);
  ParticleFit fit;
  if (family.empty()) {
    fit.kind = FitKind::singular;
    fit.residual = 1.0;
    return fit;
  }
  const Parts parts(family, dim, volume);
  // In the plane all neighbours are first ones: the hexagonal lattice has no others.
  const bool has_far = dim == 3 && parts.any_far;
  Eigen::MatrixXd columns(wanted.size(), has_far ? 3 : 2);
  columns.col(0) = entries(parts.own);
  columns.col(1) = entries(parts.state);
  if (has_far) columns.col(2) = entries(parts.far);
  const Eigen::VectorXd scale = columns.colwise().norm().cwiseMax(1e-300);
  columns.array().rowwise() /= scale.transpose().array();

  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(columns, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd& values = svd.singularValues();
  const Eigen::VectorXd solution = svd.solve(entries(wanted)).cwiseQuotient(scale);
  fit.moduli = {solution[0], has_far ? solution[2] : 0.0, solution[1]};
  if (parts.singular) {
    fit.kind = FitKind::singular;
  } else if (values[values.size() - 1] < same * values[0]) {
    fit.kind = FitKind::many;
  } else if (!is_positive(fit.moduli, family)) {
    fit.kind = FitKind::indefinite;
  } else {
    fit.kind = FitKind::least;
  }
  if (fit.kind != FitKind::least) {
    fit.moduli = {entries(parts.own).dot(entries(wanted)) / parts.own.squaredNorm(), 0.0, 0.0};
  }
  fit.residual = (parts.stiffness(fit.moduli) - wanted).norm() / wanted.norm();
  if (fit.kind == FitKind::least && fit.residual < exact_fit) fit.kind = FitKind::exact;
  return fit;
}

}  // namespace perilink

#include "material/states/state_fit.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "base/dense/decompositions.hpp"

namespace perilink {
namespace {

constexpr double exact_fit = 1e-9;  ///< residuals of regular neighbourhoods are round-off
/// Smallest fraction of the bonds' energy that a state may leave in the most softened deformation.
constexpr double least_energy = 1e-3;
constexpr double same = 1e-6;  ///< ratio of singular values below which columns are linearly
                               ///< dependent

using Strain = Eigen::VectorXd;  ///< or n n', in Mandel's components: 3 in the plane, 6 in space
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

/// Contributions of the constants to the stiffness of a neighbourhood.
struct Parts {
  Tensor own, far, state;
  bool two_kinds = false;  ///< near and far bonds
  bool singular = false;

  Parts(std::span<const NeighbourhoodBond> neighbourhood, int dim, double volume) {
    const int size = dim == 2 ? 3 : 6;
    own = far = state = Tensor::Zero(size, size);
    Strain sum = Strain::Zero(size);
    bool any_far = false, any_near = false;
    for (const NeighbourhoodBond& bond : neighbourhood) {
      const Strain n = product(bond.direction, dim);
      const Tensor part = 0.5 * bond.length / volume * n * n.transpose();
      own += part;
      if (bond.far) far += part;
      any_far = any_far || bond.far;
      any_near = any_near || !bond.far;
      sum += bond.length * n;
    }
    two_kinds = any_far && any_near;
    state = 0.5 / volume * sum * sum.transpose();
    const Eigen::VectorXd sizes = eigenvalues(own);
    singular = !(sizes[0] > same * sizes[size - 1]);
  }

  Tensor stiffness(const ParticleModuli& moduli) const {
    return moduli.own * own + moduli.far * far + moduli.state * state;
  }
};

/// Returns whether the energy sum_j L_j (own + far_j) S_j^2 + state (sum_j L_j S_j)^2 is positive
/// in every deformation. Each bond's part must be positive, and the state must remove less than
/// their sum.
bool is_positive(const ParticleModuli& moduli, std::span<const NeighbourhoodBond> neighbourhood) {
  double reach = 0.0;
  for (const NeighbourhoodBond& bond : neighbourhood) {
    const double own = moduli.own + (bond.far ? moduli.far : 0.0);
    if (!(own > 0.0)) return false;
    reach += bond.length / own;
  }
  return 1.0 + moduli.state * reach > least_energy;
}

Eigen::Map<const Eigen::VectorXd> entries(const Tensor& tensor) {
  return {tensor.data(), tensor.size()};
}

/// Returns the least-squares solution of own + state (+ far) = wanted.
/// \param unique  set to false if the constants are linearly dependent
ParticleModuli solve(const Parts& parts, const Tensor& wanted, bool with_far, bool& unique) {
  Eigen::MatrixXd columns(wanted.size(), with_far ? 3 : 2);
  columns.col(0) = entries(parts.own);
  columns.col(1) = entries(parts.state);
  if (with_far) columns.col(2) = entries(parts.far);
  const Eigen::VectorXd scale = columns.colwise().norm().cwiseMax(1e-300);
  columns.array().rowwise() /= scale.transpose().array();
  double ratio = 0.0;
  const Eigen::VectorXd found =
      least_squares_by_svd(columns, entries(wanted), ratio).cwiseQuotient(scale);
  unique = ratio > same;
  return {found[0], with_far ? found[2] : 0.0, found[1]};
}

}  // namespace

ParticleFit fit_particle_moduli(Problem problem, double youngs_modulus, double poissons_ratio,
                                std::span<const NeighbourhoodBond> neighbourhood, double volume) {
  const int dim = dimension_of(problem);
  const Tensor wanted = hooke_tensor(problem, youngs_modulus, poissons_ratio);
  ParticleFit fit;
  if (neighbourhood.empty()) {
    fit.kind = FitKind::singular;
    fit.residual = 1.0;
    return fit;
  }
  const Parts parts(neighbourhood, dim, volume);
  bool unique = true;
  fit.moduli = solve(parts, wanted, parts.two_kinds, unique);
  fit.kind = unique ? FitKind::least : FitKind::many;
  if (!unique) fit.moduli = solve(parts, wanted, false, unique);
  if (parts.singular) {
    fit.kind = FitKind::singular;
  } else if (!is_positive(fit.moduli, neighbourhood)) {
    fit.kind = FitKind::indefinite;
  }
  if (fit.kind == FitKind::singular || fit.kind == FitKind::indefinite) {
    fit.moduli = {entries(parts.own).dot(entries(wanted)) / parts.own.squaredNorm(), 0.0, 0.0};
  }
  fit.residual = (parts.stiffness(fit.moduli) - wanted).norm() / wanted.norm();
  if (fit.kind == FitKind::least && fit.residual < exact_fit) fit.kind = FitKind::exact;
  return fit;
}

}  // namespace perilink

#include "analysis/dynamics/fundamental_period.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>

#include "analysis/dynamics/subdomain_preconditioner.hpp"
#include "assembly/internal_force.hpp"
#include "base/dense/decompositions.hpp"
#include "base/error.hpp"

namespace perilink {
namespace {

using Eigen::VectorXd;

constexpr int most_period_steps = 2000;
/// relative round-off of forces; very slender bodies multiply it
constexpr double force_round_off = 1e-16;
/// Energy that the residual could still release, over the energy of the vibration. The relative
/// error of the squared frequency is at most about ten times as large.
constexpr double tolerance = 1e-8;
/// Below this fraction of the largest stiffness over mass, round-off of forces changes the third
/// digit of the period.
constexpr double least_stiffness = 1e-13;

/// Slowest vibration: a motion of unit kinetic form, orthogonal to the free motions.
class Vibration {
 public:
  Vibration(const Network& network, const Unknowns& unknowns, const Inertia& inertia,
            std::span<const std::vector<double>> free)
      : network_(network),
        unknowns_(unknowns),
        mass_(Eigen::Map<const VectorXd>(inertia.mass.data(),
                                         static_cast<Eigen::Index>(inertia.mass.size()))),
        inverse_(network, unknowns),
        fastest_(inverse_.fastest(inertia.mass)) {
    for (const std::vector<double>& motion : free) {
      VectorXd own = masked(Eigen::Map<const VectorXd>(motion.data(), mass_.size()));
      make_orthogonal(own, free_);
      free_.push_back(own / std::sqrt(product(own, own)));
    }
  }

  /// Iterates to convergence. \return the square of the circular frequency [1/time^2]
  double settle();

 private:
  struct Direction {
    VectorXd u, force;  ///< K u
  };

  double product(const VectorXd& a, const VectorXd& b) const {
    return (a.array() * mass_.array() * b.array()).sum();
  }
  VectorXd masked(VectorXd u) const {
    for (Eigen::Index slot = 0; slot < u.size(); ++slot) {
      if (unknowns_.number[slot] == no_index) u[slot] = 0.0;
    }
    return u;
  }
  void make_orthogonal(VectorXd& u, const std::vector<VectorXd>& others) const {
    for (const VectorXd& other : others) u -= product(other, u) * other;
  }
  VectorXd force_of(const VectorXd& u) {
    const auto size = static_cast<std::size_t>(u.size());
    if (network_.embedded_points.size() == 0) {
      internal_force(network_, {}, {u.data(), size}, inner_);
    } else {
      VectorXd all = u;
      follow_particles(network_, {all.data(), size});
      internal_force(network_, {}, {all.data(), size}, inner_);
      load_particles(network_, inner_.forces);
    }
    return masked(Eigen::Map<const VectorXd>(inner_.forces.data(), u.size()));
  }
  VectorXd random_start() const;
  bool append(Direction direction);
  void improve(Direction& last);

  const Network& network_;
  const Unknowns& unknowns_;
  VectorXd mass_;
  SubdomainPreconditioner inverse_;
  double fastest_;  ///< estimated square of the highest circular frequency [1/time^2]
  std::vector<VectorXd> free_;
  InternalForce inner_;
  std::vector<Direction> basis_;  ///< orthonormal; the present motion is the first
};

/// Returns a start vector from a fixed seed: it contains every vibration, mostly slow ones.
VectorXd Vibration::random_start() const {
  std::mt19937 random(1);
  VectorXd push(mass_.size());
  for (double& value : push) value = static_cast<double>(random()) / std::mt19937::max() - 0.4;
  VectorXd u = inverse_.times(masked(push.cwiseProduct(mass_)));
  make_orthogonal(u, free_);
  return u;
}

/// Adds a direction, made orthonormal to the basis. \return false where only round-off is left
bool Vibration::append(Direction direction) {
  const double whole = std::sqrt(product(direction.u, direction.u));
  if (!(whole > 0.0)) return false;
  constexpr double least_part = 1e-10;    // smaller parts are round-off
  for (int pass = 0; pass < 2; ++pass) {  // one pass leaves too much round-off
    make_orthogonal(direction.u, free_);  // no force acts along free motions
    for (const Direction& other : basis_) {
      const double part = product(other.u, direction.u);
      direction.u -= part * other.u;
      direction.force -= part * other.force;
    }
  }
  const double norm = std::sqrt(product(direction.u, direction.u));
  if (!(norm > least_part * whole)) return false;
  direction.u /= norm;
  direction.force /= norm;
  basis_.push_back(std::move(direction));
  return true;
}

/// Starts the next basis with the slowest motion of the present one.
/// \param last  becomes the contribution of the other directions to that motion
void Vibration::improve(Direction& last) {
  const auto count = static_cast<Eigen::Index>(basis_.size());
  Eigen::MatrixXd matrix(count, count);
  for (Eigen::Index r = 0; r < count; ++r) {
    for (Eigen::Index c = 0; c < count; ++c) matrix(r, c) = basis_[r].u.dot(basis_[c].force);
  }
  const VectorXd part = eigenvectors(matrix).vectors.col(0);
  Direction next{VectorXd::Zero(mass_.size()), VectorXd::Zero(mass_.size())};
  for (Eigen::Index k = 1; k < count; ++k) {
    next.u += part[k] * basis_[k].u;
    next.force += part[k] * basis_[k].force;
  }
  last = next;
  next.u += part[0] * basis_[0].u;
  next.force += part[0] * basis_[0].force;
  basis_.clear();
  append(std::move(next));
}

double Vibration::settle() {
  VectorXd start = random_start();
  VectorXd force = force_of(start);
  append({std::move(start), std::move(force)});
  Direction last;
  for (int k = 0; k < most_period_steps && !basis_.empty(); ++k) {
    const Direction& now = basis_.front();
    const double square = now.u.dot(now.force);
    if (!(square > least_stiffness * fastest_)) {
      throw SolverError(
          "the fundamental period cannot be computed: parts of the body move freely, or it is too "
          "slender");
    }
    const VectorXd residual = now.force - square * mass_.cwiseProduct(now.u);
    VectorXd step = inverse_.times(residual);
    make_orthogonal(step, free_);
    const double noise = force_round_off * fastest_ / square;
    const double left = residual.dot(step);  // negative values are round-off
    if (left >= 0.0 && left <= std::max(tolerance, noise * noise) * square) {
      force_of(now.u);  // round-off hardly changes the energy, a sum of squares
      return 2.0 * inner_.energy / product(now.u, now.u);
    }
    VectorXd resistance = force_of(step);
    append({std::move(step), std::move(resistance)});
    if (last.u.size() > 0) append(last);
    improve(last);
  }
  throw SolverError(fmt::format("the fundamental period has not converged after {} iterations",
                                most_period_steps));
}

}  // namespace

double fundamental_period(const Network& network, const Unknowns& unknowns, const Inertia& inertia,
                          std::span<const std::vector<double>> free) {
  expect_nothing_embedded(unknowns);
  if (unknowns.count <= static_cast<Index>(free.size())) {
    return std::numeric_limits<double>::infinity();
  }
  const double square = Vibration(network, unknowns, inertia, free).settle();
  return 2.0 * std::numbers::pi / std::sqrt(square);
}

}  // namespace perilink

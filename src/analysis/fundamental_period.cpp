#include "analysis/fundamental_period.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "assembly/stiffness.hpp"
#include "base/error.hpp"
#include "solver/factor.hpp"

namespace perilink {
namespace {

constexpr int most_iterations = 1000;
/// Of the largest stiffness over mass: far below the slowest vibration of bodies of thousands of
/// particles across, far above round-off.
constexpr double relative_shift = 1e-10;
constexpr double tolerance = 1e-9;  // change of the eigenvalue, of two iterations in a row

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

/// Makes vectors free of some motions with respect to the masses.
class Deflation {
 public:
  Deflation(const Unknowns& unknowns, std::span<const std::vector<double>> motions,
            const std::vector<double>& mass)
      : mass_(mass) {
    for (const std::vector<double>& motion : motions) {
      std::vector<double> own;
      for (std::size_t slot = 0; slot < motion.size(); ++slot) {
        if (unknowns.number[slot] != no_index) own.push_back(motion[slot]);
      }
      apply(own);
      const double norm = std::sqrt(product(own, own));
      for (double& value : own) value /= norm;
      basis_.push_back(std::move(own));
    }
  }

  bool empty() const { return basis_.empty(); }

  void apply(std::vector<double>& x) const {
    for (const std::vector<double>& motion : basis_) {
      const double part = product(motion, x);
      for (std::size_t k = 0; k < x.size(); ++k) x[k] -= part * motion[k];
    }
  }

 private:
  double product(const std::vector<double>& a, const std::vector<double>& b) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += mass_[k] * a[k] * b[k];
    return sum;
  }

  const std::vector<double>& mass_;
  std::vector<std::vector<double>> basis_;
};

/// Adds a small multiple of the masses to a stiffness matrix that resists no free motion.
/// \return the multiple [1/time^2]
double add_shift(SparseMatrix& stiffness, const std::vector<double>& mass) {
  double fastest = 0.0;
  for (Index k = 0; k < stiffness.cols(); ++k) {
    fastest = std::max(fastest, stiffness.coeff(k, k) / mass[k]);
  }
  const double shift = relative_shift * fastest;
  for (Index k = 0; k < stiffness.cols(); ++k) stiffness.coeffRef(k, k) += shift * mass[k];
  return shift;
}

}  // namespace

double fundamental_period(const Network& network, const Unknowns& unknowns, const Inertia& inertia,
                          int threads, std::span<const std::vector<double>> free) {
  const std::vector<double> secants(static_cast<std::size_t>(network.num_elements()), 1.0);
  std::vector<double> mass;
  for (std::size_t slot = 0; slot < unknowns.number.size(); ++slot) {
    if (unknowns.number[slot] != no_index) mass.push_back(inertia.mass[slot]);
  }
  const Deflation deflation(unknowns, free, mass);
  SparseMatrix stiffness = assemble_stiffness(network, secants, unknowns);
  const double shift = deflation.empty() ? 0.0 : add_shift(stiffness, mass);
  const std::unique_ptr<Factor> factor = make_factor(FactorRoute::in_place, threads);
  factor->factorize(stiffness, particle_of_unknown(unknowns));
  std::mt19937 random(1);  // the same start every time, with a part of every vibration
  std::vector<double> x(mass.size()), push(mass.size());
  for (double& value : x) value = static_cast<double>(random()) / std::mt19937::max() + 0.5;
  deflation.apply(x);
  double square = 0.0;
  int settled = 0;
  for (int k = 0; k < most_iterations; ++k) {
    for (std::size_t i = 0; i < x.size(); ++i) push[i] = mass[i] * x[i];
    const double norm = std::sqrt(dot(x, push));
    for (double& value : push) value /= norm;
    factor->solve(push, x);
    deflation.apply(x);
    // Rayleigh's quotient of x = K^-1 M y: y' M x / (x' M x), with y of unit mass.
    double inertia_of_x = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) inertia_of_x += mass[i] * x[i] * x[i];
    const double estimate = dot(push, x) / inertia_of_x - shift;
    settled = std::abs(estimate - square) <= tolerance * estimate ? settled + 1 : 0;
    square = estimate;
    if (settled == 2) return 2.0 * std::numbers::pi / std::sqrt(square);
  }
  throw SolverError(
      fmt::format("the fundamental period is not settled after {} iterations; give it in the case",
                  most_iterations));
}

}  // namespace perilink

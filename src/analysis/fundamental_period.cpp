#include "analysis/fundamental_period.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <random>

#include "assembly/stiffness.hpp"
#include "base/error.hpp"
#include "solver/factor.hpp"

namespace perilink {
namespace {

constexpr int most_iterations = 1000;
constexpr double tolerance = 1e-9;  // change of the eigenvalue, of two iterations in a row

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

}  // namespace

double fundamental_period(const Network& network, const Unknowns& unknowns, const Inertia& inertia,
                          int threads) {
  const std::vector<double> secants(static_cast<std::size_t>(network.num_elements()), 1.0);
  const std::unique_ptr<Factor> factor = make_factor(FactorRoute::in_place, threads);
  factor->factorize(assemble_stiffness(network, secants, unknowns), particle_of_unknown(unknowns));
  std::vector<double> mass;
  for (std::size_t slot = 0; slot < unknowns.number.size(); ++slot) {
    if (unknowns.number[slot] != no_index) mass.push_back(inertia.mass[slot]);
  }
  std::mt19937 random(1);  // the same start every time, with a part of every vibration
  std::vector<double> x(mass.size()), push(mass.size());
  for (double& value : x) value = static_cast<double>(random()) / std::mt19937::max() + 0.5;
  double square = 0.0;
  int settled = 0;
  for (int k = 0; k < most_iterations; ++k) {
    for (std::size_t i = 0; i < x.size(); ++i) push[i] = mass[i] * x[i];
    const double norm = std::sqrt(dot(x, push));
    for (double& value : push) value /= norm;
    factor->solve(push, x);
    // Rayleigh's quotient of x = K^-1 M y: y' M x / (x' M x), with y of unit mass.
    double inertia_of_x = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) inertia_of_x += mass[i] * x[i] * x[i];
    const double estimate = dot(push, x) / inertia_of_x;
    settled = std::abs(estimate - square) <= tolerance * estimate ? settled + 1 : 0;
    square = estimate;
    if (settled == 2) return 2.0 * std::numbers::pi / std::sqrt(square);
  }
  throw SolverError(
      fmt::format("the fundamental period is not settled after {} iterations; give it in the case",
                  most_iterations));
}

}  // namespace perilink

#include "solver/conjugate_gradients.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "solver/not_positive_definite.hpp"

namespace perilink {

double scalar_product(std::span<const double> first, std::span<const double> second) {
  return std::inner_product(first.begin(), first.end(), second.begin(), 0.0);
}

GradientsReport conjugate_gradients(const LinearMap& product, const LinearMap& precondition,
                                    std::span<const double> right, std::span<double> solution,
                                    double enough, double scale, int most_iterations,
                                    const ScalarProduct& dot) {
  const std::size_t size = right.size();
  GradientsReport report;
  std::vector<double> r(right.begin(), right.end()), z(size), p(size), q(size);
  EnergyGains gains;
  const auto is_enough = [&] {
    return report.error <= enough * std::sqrt(std::max(report.energy, scale));
  };
  precondition(r, z);
  p = z;
  double rz = dot(r, z);
  const double first = rz;
  if (rz <= negligible_correction * enough * enough * scale) {
    report.error = std::sqrt(rz);
    report.converged = true;
    return report;
  }
  while (rz > 0.0 && report.iterations < most_iterations) {
    product(p, q);
    const double curvature = dot(p, q);
    if (!(curvature > 0.0)) throw NotPositiveDefinite("the stiffness is not positive definite");
    const double step = rz / curvature;
    for (std::size_t k = 0; k < size; ++k) {
      solution[k] += step * p[k];
      r[k] -= step * q[k];
    }
    gains.add(step * rz);
    report.energy += step * rz;
    report.softest = first / report.energy;
    ++report.iterations;
    report.error = gains.error();
    if (is_enough()) break;
    precondition(r, z);
    const double next = dot(r, z);
    for (std::size_t k = 0; k < size; ++k) p[k] = z[k] + next / rz * p[k];
    rz = next;
  }
  report.converged =
      !(rz > 0.0) || report.error <= enough * std::sqrt(std::max(report.energy, scale));
  return report;
}

}  // namespace perilink

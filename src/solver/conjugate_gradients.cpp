#include "solver/conjugate_gradients.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "solver/not_positive_definite.hpp"

namespace perilink {

double scalar_product(std::span<const double> first, std::span<const double> second) {
  return std::inner_product(first.begin(), first.end(), second.begin(), 0.0);
}

GradientsReport conjugate_gradients(const LinearMap& product, const LinearMap& precondition,
                                    std::span<const double> right, std::span<double> solution,
                                    double enough, double scale, int most_iterations,
                                    const ScalarProduct& dot, const Correction& correct) {
  const std::size_t size = right.size();
  GradientsReport report;
  std::vector<double> r(right.begin(), right.end()), z(size), p(size), q(size);
  EnergyGains gains;
  const auto allowed = [&] { return enough * std::sqrt(std::max(report.energy, scale)); };
  precondition(r, z);
  p = z;
  double rz = dot(r, z), rp = rz;
  const double first = rz;
  double corrected_at = std::sqrt(rz);  // error where the residual was exact last
  if (rz <= negligible_correction * enough * enough * scale) {
    report.error = std::sqrt(rz);
    report.converged = true;
    return report;
  }
  while (rz > 0.0 && report.iterations < most_iterations) {
    product(p, q);
    const double curvature = dot(p, q);
    if (!(curvature > 0.0)) throw NotPositiveDefinite("the stiffness is not positive definite");
    const double step = rp / curvature;
    for (std::size_t k = 0; k < size; ++k) {
      solution[k] += step * p[k];
      r[k] -= step * q[k];
    }
    gains.add(step * rp);
    report.energy += step * rp;
    report.softest = first / report.energy;
    ++report.iterations;
    report.error = gains.error();
    const bool is_exact = !correct || 0.1 * digits_between_corrections * corrected_at <= allowed();
    report.converged = report.error <= allowed() && is_exact;
    if (report.converged) return report;
    precondition(r, z);
    double next = dot(r, z), share = next / rz;
    rp = next;
    if (correct && (std::sqrt(next) < digits_between_corrections * corrected_at ||
                    report.error <= allowed())) {
      correct(solution, r);
      precondition(r, z);
      next = dot(r, z);
      const double before = std::exchange(corrected_at, std::sqrt(next));
      if (!(corrected_at < least_gain_of_digits * before)) return report;
      share = -dot(q, z) / curvature;  // conjugate to the last direction, whatever the residual is
      rp = next + share * dot(p, r);
    }
    for (std::size_t k = 0; k < size; ++k) p[k] = z[k] + share * p[k];
    rz = next;
  }
  report.converged = !(rz > 0.0);
  return report;
}

}  // namespace perilink

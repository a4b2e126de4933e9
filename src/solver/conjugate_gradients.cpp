#include "solver/conjugate_gradients.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "solver/not_positive_definite.hpp"

namespace perilink {

namespace {

/// Numbers whose products are summed one after the other; the sums of such parts are added up in
/// order, so that they do not depend on the number of threads.
constexpr std::size_t part = 1 << 16;

}  // namespace

double scalar_product(std::span<const double> first, std::span<const double> second) {
  std::vector<double> sums((first.size() + part - 1) / part);
#pragma omp parallel for schedule(static) if (sums.size() > 1)
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const auto own = first.subspan(k * part, std::min(part, first.size() - k * part));
    sums[k] = std::inner_product(own.begin(), own.end(), second.begin() + k * part, 0.0);
  }
  return std::accumulate(sums.begin(), sums.end(), 0.0);
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
#pragma omp parallel for schedule(static) if (size > part)
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
    const double share = next / rz;
#pragma omp parallel for schedule(static) if (size > part)
    for (std::size_t k = 0; k < size; ++k) p[k] = z[k] + share * p[k];
    rz = next;
  }
  report.converged =
      !(rz > 0.0) || report.error <= enough * std::sqrt(std::max(report.energy, scale));
  return report;
}

}  // namespace perilink

#include "calibration/balance_measure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace perilink {

ParticleScales measure_particles(const Bonds& bonds, std::span<const double> axial,
                                 Index num_particles) {
  const std::size_t count = static_cast<std::size_t>(num_particles);
  ParticleScales scales{std::vector<double>(count, 0.0), std::vector<double>(count, 0.0)};
  std::vector<double> forces(count, 0.0);
  for (Index b = 0; b < bonds.size(); ++b) {
    const double force = axial[b] * bonds.length(b);
    for (const Index i : {bonds.first[b], bonds.second[b]}) {
      scales.modulus[i] += 0.5 * force * bonds.length(b);
      forces[i] += 0.5 * force;
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (forces[i] > 0.0) scales.length[i] = scales.modulus[i] / forces[i];
  }
  return scales;
}

void report_balance(const ForceRows& form, std::span<const double> rest,
                    std::span<const Index> particles, const ParticleScales& scales,
                    CalibrationReport& report) {
  const std::size_t rows = static_cast<std::size_t>(form.count());
  report.residual_after = report.moment_after = report.sum_after = 0.0;
  report.unmet = 0;
  report.worst_particle = no_index;
  for (const Index i : particles) {
    double force = 0.0, moment = 0.0;  // largest on this particle
    for (std::size_t r = 0; r < rows; ++r) {
      double size = std::abs(rest[i * rows + r]) / scales.modulus[i];
      if (!std::isfinite(size)) size = std::numeric_limits<double>::infinity();
      const bool is_force = static_cast<int>(r) < form.odd();
      double& largest = is_force ? force : moment;
      largest = std::max(largest, is_force ? size * scales.length[i] : size);
    }
    report.unmet += std::max(force, moment) > met_balance;
    report.sum_after += std::max(force, moment);
    if (std::max(force, moment) > std::max(report.residual_after, report.moment_after)) {
      report.worst_particle = i;
    }
    report.residual_after = std::max(report.residual_after, force);
    report.moment_after = std::max(report.moment_after, moment);
  }
}

void report_weights(std::span<const Index> free_bonds, std::span<const double> axial,
                    std::span<const double> start, double least_weight, CalibrationReport& report) {
  report.free_bonds = static_cast<Index>(free_bonds.size());
  report.at_least_weight = report.dropped = 0;
  for (const Index b : free_bonds) {
    if (axial[b] == 0.0) {
      ++report.dropped;
      continue;
    }
    const double weight = axial[b] / start[b];
    report.at_least_weight += weight <= 1.000001 * least_weight;
    report.smallest_weight = std::min(report.smallest_weight, weight);
    report.largest_weight = std::max(report.largest_weight, weight);
  }
}

}  // namespace perilink

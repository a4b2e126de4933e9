// What CalibrationEquations tell of the present state.

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibration/calibration_equations.hpp"

namespace perilink {

void CalibrationEquations::report_balance(CalibrationReport& report) const {
  const std::vector<double> rest = out_of_balance();
  const std::size_t rows = static_cast<std::size_t>(forces_.count());
  report.residual_after = report.moment_after = report.sum_after = 0.0;
  report.unmet = 0;
  report.worst_particle = no_index;
  for (const Index i : particle_of_) {
    double force = 0.0, moment = 0.0;  // largest on this particle
    for (std::size_t r = 0; r < rows; ++r) {
      double size = std::abs(rest[i * rows + r]) / modulus_[i];
      if (!std::isfinite(size)) size = std::numeric_limits<double>::infinity();
      const bool is_force = static_cast<int>(r) < forces_.odd();
      double& largest = is_force ? force : moment;
      largest = std::max(largest, is_force ? size * length_[i] : size);
    }
    report.unmet += std::max(force, moment) > met;
    report.sum_after += std::max(force, moment);
    if (std::max(force, moment) > std::max(report.residual_after, report.moment_after)) {
      report.worst_particle = i;
    }
    report.residual_after = std::max(report.residual_after, force);
    report.moment_after = std::max(report.moment_after, moment);
  }
}

void CalibrationEquations::report_weights(CalibrationReport& report) const {
  report.free_bonds = static_cast<Index>(free_bonds_.size());
  for (const Index b : free_bonds_) {
    if (stiffness_.axial[b] == 0.0) {
      ++report.dropped;
      continue;
    }
    const double weight = stiffness_.axial[b] / start_.stiffness.axial[b];
    report.at_least_weight += weight <= 1.000001 * least_weight_;
    report.smallest_weight = std::min(report.smallest_weight, weight);
    report.largest_weight = std::max(report.largest_weight, weight);
  }
}

bool CalibrationEquations::hollow() const {
  std::vector<Index> kept_minus_lost(static_cast<std::size_t>(input_.particles.size()), 0);
  for (Index b = 0; b < input_.bonds.size(); ++b) {
    const Index vote = stiffness_.axial[b] > 0.0 ? 1 : -1;
    for (const Index i : {input_.bonds.first[b], input_.bonds.second[b]})
      kept_minus_lost[i] += vote;
  }
  return std::any_of(particle_of_.begin(), particle_of_.end(),
                     [&](Index i) { return kept_minus_lost[i] < 0; });
}

}  // namespace perilink

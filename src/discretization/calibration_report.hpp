#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "discretization/calibration.hpp"

namespace perilink {

/// Writes what forces and moments are left into the report.
/// \param rest     out of balance, shape (particles, rows)
/// \param modulus  1/2 sum k xi^2 of each particle, 0: not calibrated
/// \param length   mean xi of each particle
/// \param met      forces below this are in balance
inline void report_forces(const ForceRows& equations, std::span<const double> rest,
                          std::span<const double> modulus, std::span<const double> length,
                          double met, CalibrationReport& report) {
  const std::size_t rows = static_cast<std::size_t>(equations.count());
  report.residual_after = report.moment_after = 0.0;
  report.unmet = 0;
  for (std::size_t i = 0; i < modulus.size(); ++i) {
    if (modulus[i] == 0.0) continue;
    double largest = 0.0;
    for (std::size_t r = 0; r < rows; ++r) {
      const double size = std::abs(rest[i * rows + r]) / modulus[i];
      if (!std::isfinite(size)) largest = std::numeric_limits<double>::infinity();
      if (static_cast<int>(r) < equations.odd()) {
        largest = std::max(largest, size * length[i]);
      } else {
        report.moment_after = std::max(report.moment_after, size);
      }
    }
    report.unmet += largest > met;
    if (largest <= report.residual_after) continue;
    report.residual_after = largest;
    report.worst_particle = static_cast<Index>(i);
  }
}

}  // namespace perilink

#pragma once

#include <span>
#include <vector>

#include "calibration/bond_equations.hpp"
#include "calibration/calibration_input.hpp"

/// \file Forces out of balance and changes of the bonds for the CalibrationReport.

namespace perilink {

/// Forces and moments out of balance above this are reported to the user, and are infeasible with
/// the floors of all bonds. Round-off leaves up to 1e-8 along boundaries of some hundred spacings.
inline constexpr double met_balance = 1e-7;

/// Scales of forces and moments out of balance, from the stiffnesses at the start.
struct ParticleScales {
  std::vector<double> modulus;  ///< 1/2 sum k xi^2 of each particle [force length]
  std::vector<double> length;   ///< mean xi of each particle [length]
};

ParticleScales measure_particles(const Bonds& bonds, std::span<const double> axial,
                                 Index num_particles);

/// Forces and moments out of balance, into the report.
/// \param rest       forces_out_of_balance() by this form [force], shape (all particles, rows)
/// \param particles  those that count
void report_balance(const ForceRows& form, std::span<const double> rest,
                    std::span<const Index> particles, const ParticleScales& scales,
                    CalibrationReport& report);

/// Weights of the free bonds, into the report.
/// \param axial, start  stiffnesses now and at the start [force/length], per bond
void report_weights(std::span<const Index> free_bonds, std::span<const double> axial,
                    std::span<const double> start, double least_weight, CalibrationReport& report);

}  // namespace perilink

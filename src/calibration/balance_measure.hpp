#pragma once

#include <span>
#include <vector>

#include "calibration/bond_equations.hpp"
#include "calibration/calibration_input.hpp"

/// \file Measures unbalanced forces and changes of the bonds for the CalibrationReport.

namespace perilink {

/// Unbalanced forces and moments above this are reported to the user, and are infeasible with the
/// lower bounds of all bonds. Round-off gives up to 1e-8 along boundaries of some hundred spacings.
inline constexpr double met_balance = 1e-7;

/// Scales of unbalanced forces and moments, from the stiffnesses at the start.
struct ParticleScales {
  std::vector<double> modulus;  ///< 1/2 sum k xi^2 of each particle [force length]
  std::vector<double> length;   ///< mean xi of each particle [length]
};

ParticleScales measure_particles(const Bonds& bonds, std::span<const double> axial,
                                 Index num_particles);

/// Writes unbalanced forces and moments to the report.
/// \param rest  result of forces_out_of_balance() [force], shape (all particles, rows)
/// \param particles  particles to measure
void report_balance(const ForceRows& form, std::span<const double> rest,
                    std::span<const Index> particles, const ParticleScales& scales,
                    CalibrationReport& report);

/// Writes the weights of the free bonds to the report.
/// \param axial, start  stiffnesses now and at the start [force/length], per bond
void report_weights(std::span<const Index> free_bonds, std::span<const double> axial,
                    std::span<const double> start, double least_weight, CalibrationReport& report);

}  // namespace perilink

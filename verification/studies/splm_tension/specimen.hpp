#pragma once

#include "analysis/explicit_analysis.hpp"

namespace perilink::verification {

/// Uniaxial tension of Nikravesh & Gerstle (2018, section 3.1) in N, m, kg, s: 0.15 m x 0.30 m,
/// 0.15 m thick, spacing 0.01 m, Table 1, both ends held within one spacing.
inline constexpr double tension_strength = 2.62e6;           ///< f_t [N/m^2]
inline constexpr double tension_section = 0.15 * 0.15;       ///< [m^2]
inline constexpr double tension_drive = 1.5 * 2e-4;          ///< 1.5 COD_c [m]
inline constexpr double tension_duration = 120.0 * 0.00042;  ///< [s]
inline constexpr double printed_time_step = 6.55e-7;         ///< [s]

/// The specimen with its lattice turned.
ExplicitModel tension_specimen(LatticeRules rules, double degrees);

struct TensionRun {
  ExplicitResult result;
  Index particles = 0;
  double fracture_energy = 0.0;  ///< of the law [J/m^2]
};

/// \param time_step  zero: nine tenths of the critical one [s]
/// \param duration   of the loading; the last fifth holds the displacement [s]
TensionRun run_tension(LatticeRules rules, double degrees, double time_step, double duration);

}  // namespace perilink::verification

#pragma once

#include <string>
#include <vector>

#include "analysis/dynamics/lattice/body/lattice_body.hpp"
#include "analysis/dynamics/lattice/lattice_analysis.hpp"
#include "io/case/case_file.hpp"
#include "model/from_case/configure.hpp"

namespace perilink {

/// Lattice and options of an explicit case.
struct ExplicitCase {
  ExplicitModel model;
  ExplicitOptions options;          ///< with one thread
  double critical_time_step = 0.0;  ///< [time]
  /// Fundamental period for external damping, given or computed; 0: not needed [time].
  double fundamental_period = 0.0;
  Index bonds = 0;
  /// Particles in the order of their slots, with prescribed motions and loads.
  Model places;
  std::vector<Gauge> gauges;
  std::vector<std::string> notes;  ///< for the user: particles removed by holes, point loads
                                   ///< moved to a particle
};

/// Sets duration, rows and steps of an explicit case of bonds or lattice particles.
/// \throws InputError for a time step above the critical one, or too many steps
void choose_steps(const CaseFile& input, double critical_time_step, ExplicitOptions& options);

/// Builds the lattice of a case with type = "explicit".
/// \throws InputError where the case does not fit its body: no lattice point in a region,
/// contradictory supports, a spacing too large for the softening, a time step above the critical, a
/// fundamental period that is needed but cannot be found
ExplicitCase build_explicit_case(const CaseFile& input);

}  // namespace perilink

#pragma once

#include <string>
#include <vector>

#include "analysis/dynamics/lattice/body/lattice_body.hpp"
#include "analysis/dynamics/lattice/lattice_analysis.hpp"
#include "app/model/from_case/configure.hpp"
#include "io/case/case_file.hpp"

namespace perilink {

/// A case of an explicit analysis turned into its lattice and options.
struct ExplicitCase {
  ExplicitModel model;
  ExplicitOptions options;          ///< threads left at one
  double critical_time_step = 0.0;  ///< [time]
  /// The period to which external damping refers, given or computed; 0: not asked for [time].
  double fundamental_period = 0.0;
  Index bonds = 0;
  /// Particles in the order of their slots, with what is prescribed for them and loads them.
  Model places;
  std::vector<Gauge> gauges;
  std::vector<std::string> notes;  ///< what the user should know: what holes take, point loads
                                   ///< that had to move
};

/// Duration, rows and steps of a case with type = "explicit", of bonds or of lattice particles.
/// \throws InputError for a time step above the critical one, or too many steps
void choose_steps(const CaseFile& input, double critical_time_step, ExplicitOptions& options);

/// Builds the lattice of a case with type = "explicit".
/// \throws InputError where the case makes no sense for its body: no lattice point in a region,
/// contradictory supports, a spacing too large for the softening, a time step above the critical, a
/// fundamental period that is needed but cannot be found
ExplicitCase build_explicit_case(const CaseFile& input);

}  // namespace perilink

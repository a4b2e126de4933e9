#pragma once

#include <string>
#include <vector>

#include "analysis/dynamics/bonds/runs/bond_analysis.hpp"

namespace perilink {

/// How a body is brought to rest.
struct RelaxationOptions {
  std::vector<double> load_factors = {1.0};  ///< one load step each
  double tolerance = 1e-6;                   ///< for RelaxationResult::residual and error
  Index most_iterations = 1000000;           ///< in a load step
  double safety = 0.95;                      ///< step over the critical one of the masses
  Strain strain = Strain::small;
  int threads = 1;
};

/// How a relaxation ended.
struct RelaxationResult {
  Termination termination = Termination::completed;
  std::string reason;
  Index iterations = 0;  ///< over all load steps
  /// Norm of the residual force over that of loads and reactions, the largest of the load steps
  /// that came to rest, or where the run ended otherwise.
  double residual = 0.0;
  /// Estimated relative error of the displacement, in the norm of the masses: the residual force
  /// over the stiffness of the slowest vibration. Likewise the largest.
  double error = 0.0;
  double peak_load = 0.0;  ///< largest support reaction in magnitude [force]
  ExplicitRecord last;     ///< end of the last load step that came to rest
  /// Where it ended, shape (particles, width).
  std::vector<double> displacement;
};

/// Masses that make all particles vibrate alike, whatever the material.
Inertia fictitious_inertia(const Network& network, Strain strain);

/// Static equilibrium by adaptive dynamic relaxation (Underwood 1983; Kilic & Madenci 2010): the
/// body moves with masses that are not its own, damped critically for its slowest vibration, until
/// the residual forces, and the displacement that they can still cause, are below the tolerance.
/// Masses are in proportion to the own stiffness of the particles, so that all steps are as long as
/// stability allows. The damping coefficient is twice the root of a Rayleigh quotient: of the
/// motion since the load step began, or of the last step where that is smaller; both are taken from
/// the forces themselves.
///
/// A load step starts from the last equilibrium in proportion to the load factors. Bonds break
/// where they exceed their limit on the way; many small load steps keep the motion, and with it
/// what breaks too much, small.
///
/// A row is one load step: its `step` counts iterations, its `time` load steps; work is that of the
/// load over its displacement between rows (trapezoidal rule), and what of it is neither stored nor
/// fractured was damped.
/// Ends as collapsed where broken bonds have left the body in pieces that the loads pull apart, or
/// that no prescribed displacement strains; the last row of a driven body then shows it without
/// resistance.
/// \returns ending = failed where a load step needs more iterations than it may have, or the motion
/// grows without bound; interrupted where the observer asked for it
RelaxationResult run_dynamic_relaxation(const LoadedNetwork& problem,
                                        const RelaxationOptions& options,
                                        BondRunObserver& observer);

}  // namespace perilink

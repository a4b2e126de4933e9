#pragma once

#include <string>
#include <vector>

#include "analysis/dynamics/bonds/runs/bond_analysis.hpp"

namespace perilink {

/// Options of a dynamic relaxation.
struct RelaxationOptions {
  std::vector<double> load_factors = {1.0};  ///< one per load step
  double tolerance = 1e-6;                   ///< limit of RelaxationResult::residual and error
  Index most_iterations = 1000000;           ///< per load step
  double safety = 0.95;  ///< time step over the critical one of the fictitious masses
  Strain strain = Strain::small;
  int threads = 1;
};

/// Result of a dynamic relaxation.
struct RelaxationResult {
  Termination termination = Termination::completed;
  std::string reason;
  Index iterations = 0;  ///< over all load steps
  /// Norm of the residual force over that of loads and reactions [-]: the largest of the converged
  /// load steps, or the value where the run failed.
  double residual = 0.0;
  /// Estimated relative error of the displacement, in the norm of the masses: the residual force
  /// over the stiffness of the slowest vibration [-]. The largest of the converged load steps, or
  /// the value where the run failed.
  double error = 0.0;
  double peak_load = 0.0;  ///< largest support reaction in magnitude [force]
  ExplicitRecord last;     ///< end of the last converged load step
  /// Last displacement, shape (particles, width).
  std::vector<double> displacement;
};

/// Returns masses with which all particles vibrate at one frequency, whatever their material.
Inertia fictitious_inertia(const Network& network, Strain strain);

/// Finds static equilibrium by adaptive dynamic relaxation (Underwood 1983; Kilic & Madenci 2010).
/// The body moves with fictitious masses, damped critically for its slowest vibration. A load step
/// has converged when the residual forces, and the displacement that they can still cause, are
/// below the tolerance. Masses are proportional to the own stiffness of the particles, so that all
/// steps are as long as stability allows. The damping coefficient is twice the root of a Rayleigh
/// quotient. The quotient is that of the motion since the load step began, or of the last step
/// where it is smaller. Both are taken from the forces.
///
/// A load step starts from the last equilibrium, scaled by the load factors. Bonds break where they
/// exceed their limit during the motion. Small load steps keep the motion small, and with it the
/// number of bonds broken by overshoot.
///
/// A row is one load step: `step` counts iterations and `time` load steps. Work is that of the load
/// over its displacement between rows (trapezoidal rule). Work neither stored nor fractured was
/// damped.
///
/// The run ends as collapsed where the loads pull broken-off pieces apart. It also does where
/// prescribed displacements strain no piece any more; the last row then shows the body without
/// resistance.
/// \param from  state in which a run of this problem and these options was saved after a load step;
///              null: the run starts with the first load step
/// \throws std::invalid_argument where `from` is of another body or other load steps
/// \returns termination = failed where a load step needs too many iterations or the motion grows
///          without bound; interrupted where the observer asked for it
RelaxationResult run_dynamic_relaxation(const LoadedNetwork& problem,
                                        const RelaxationOptions& options, BondRunObserver& observer,
                                        const TimeState* from = nullptr);

}  // namespace perilink

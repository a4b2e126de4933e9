#pragma once

#include <memory>

#include "analysis/quasistatic/equilibrium/update/update.hpp"
#include "analysis/quasistatic/subdomains/subdomain_solver.hpp"
#include "network/loaded_network.hpp"
#include "solver/factor_route.hpp"
#include "solver/linear_solver.hpp"

namespace perilink {

/// Options of the equilibrium solver.
struct EquilibriumOptions {
  FactorRoute route = FactorRoute::in_place;
  double residual_tolerance = 1e-10;
  int threads = 1;
  LinearSolver solver = LinearSolver::automatic;
  SubdomainSolverOptions subdomains = {};  ///< used if conjugate gradients replace the factor
  /// Relative difference of load factors within which elements whose laws have segments fail
  /// together; 0: one by one.
  double event_tolerance = 0.0;
};

/// Unknowns of a three-dimensional body above which conjugate gradients with subdomains follow a
/// batch faster than a factor (docs/theory/large_bodies.md, section 5).
inline constexpr Index fewest_for_subdomains = 15000;

/// Returns whether conjugate gradients replace a factor that follows every event. They do if the
/// options ask for them, and for batches in large three-dimensional bodies
/// (docs/theory/large_bodies.md, section 5).
bool is_followed_by_subdomains(const LoadedNetwork& problem, const EquilibriumOptions& options);

/// Makes the update that the options ask for.
/// \throws std::invalid_argument if conjugate gradients are asked for and particles are embedded
std::unique_ptr<Update> make_update(const DamagedBody& body, const LoadedNetwork& problem,
                                    const EquilibriumOptions& options);

}  // namespace perilink

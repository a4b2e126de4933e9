#include "analysis/quasistatic/equilibrium/update/make_update.hpp"

#include <stdexcept>

#include "analysis/quasistatic/equilibrium/update/column_update.hpp"
#include "analysis/quasistatic/equilibrium/update/factor_update.hpp"

namespace perilink {

bool is_followed_by_subdomains(const LoadedNetwork& problem, const EquilibriumOptions& options) {
  if (options.solver != LinearSolver::automatic) return options.solver == LinearSolver::iterative;
  const Network& network = problem.network;
  const bool is_solid = network.dim() == 3 && !network.shell && !network.is_beam();
  const bool is_plain = !problem.embedded && !problem.unknowns.carries() && problem.sets.empty() &&
                        network.first_slip_spring == network.num_elements() &&
                        !network.has_states();
  if (!(options.event_tolerance > 0.0) || options.route != FactorRoute::in_place || !is_solid ||
      !is_plain || problem.unknowns.count < fewest_for_subdomains) {
    return false;
  }
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (network.has_limit(e) && network.law(e).is_brittle()) return false;
  }
  return true;
}

std::unique_ptr<Update> make_update(const DamagedBody& body, const LoadedNetwork& problem,
                                    const EquilibriumOptions& options) {
  const bool in_batches = options.event_tolerance > 0.0;
  if (!is_followed_by_subdomains(problem, options)) {
    return std::make_unique<FactorUpdate>(body, options.route, options.threads, in_batches);
  }
  if (problem.embedded) {
    throw std::invalid_argument(
        "conjugate gradients with subdomains do not support embedded particles");
  }
  return std::make_unique<ColumnUpdate>(body, options.subdomains, in_batches);
}

}  // namespace perilink

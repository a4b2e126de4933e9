#include "analysis/quasistatic/equilibrium/displacement/element_deformations.hpp"

#include <cmath>

namespace perilink {

Removal removal_of(const Solution& solution, const Weakening& change) {
  const auto& [element, secant] = change;
  const DamagedBody& body = solution.body();
  Removal removal = body.removal(body.unknowns(), element, secant);
  const PermanentLoad* const permanent = solution.permanent();
  if (permanent == nullptr) return removal;
  const Removal own = body.removal(permanent->unknowns(), element, secant);
  for (int m = 0; m < own.rank; ++m) {
    removal.constant[m] = own.deformation(m, permanent->field().values);
  }
  return removal;
}

Removal::Deformations deformations(const Solution& solution, const Removal& removal,
                                   Index element) {
  const Network& network = solution.body().network();
  const Field& field = solution.growing().field();
  Removal::Deformations result{};
  if (network.carries_moments() && network.bending[element] > 0.0) {
    for (int m = 0; m < removal.rank; ++m) result[m] = removal.deformation(m, field.values);
    return result;
  }
  const auto width = static_cast<std::size_t>(network.width());
  const std::size_t i = static_cast<std::size_t>(network.bonds.first[element]) * width;
  const std::size_t j = static_cast<std::size_t>(network.bonds.second[element]) * width;
  const std::span<const double> n = network.bonds.direction(element);
  const double root = std::sqrt(network.stiffness[element] * removal.fraction);
  for (int a = 0; a < network.dim(); ++a) {
    result[0] += root * n[a] * (field.displacement[j + a] - field.displacement[i + a]);
  }
  return result;
}

Removal::Deformations deformations_now(const Solution& solution, const Removal& removal,
                                       Index element) {
  Removal::Deformations result = deformations(solution, removal, element);
  if (solution.permanent() == nullptr) return result;
  const double load_factor = solution.permanent()->load_factor();
  for (int m = 0; m < removal.rank; ++m) {
    result[m] = removal.constant[m] + load_factor * result[m];
  }
  return result;
}

double square_of(const Removal::Deformations& deformations) {
  double square = 0.0;
  for (const double deformation : deformations) square += deformation * deformation;
  return square;
}

double energy_lost(const Solution& solution, const Weakening& change) {
  const Removal removal = removal_of(solution, change);
  return square_of(deformations_now(solution, removal, change.element));
}

double release(const Solution& solution, const Removal& removal,
               const Removal::Deformations& growing, EventOutcome& outcome) {
  const double energy = square_of(growing), released = 0.5 * energy;
  outcome.released += released;
  if (solution.permanent() == nullptr) return energy;
  Beside beside;
  for (int m = 0; m < removal.rank; ++m) {
    beside.linear += growing[m] * removal.constant[m];
    beside.constant += 0.5 * removal.constant[m] * removal.constant[m];
  }
  outcome.released_by_permanent += beside;
  const double now = solution.permanent()->load_factor();
  return 2.0 * (now * now * released + beside.at(now));
}

}  // namespace perilink

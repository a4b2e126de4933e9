// Weakening of elements: changes of rank one, three and six of K^-1, batches, and ground springs
// for loose parts.

#include <algorithm>
#include <cmath>

#include "analysis/quasistatic/equilibrium/displacement/element_deformations.hpp"
#include "analysis/quasistatic/equilibrium/equilibrium.hpp"
#include "analysis/quasistatic/equilibrium/event_batch.hpp"
#include "base/error.hpp"
#include "base/rare_branch.hpp"

namespace perilink {
namespace {

/// Fraction of the bond's energy above which a motion that a removal frees carries load [-].
/// Round-off leaves 1e-16.
constexpr double least_loaded_share = 1e-12;

/// Fraction of the load above which the force on a loose part counts as load [-].
constexpr double least_loaded_force = 1e-6;

/// Returns the unknown that forces along a vector move most.
Index most_mobile_unknown(Factor& factor, const SparseVector& x) {
  const std::vector<double> direction = factor.columns({&x, 1});
  const auto largest = std::max_element(direction.begin(), direction.end(), [](double a, double b) {
    return std::abs(a) < std::abs(b);
  });
  return static_cast<Index>(largest - direction.begin());
}

/// Returns the stiffness of the stiffest bond; for a rotation the largest bending stiffness.
/// \param component  of a particle
double ground_stiffness_of(const Network& network, int component) {
  if (component < network.dim()) {
    return *std::max_element(network.stiffness.begin(),
                             network.stiffness.begin() + network.first_slip_spring);
  }
  double largest = 0.0;
  for (Index e = 0; e < network.first_slip_spring; ++e) {
    largest = std::max(largest, network.bending[e] * std::pow(network.bonds.length(e), 2));
  }
  return largest;
}

}  // namespace

/// Adds ground springs before a removal that frees an unloaded motion. An example is the rotation
/// of a particle that only slip springs hold.
/// \param unloaded  twice the energy up to which a motion counts as unloaded
/// \return false if the motion carries load: a mechanism
bool Equilibrium::hold_free_modes(Removal& removal, Index element, double unloaded, int& springs) {
  const Removal modes = removal_of(solution_, {element, 0.0});
  const int most = body_.network().dim() == 2 ? 3 : 6;
  for (int tries = 0; removal.rank > 0 && removal.pivot[0] == 0.0; ++tries) {
    const auto deformation = deformations_now(solution_, removal, element);
    double energy = 0.0;
    for (int m = 0; m < removal.rank && removal.pivot[m] == 0.0; ++m) {
      energy += deformation[m] * deformation[m];
    }
    if (!(energy <= unloaded)) return false;
    if (tries == most) {
      throw SolverError("a part that comes loose cannot be held by ground springs");
    }
    solution_.keep_all_current();
    add_ground_spring(most_mobile_unknown(update_->inverse(), removal.x[0]));
    ++springs;
    removal = modes;
    separation_.measure_pivots(removal, element, 0.0);
  }
  return true;
}

void Equilibrium::add_ground_spring(Index unknown) {
  const Network& network = body_.network();
  const auto component = static_cast<int>(body_.slots()[unknown] % network.width());
  const double stiffness = ground_stiffness_of(network, component);
  SparseVector x;
  x.add(unknown, std::sqrt(stiffness));
  update_->inverse().update(x);
  body_.add_ground_spring(unknown, stiffness);
  solution_.add_ground_spring(unknown, stiffness);
}

/// Updates work products by the growth of the compliance.
/// \param changed_inverse  K^-1 was changed, not made anew: f'u was not summed
void Equilibrium::follow(const EventOutcome& outcome, bool changed_inverse) {
  const double growth = outcome.compliance_growth;
  if (changed_inverse) solution_.growing().add_work(growth);
  // Small events keep the accuracy of the displacements.
  const bool is_sure = outcome.pivot > uncertain_pivot && !separation_.doubts_pivots() &&
                       growth < 0.01 * work_.last();
  work_.grow(growth, is_sure);
}

/// Changes K^-1 and displacements, unless they already belong to the weaker element.
void Equilibrium::commit(const Removal& removal, const Weakening& change) {
  if (!removal.needs_new_inverse) update_->announce(removal.vectors());
  body_.weaken(change.element, change.secant);
  if (removal.needs_new_inverse || removal.acts_on_nothing()) return;
  solution_.follow(removal);
  if (separation_.doubts_pivots()) separation_.refine();
}

EventOutcome Equilibrium::weaken(Index element, double secant) {
  const double before = body_.secant_of(element);
  const bool was_intact = body_.secants()[element] == 1.0;
  solution_.bring_inverse_up();
  if (!body_.network().has_limit(element)) solution_.keep_all_current();
  Removal removal = removal_of(solution_, {element, secant});
  separation_.measure_pivots(removal, element, secant);
  EventOutcome outcome;
  outcome.secant = secant;
  const double energy =
      release(solution_, removal, deformations(solution_, removal, element), outcome);
  int springs = 0;
  outcome.mechanism = outcome.broke()
                          ? !hold_free_modes(removal, element, least_loaded_share * energy, springs)
                          : removal.pivot[0] == 0.0;
  outcome.pivot = removal.pivot[0];
  if (outcome.mechanism) return outcome;
  const auto deformation = deformations(solution_, removal, element);
  for (int m = 0; m < removal.rank; ++m) {
    outcome.compliance_growth += deformation[m] * deformation[m] / removal.pivot[m];
    const double held = removal.constant[m];
    outcome.permanent_growth.linear += 2.0 * deformation[m] * held / removal.pivot[m];
    outcome.permanent_growth.constant += held * held / removal.pivot[m];
  }
  outcome.mechanism = separation_.hangs_on_weak_supports(removal, outcome.compliance_growth) ||
                      (removal.needs_new_inverse && !separation_.rebuild_without(element, secant));
  if (outcome.mechanism) return outcome;
  follow(outcome, !removal.needs_new_inverse);
  commit(removal, {element, secant});
  if (take_rare_branch("early factor")) solution_.renew();
  if (body_.has_sides()) sides_.settle(outcome);
  if (!outcome.mechanism) return outcome;
  sides_.take_back();
  body_.take_back(element, before, was_intact);
  work_.sum_anew();
  solution_.renew();
  return outcome;
}

std::optional<EventOutcome> Equilibrium::weaken_together(std::span<const Weakening> changes) {
  const auto stands_alone = [&](const Weakening& change) {
    const bool closed = body_.has_sides() && body_.is_closed(change.element);
    return closed || !body_.network().has_limit(change.element);
  };
  if (separation_.doubts_pivots() || std::ranges::any_of(changes, stands_alone) ||
      take_rare_branch("no batch")) {
    return std::nullopt;
  }
  sides_.begin();
  EventBatch batch(body_, solution_, changes);
  EventOutcome outcome;
  outcome.secant = 1.0;
  const bool resists = batch.apply(outcome);
  if (resists) {
    follow(outcome, batch.changed_inverse());
    try {
      if (body_.has_sides()) sides_.settle(outcome);
    } catch (const SolverError&) {
      outcome.mechanism = true;
    }
    if (!outcome.mechanism) return outcome;
  }
  sides_.take_back();
  work_.sum_anew();
  batch.take_back(resists);
  return std::nullopt;
}

int Equilibrium::cut(Index element) {
  solution_.bring_inverse_up();
  solution_.keep_all_current();
  if (body_.has_sides() && body_.is_closed(element)) sides_.open(element);
  if (body_.secants()[element] == 0.0) return 0;
  Removal removal = removal_of(solution_, {element, 0.0});
  separation_.measure_pivots(removal, element, 0.0);
  int springs = 0;
  // Twice the energy of a spring under the least loaded force; forces and moments are compared
  // directly.
  const double unloaded = std::pow(least_loaded_force * solution_.growing().field().load_norm, 2) /
                          (body_.network().stiffness[element] * body_.secant_of(element));
  if (!hold_free_modes(removal, element, unloaded, springs)) {
    throw SolverError("the part that comes loose carries load: the body has separated");
  }
  if (removal.needs_new_inverse && !separation_.rebuild_without(element, 0.0)) {
    throw SolverError("the stiffness matrix without the loose part cannot be factorised");
  }
  commit(removal, {element, 0.0});
  if (body_.has_sides()) sides_.follow_broken();
  return springs;
}

}  // namespace perilink

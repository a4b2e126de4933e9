#include "analysis/quasistatic/equilibrium/event_batch.hpp"

#include "analysis/quasistatic/equilibrium/separation.hpp"
#include "base/error.hpp"
#include "base/rare_branch.hpp"
#include "solver/conjugate_gradients.hpp"

namespace perilink {
namespace {

/// Returns x'u.
double along(const SparseVector& x, std::span<const double> u) {
  double sum = 0.0;
  for (int k = 0; k < x.size(); ++k) sum += x.values[k] * u[x.rows[k]];
  return sum;
}

}  // namespace

EventBatch::EventBatch(DamagedBody& body, Solution& solution, std::span<const Weakening> changes)
    : body_(body),
      solution_(solution),
      before_(solution.save()),
      lagged_(solution.update().lags()) {
  for (const Weakening& change : changes) {
    Member member{change, removal_of(solution, change),   {},
                  {},     body.secant_of(change.element), body.secants()[change.element] == 1.0};
    member.growing = deformations(solution, member.removal, change.element);
    for (int m = 0; solution.permanent() != nullptr && m < member.removal.rank; ++m) {
      member.beside[m] = along(member.removal.x[m], before_.permanent);
    }
    members_.push_back(std::move(member));
  }
}

bool EventBatch::apply(EventOutcome& outcome) {
  const double removed = weaken(outcome);
  if (!follow(outcome.pivot)) return false;
  for (const Member& member : members_) add_growth(member, outcome);
  // Elements whose strain grows very much without their stiffness held the body.
  return outcome.compliance_growth * uncertain_pivot <= removed &&
         outcome.pivot > uncertain_pivot && resists() && !take_rare_branch("batch taken back");
}

/// Weakens the elements.
/// \return twice the energy that they lose
double EventBatch::weaken(EventOutcome& outcome) {
  double removed = 0.0;
  for (const Member& member : members_) {
    release(solution_, member.removal, member.growing, outcome);
    removed += square_of(member.growing);
  }
  for (const Member& member : members_) body_.weaken(member.change.element, member.change.secant);
  return removed;
}

/// Adds the growth of f'u - R'd from one equilibrium to the other, u_1' (K_1 - K_2) u_2.
void EventBatch::add_growth(const Member& member, EventOutcome& outcome) const {
  const Removal& removal = member.removal;
  const auto after = deformations(solution_, removal, member.change.element);
  for (int m = 0; m < removal.rank; ++m) outcome.compliance_growth += member.growing[m] * after[m];
  if (solution_.permanent() == nullptr) return;
  const std::vector<double>& permanent = solution_.permanent()->field().values;
  for (int m = 0; m < removal.rank; ++m) {
    const double held = removal.constant[m];
    const double holds = held + along(removal.x[m], permanent) - member.beside[m];
    outcome.permanent_growth.linear += member.growing[m] * holds + held * after[m];
    outcome.permanent_growth.constant += held * holds;
  }
}

/// Finds the equilibrium of the present secants.
/// \param pivot  smallest pivot of the batch, if a change of K^-1 reports it
/// \return false if no equilibrium is found
bool EventBatch::follow(double& pivot) {
  Update& update = solution_.update();
  double path = 0.0;
  for (const Member& member : members_) path += update.inverse().path_of(member.removal.vectors());
  way_ = update.cheapest_way(path);
  if (way_ == Way::change) return change_inverse(pivot);
  keeps_inverse_ = way_ != Way::renew;
  try {
    if (keeps_inverse_ && solution_.search()) return true;
    if (way_ == Way::search_only) return false;
    keeps_inverse_ = false;
    solution_.renew();
    return true;
  } catch (const SolverError&) {
    return false;
  }
}

bool EventBatch::change_inverse(double& pivot) {
  std::vector<SparseVector> vectors;
  ForceOfElements forces(body_.num_unknowns());
  for (const Member& member : members_) {
    for (int m = 0; m < member.removal.rank; ++m) {
      vectors.push_back(member.removal.x[m]);
      forces.add(member.removal.x[m], member.growing[m], member.removal.constant[m]);
    }
  }
  pivot = solution_.update().inverse().downdate_together(vectors);
  if (!(pivot > uncertain_pivot)) return false;
  solution_.follow_forces(forces);
  return true;
}

/// Returns whether the body resists where elements have broken, in motions that the loads do not
/// excite. Forces along their vectors then do little work. Needed only if a change of K^-1 has not
/// reported their pivots.
bool EventBatch::resists() {
  if (changed_inverse()) return true;
  VariedForces forces(body_.num_unknowns());
  for (const Member& member : members_) {
    if (member.change.secant != 0.0) continue;
    for (const SparseVector& x : member.removal.vectors()) forces.add(x);
  }
  if (forces.count == 0.0) return true;
  std::vector<double> motion = forces.load;
  try {
    solution_.update().solve_roughly(motion, forces.count);
  } catch (const SolverError&) {
    return false;
  }
  const double work = scalar_product(forces.load, motion);
  return work >= 0.0 && work * uncertain_pivot < forces.count;
}

void EventBatch::take_back(bool settled) {
  for (const Member& member : members_) {
    body_.take_back(member.change.element, member.secant, member.was_intact);
  }
  if (settled || !keeps_inverse_) return solution_.renew();
  solution_.update().take_back_search(lagged_);
  solution_.take_back(std::move(before_));
}

}  // namespace perilink

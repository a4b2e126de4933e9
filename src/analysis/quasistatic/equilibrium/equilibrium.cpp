#include "analysis/quasistatic/equilibrium/equilibrium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "base/rare_branch.hpp"
#include "solver/conjugate_gradients.hpp"

namespace perilink {
namespace {

/// Residual of a new K^-1 above which all further figures would be meaningless [-].
constexpr double hopeless_residual = 1e-3;

/// Residuals up to this many tolerances are removed by a plain step of refinement if a new K^-1
/// leaves as much. Double precision has enough digits for it.
constexpr double most_to_refine = 10.0;

std::vector<double> ground_load_of(const LoadedNetwork& problem, const ElementState* saved) {
  if (saved == nullptr) return {};
  return problem.sets.empty() ? saved->ground_load : saved->constant_ground_load;
}

}  // namespace

Equilibrium::Equilibrium(const LoadedNetwork& problem, const EquilibriumOptions& options,
                         const Unknowns* unknowns, const ElementState* saved)
    : tolerance_(options.residual_tolerance),
      body_(problem, unknowns != nullptr ? *unknowns : problem.unknowns, saved),
      update_(make_update(body_, problem, options)),
      solution_(body_, *update_, problem.loads, ground_load_of(problem, saved)),
      work_(solution_),
      separation_(body_, solution_, work_),
      sides_(body_, solution_, separation_, work_) {
  adopt_motion(body_.unknowns(), saved != nullptr);
  if (!body_.ground_stiffness().empty()) solution_.keep_all_current();
  // Stages open initial cracks as their loads begin to grow.
  if (saved != nullptr || !problem.sets.empty() || body_.unilateral().empty()) return;
  EventOutcome outcome;
  sides_.settle(outcome);
  if (outcome.mechanism) throw CracksSeparate();
}

ElementState Equilibrium::state() const {
  ElementState state = body_.state();
  state.ground_load = solution_.growing().field().ground_load;
  const PermanentLoad* const permanent = solution_.permanent();
  if (permanent != nullptr) state.constant_ground_load = permanent->field().ground_load;
  return state;
}

/// Finds the equilibrium under these unknowns with a new K^-1.
/// \param resists  see Update::begin()
void Equilibrium::adopt_motion(const Unknowns& unknowns, bool resists) {
  body_.set_unknowns(unknowns);
  if (solution_.permanent() != nullptr) solution_.permanent()->set_unknowns(unknowns);
  solution_.begin(resists, work_.is_driven());
  reachable_ = {solution_.find()};
}

Freedom Equilibrium::change_motion(const Unknowns& unknowns) {
  if (!body_.ground_stiffness().empty()) {
    throw SolverError("the unknowns cannot change while ground springs hold a loose part");
  }
  if (unknowns.prescribed != body_.unknowns().prescribed) {
    throw std::invalid_argument("new unknowns must keep the prescribed motions");
  }
  solution_.bring_inverse_up();
  solution_.make_current();
  work_.sum_anew();
  const LoadWork before = work();
  const Unknowns& old = body_.unknowns();
  try {
    adopt_motion(unknowns, false);
    EventOutcome sides;
    if (body_.has_sides()) sides_.settle(sides);
    if (sides.mechanism) {
      throw SolverError("only closed bonds would hold the released particles");
    }
    work_.sum_anew();
    const LoadWork after = work();
    if (before.separated || after.separated) {
      throw SolverError(
          "the unknowns cannot change while the body does not resist the prescribed displacements");
    }
    return {after.compliance() - before.compliance(),
            permanent_growth(before.constant, after.constant)};
  } catch (const std::exception&) {
    adopt_motion(old, false);
    throw;
  }
}

void Equilibrium::begin_stage(const Unknowns& unknowns, const Loads& loads,
                              ConstantLoads permanent) {
  // The caller may have changed the former unknowns themselves: K^-1 is of another size if
  // particles were clamped, and made anew below.
  const bool fewer_move = static_cast<std::size_t>(unknowns.count) != body_.num_unknowns();
  if (!fewer_move) solution_.bring_inverse_up();
  solution_.keep_all_current();
  if (fewer_move && !body_.ground_stiffness().empty()) {
    throw SolverError("particles cannot be clamped while ground springs hold a loose part");
  }
  body_.set_unknowns(unknowns);
  solution_.begin_stage(loads, std::move(permanent));
  work_.begin_stage();
  if (fewer_move) {
    solution_.begin(false, true);
  } else if (restored_) {
    solution_.renew();
  }
  restored_ = false;
  reachable_ = {solution_.find()};
}

void Equilibrium::go_on(const ElementState& saved) {
  if (saved.ground_load.empty()) return;
  solution_.growing().set_ground_load(saved.ground_load);
  solution_.refresh();
}

void Equilibrium::restore(std::span<const Index> elements) {
  for (const Index element : elements) body_.set_secant(element, 1.0);
  restored_ = restored_ || !elements.empty();
}

std::span<const double> Equilibrium::displacement(std::span<const double> earlier,
                                                  Secants secants) {
  if (earlier.empty()) return solution_.growing().displacement();
  const bool may_lack =
      update_->can_follow_a_part() && !work_.is_driven() && solution_.permanent() == nullptr;
  return may_lack ? solution_.growing().displacement(earlier, secants, tolerance_) : earlier;
}

LoadWork Equilibrium::work() {
  LoadWork work = work_of_growing();
  work.constant = solution_.constant_work();
  return work;
}

/// Returns the work of forces and reactions of the growing loads.
LoadWork Equilibrium::work_of_growing() {
  const double forces = solution_.growing().work();
  if (!solution_.growing().is_whole() || !work_.is_driven()) return {forces, 0.0};
  if (const auto followed = work_.followed(forces)) return *followed;
  const auto sum = work_.sum();
  return work_.follow(sum ? *sum : separation_.work_by_energy());
}

EventOutcome Equilibrium::pass_side_change(double direction) {
  EventOutcome outcome;
  outcome.secant = 1.0;
  sides_.settle(outcome, direction);
  return outcome;
}

Balance Equilibrium::check_cheaply() {
  const bool has_part = !solution_.growing().is_current() && solution_.growing().has_checked_part();
  if (!has_part || take_rare_branch("full check")) return check();
  const double residual = solution_.growing().residual_of_part();
  if (residual <= std::max(tolerance_, reachable_.refined)) {
    return {residual, std::numeric_limits<double>::quiet_NaN()};
  }
  return check();
}

Balance Equilibrium::check() {
  Balance balance = check_growing();
  if (solution_.permanent() != nullptr) check_permanent(balance);
  return balance;
}

Balance Equilibrium::check_growing() {
  solution_.make_current();
  GrowingLoad& growing = solution_.growing();
  Residual residual = growing.residual();
  // Written so that a residual that is not a number exceeds every tolerance.
  if (const auto drift = update_->drift(); drift && !(residual.size <= drift->removed)) {
    const std::vector<double> missing = residual.forces;
    growing.refine(residual);  // the forces become the correction
    update_->judge(scalar_product(missing, residual.forces), 2.0 * residual.energy);
    if (!(residual.size <= std::max(tolerance_, drift->doubtful))) separation_.doubt_pivots();
    residual = growing.residual();
  }
  if (residual.size <= tolerance_) reachable_.refined = 0.0;
  if (residual.size <= std::max(tolerance_, reachable_.refined) &&
      !take_rare_branch("refinement")) {
    return {residual.size, residual.energy};
  }
  work_.sum_anew();
  if (update_->lags()) {
    solution_.renew();
    residual = growing.residual();
  }
  if (residual.size <= std::min(2.0 * reachable_.unrefined, most_to_refine * tolerance_)) {
    // K^-1 is as accurate as a new one, whose solutions need a step of refinement here.
    growing.refine(residual);
    residual = growing.residual();
    if (residual.size <= tolerance_) return {residual.size, residual.energy};
  }
  return refine();
}

/// Refines the displacements, with a new K^-1 if the present one is not accurate enough.
Balance Equilibrium::refine() {
  const double tolerance = std::max(tolerance_, reachable_.refined);
  SeparationCheck::Refinement refined = separation_.refine();
  // Refined displacements do not help the next event, which depends on K^-1.
  const double usable = std::max(tolerance_, reachable_.inverse);
  if (!(refined.balance.residual <= tolerance) || !(refined.inverse_error <= usable)) {
    solution_.renew();
    reachable_.unrefined = solution_.growing().residual().size;
    refined = separation_.refine();
    // A nearly separated body moves so far that even a new K^-1 leaves more than the tolerance.
    // Making it again for less than twice that would be useless.
    reachable_.refined = 2.0 * refined.balance.residual;
    reachable_.inverse = 2.0 * refined.inverse_error;
    if (!(refined.balance.residual <= hopeless_residual)) {
      throw SolverError(fmt::format(
          "a fresh factor leaves {:.1e} of the load out of balance: the body is on the verge of "
          "separation and its stiffness matrix is singular to working precision",
          refined.balance.residual));
    }
  }
  if (refined.balance.residual <= tolerance_) reachable_.refined = 0.0;
  return refined.balance;
}

/// Adds the contribution of permanent loads; refines their displacements if necessary.
void Equilibrium::check_permanent(Balance& balance) {
  const PermanentLoad& permanent = *solution_.permanent();
  if (permanent.rests()) return;
  InternalForce internal;
  Residual residual = permanent.residual(internal);
  const auto drift = update_->drift();
  if (!(residual.size <= (drift ? drift->removed : tolerance_))) {
    separation_.refine_permanent();
    residual = permanent.residual(internal);
  }
  balance.residual = std::max(balance.residual, residual.size);
  balance.stored_by_permanent.constant = residual.energy;
  const std::vector<double>& displacement = solution_.growing().field().displacement;
  for (std::size_t slot = 0; slot < displacement.size(); ++slot) {
    balance.stored_by_permanent.linear += internal.forces[slot] * displacement[slot];
  }
}

}  // namespace perilink

#include "calibration/balance_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/balance_measure.hpp"

namespace perilink {
namespace {

/// Where a factor leaves every step a hundredth of the residual at most, coarse searches take it
/// for a contradiction when a tenth is left.
constexpr double contradiction_by_factor = 0.1;
/// Where it leaves so many times the least so far, it climbs for a contradiction alone.
constexpr double lost_by_factor = 1000.0;

/// Energies are fitted again where more than this part of the bonds was dropped.
constexpr double few_dropped = 0.01;

/// Searches in space, at most.
constexpr int most_refinements = 3;

/// Zeros stay where they bring the forces out of balance down to this part.
constexpr double worth_dropping = 0.1;
/// The search for them ends where this part will be left: five times as much. What it asks for is a
/// mean of all particles, but not so rough that one of them could be left so much.
constexpr double far_from_worth = 0.5, near_to_worth = 0.3;

/// Few digits of the energies of dilatation are enough; what the exact forces move afterwards is
/// more.
constexpr double settling_tolerance = 0.01;

/// Iterations of conjugate gradients in one search. Searches that end need less, up to 4000 in
/// solids with edges; those of nearly contradictory equations would go on for minutes.
constexpr int most_iterations = 8000;

/// Price of what is left of the equations of forces and moments. Multipliers of bodies that can be
/// in balance are up to 1e3.
constexpr double price = 1e5, no_price = std::numeric_limits<double>::infinity();

/// For irregular clouds in space, whose equations often contradict each other. Multipliers are
/// about 1 to 1e3 where they do not.
constexpr double proximity = 1e-8;

/// With fewer variables per equation (horizons of two spacings) a third of all fields on boxes are
/// soft, and a factor of all equations is made as fast.
constexpr Index least_freedom = 3;

/// Intermediate passes need no more digits; what they leave is no contradiction.
constexpr double coarse_tolerance = 1e-6, coarsely_met = 1e-4;

}  // namespace

/// One search, whose answer becomes the present state.
LeastChange BalanceSearch::find_least_change(PointEquations equations, LeastChangeOptions options) {
  ++searches_;
  if (on_search_) on_search_(searches_, unbalanced());
  options.operations = operations_;
  LeastChange change = least_change(std::move(equations), options, kept_);
  operations_ -= change.operations;
  equations_.apply(change.weights);
  report_.iterations += change.iterations;
  return change;
}

/// Energies of dilatation, and forces beside them. In the plane a step of Newton's method is cheap,
/// but it can get lost. The preconditioner of the exact forces serves behind that, too.
void BalanceSearch::fit_energies() {
  const CalibrationEquations::State start = equations_.save();
  LeastChangeOptions options;
  options.tolerance = settling_tolerance;
  options.preconditioner = Preconditioner::blocks_then_boxes;
  options.price = priced_ ? price : no_price;
  options.keeps_directions = !in_space_;
  KeptPreconditioner of_forces = std::exchange(kept_, {});
  for (const Method method : {Method::newton, Method::interior_point}) {
    if (in_space_ && method == Method::newton) continue;
    equations_.restore(start);
    options.method = method;
    kept_.reset();  // coefficients are those of the stiffnesses now
    if (find_least_change(equations_.settling(), options).converged) break;
  }
  kept_ = std::move(of_forces);
}

/// One solution of the exact equations.
void BalanceSearch::balance_by(Method method, double charge, double tolerance) {
  LeastChangeOptions options;
  options.tolerance = tolerance;
  options.iterations = most_iterations;
  options.method = method;
  options.price = charge;
  options.hopeless = hopeless_;
  if (in_space_ && irregular_) options.proximity = proximity;
  PointEquations equations = equations_.balance();
  const bool tight =
      equations.num_variables() / least_freedom < static_cast<Index>(equations.right.size());
  options.preconditioner = !in_space_             ? Preconditioner::factor
                           : tight && !irregular_ ? Preconditioner::blocks_then_factor
                                                  : Preconditioner::blocks_then_boxes;
  if (tied_) options.lost = lost_by_factor;
  if (tied_ && tolerance > tolerance_) options.contradiction = contradiction_by_factor;
  options.start = std::exchange(start_, {});
  multipliers_ = find_least_change(std::move(equations), options).multipliers;
  equations_.report_balance(report_);
}

/// The forces and moments, exactly. The interior point is the last resort where one factor serves
/// several steps of Newton's method; the corners of solids without moments have no solution, and it
/// would find none, but where bonds are made alike it costs little and may find back when Newton's
/// method is lost. Clouds in space turn to it first, unless multipliers to start from are known.
/// Where the search ends farther from balance the settled stiffnesses are kept.
/// \return whether it is nearer now
bool BalanceSearch::balance(double tolerance) {
  equations_.report_balance(report_);
  const double before = left(), largest_before = unbalanced();
  const CalibrationEquations::State settled = equations_.save();
  const bool cold = irregular_ && in_space_ && start_.empty();
  const Method first = cold ? Method::interior_point : Method::newton;
  balance_by(first, priced_ ? price : no_price, tolerance);
  const bool solvable = moments_ || !in_space_;
  // The tolerance is that of the mean.
  const bool unsolved = solvable && unbalanced() > std::max(met_balance, 100.0 * tolerance);
  const bool lost = tied_ && unbalanced() > largest_before;
  if (first == Method::newton && (unsolved || lost)) {
    const CalibrationEquations::State climbed = equations_.save();
    const double reached = left();
    equations_.restore(settled);
    kept_.reset();
    balance_by(Method::interior_point, priced_ ? price : no_price, tolerance);
    kept_.reset();
    if (left() > reached) {
      equations_.restore(climbed);
      equations_.report_balance(report_);
    }
  }
  if (unbalanced() <= met_balance || left() <= before) return true;
  equations_.restore(settled);
  equations_.report_balance(report_);
  return false;
}

void BalanceSearch::settle() {
  equations_.start_over();
  if (energies_) fit_energies();
  settled_ = equations_.save();
}

/// Lattices only: clouds, which contradict themselves elsewhere more often, would take half as long
/// again there. \return whether there was something
bool BalanceSearch::drop_what_must_vanish() {
  if (!drops_first_) return false;
  while (equations_.drop_what_must_vanish()) {
    settled_ = equations_.without_dropped(std::move(settled_));
    equations_.restore(settled_);
  }
  return equations_.num_dropped() > 0;
}

/// Where few digits are missing, from the multipliers that brought the others.
void BalanceSearch::refine() {
  const double reached = unbalanced();
  const bool few = reached > exact_balance && reached <= coarsely_met;
  if (!in_space_ || moments_ || !few || multipliers_.empty()) return;
  const CalibrationEquations::State coarse = equations_.save();
  start_ = std::move(multipliers_);
  equations_.restore(settled_);
  balance(tolerance_);
  if (unbalanced() <= reached) return;
  equations_.restore(coarse);
  equations_.report_balance(report_);
}

/// With zeros where forces are out of balance without. Where zeros do not help (too few neighbours
/// all over) every bond keeps something to carry. \return whether the exact forces led anywhere
bool BalanceSearch::balance_dropping_bonds() {
  const double coarse = cautious_ ? coarse_tolerance : tolerance_;
  settle();
  const double given = unbalanced();
  const bool dropped = drop_what_must_vanish();
  bool nearer = balance(coarse);
  if (dropped && (unbalanced() > coarsely_met || equations_.hollow())) {
    // Contradictions elsewhere ask for other zeros.
    equations_.take_all_back();
    kept_.reset();
    drops_first_ = unbalanced() <= worth_dropping * given;
    settle();
    nearer = balance(coarse);
  }
  if (!nearer) return false;
  const double floored = unbalanced();
  if (!priced_ && equations_.allow_zero(in_space_ ? coarsely_met : met_balance)) {
    const CalibrationEquations::State with_floors = equations_.save();
    equations_.restore(settled_);
    hopeless_ = far_from_worth * floored;
    const double root = std::sqrt(static_cast<double>(equations_.num_points()));
    balance(std::min(coarse, near_to_worth * worth_dropping * floored / root));
    hopeless_ = std::numeric_limits<double>::infinity();
    const double reached = unbalanced();
    if (reached <= worth_dropping * floored) {
      equations_.drop_vanishing();
      const bool few = equations_.num_dropped() <= few_dropped * equations_.num_free();
      // What is gone has carried nothing, and few bonds hardly change the energies of a cloud.
      if (tied_ || (irregular_ && few)) start_ = std::move(multipliers_);
      if (few) {
        settled_ = equations_.without_dropped(std::move(settled_));
        equations_.restore(settled_);
      } else {
        settle();
      }
      balance(tolerance_);
      if (irregular_ && few && unbalanced() > reached) {  // Newton's method was lost
        equations_.restore(settled_);
        balance(tolerance_);
      }
      if (unbalanced() <= worth_dropping * floored && !equations_.hollow()) return true;
    }
    equations_.take_all_back();
    equations_.restore(with_floors);
    equations_.report_balance(report_);
    return true;
  }
  refine();
  // Each search starts from the weights of the last and leaves a small part of what that left.
  for (int pass = 0; in_space_ && unbalanced() > exact_balance && pass < most_refinements; ++pass) {
    const double before = unbalanced();
    if (!balance(tolerance_) || unbalanced() > 0.5 * before) break;
  }
  return true;
}

/// Where forces and moments have no solution together (interfaces of materials that meet the
/// surface of a lattice), forces alone are exact.
void BalanceSearch::soften_moments() {
  const CalibrationEquations::State best = equations_.save();
  const double reached = report_.residual_after;
  equations_.take_all_back();
  equations_.soften_moments();
  soft_moments_ = true;
  balance_dropping_bonds();
  if (report_.residual_after <= reached) return;
  equations_.take_all_back();
  equations_.restore(best);
  equations_.report_balance(report_);
}

CalibrationReport BalanceSearch::run(double operations) {
  operations_ = operations;
  equations_.report_balance(report_);
  report_.residual_before = report_.residual_after;
  const double start = unbalanced();
  if (!balance_dropping_bonds() && energies_) {
    const CalibrationEquations::State settled = equations_.save();
    const double reached = left();
    energies_ = false;
    balance_dropping_bonds();
    if (left() > reached) {
      equations_.take_all_back();
      equations_.restore(settled);
      equations_.report_balance(report_);
    }
  }
  if (moments_ && !tied_ && unbalanced() > met_balance) soften_moments();
  if (!(unbalanced() <= start)) {  // too few neighbours all over
    equations_.take_all_back();
    equations_.report_balance(report_);
  }
  equations_.report_weights(report_);
  return report_;
}

}  // namespace perilink

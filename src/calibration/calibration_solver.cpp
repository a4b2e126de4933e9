#include "calibration/calibration_solver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/balance_measure.hpp"

namespace perilink {
namespace {

/// With a factor every step reduces the residual at least to a hundredth. A coarse solution that
/// leaves a tenth is infeasible.
constexpr double infeasible_by_factor = 0.1;
/// A step with a factor has diverged at this multiple of the least residual.
constexpr double diverged_by_factor = 1000.0;

/// Energies are fitted again where more than this fraction of the bonds was dropped.
constexpr double few_dropped = 0.01;

/// Most solutions from the last weights in space.
constexpr int most_refinements = 3;

/// Lower bounds stay removed where this reduces the unbalanced forces to this fraction.
constexpr double worth_dropping = 0.1;
/// The solution without lower bounds ends where more than half of the forces will remain. Its
/// tolerance, 0.3 of worth_dropping, is a mean over all particles, fine enough for a single one.
constexpr double far_from_worth = 0.5, near_to_worth = 0.3;

/// A coarse tolerance for the energies of dilatation is enough: the exact forces change them more
/// afterwards.
constexpr double settling_tolerance = 0.01;

/// Most iterations of conjugate gradients in one solution. Feasible equations need up to 4000 in
/// solids with edges; nearly infeasible equations would take minutes.
constexpr int most_iterations = 8000;

/// Regularisation for unstructured particle sets in space, whose equations are often infeasible.
/// Multipliers of feasible equations are about 1 to 1e3.
constexpr double regularisation = 1e-8;

/// With fewer variables per equation (horizons of two spacings) a third of all modes of subdomains
/// are near-null-space modes, and a factor of all equations is as fast.
constexpr Index least_freedom = 3;

/// Unbalanced forces of a stalled solution: lower bounds of single bonds are not their cause.
constexpr double far_from_balance = 0.1;

/// Unbalanced forces of a coarse solution; smaller forces do not show infeasibility.
constexpr double coarsely_met = 1e-4;

}  // namespace

/// Solves the equations once and applies the result to the state.
LeastSquaresResult CalibrationSolver::solve_least_squares(PointEquations equations,
                                                          LeastSquaresOptions options) {
  ++searches_;
  if (options_.on_search) options_.on_search(searches_, unbalanced());
  LeastSquaresResult change = bounded_least_squares(std::move(equations), options, kept_);
  equations_.apply(change.weights);
  report_.iterations += change.iterations;
  if (change.stalled) stalled_search_ = searches_;
  return change;
}

/// Fits the energies of dilatation and the forces. In the plane a step of Newton's method is cheap,
/// but it can diverge. Keeps the preconditioner of the exact forces.
void CalibrationSolver::fit_energies() {
  const CalibrationEquations::State start = equations_.save();
  LeastSquaresOptions options;
  options.tolerance = settling_tolerance;
  options.preconditioner = Preconditioner::blocks_then_boxes;
  options.penalty = penalty_;
  options.keeps_directions = !in_space();
  KeptPreconditioner of_forces = std::exchange(kept_, {});
  for (const Method method : {Method::newton, Method::interior_point}) {
    if (in_space() && method == Method::newton) continue;
    equations_.restore(start);
    options.method = method;
    kept_.reset();  // coefficients depend on the present stiffnesses
    if (solve_least_squares(equations_.settling(), options).converged) break;
  }
  kept_ = std::move(of_forces);
}

/// Solves the exact equations once.
void CalibrationSolver::balance_by(Method method, double tolerance) {
  LeastSquaresOptions options;
  options.tolerance = tolerance;
  options.iterations = most_iterations;
  options.method = method;
  options.penalty = penalty_;
  options.infeasible_above = infeasible_above_;
  if (in_space() && irregular()) options.regularisation = regularisation;
  PointEquations equations = equations_.balance();
  const bool tight =
      equations.num_variables() / least_freedom < static_cast<Index>(equations.right.size());
  options.preconditioner = !in_space()             ? Preconditioner::factor
                           : tight && !irregular() ? Preconditioner::blocks_then_factor
                                                   : Preconditioner::blocks_then_boxes;
  if (reduced_) options.diverged = diverged_by_factor;
  if (reduced_ && tolerance > options_.tolerance) options.infeasible_ratio = infeasible_by_factor;
  options.start = std::exchange(start_, {});
  multipliers_ = solve_least_squares(std::move(equations), options).multipliers;
  equations_.report_balance(report_);
}

/// Solves for exact forces and moments by one of the two methods, then by the other where needed:
///
/// | body | first | second, where forces are left |
/// |---|---|---|
/// | in the plane, or with moments | Newton's method | interior point |
/// | symmetry-reduced | Newton's method | interior point, where that diverged |
/// | unstructured in space, without multipliers to start from | interior point | none |
/// | other solids | Newton's method | none: corners without moments are infeasible |
///
/// The better balanced result is kept, or the settled stiffnesses where both are worse.
/// \return whether unbalanced forces decreased
bool CalibrationSolver::balance(double tolerance) {
  equations_.report_balance(report_);
  const double before = left(), largest_before = unbalanced();
  const CalibrationEquations::State settled = equations_.save();
  const bool cold = irregular() && in_space() && start_.empty();
  const Method first = cold ? Method::interior_point : Method::newton;
  balance_by(first, tolerance);
  const bool solvable = moments_ != Moments::none || !in_space();
  // The tolerance applies to the mean.
  const bool unsolved = solvable && unbalanced() > std::max(met_balance, 100.0 * tolerance);
  const bool diverged = reduced_ && unbalanced() > largest_before;
  if (first == Method::newton && (unsolved || diverged)) {
    const CalibrationEquations::State ascended = equations_.save();
    const double reached = left();
    equations_.restore(settled);
    kept_.reset();
    balance_by(Method::interior_point, tolerance);
    kept_.reset();
    if (left() > reached) {
      equations_.restore(ascended);
      equations_.report_balance(report_);
    }
  }
  if (unbalanced() <= met_balance || left() <= before) return true;
  equations_.restore(settled);
  equations_.report_balance(report_);
  return false;
}

void CalibrationSolver::settle() {
  equations_.start_over();
  if (fits_energies_) fit_energies();
  settled_ = equations_.save();
}

/// Presolve of lattices: drops variables that an equation fixes at zero. In unstructured particle
/// sets other equations are more often infeasible, and presolve would cost half of the time again.
bool CalibrationSolver::fix_zero_variables() {
  if (!presolves_) return false;
  const double given = unbalanced();
  while (equations_.drop_fixed_at_zero()) {
    settled_ = equations_.without_dropped(std::move(settled_));
    equations_.restore(settled_);
  }
  if (equations_.num_dropped() == 0) return false;
  balance(first_tolerance_);
  if (unbalanced() <= coarsely_met && !equations_.underconstrained()) return true;
  equations_.take_all_back();
  kept_.reset();
  presolves_ = unbalanced() <= worth_dropping * given;
  settle();
  return false;
}

/// Solves with the lower bounds of all bonds.
bool CalibrationSolver::keep_floors() { return balance(first_tolerance_); }

/// Allows bonds of unbalanced particles to fall to zero and drops those that do. Restores the lower
/// bounds where this does not reduce the largest unbalanced force to a tenth.
/// \return whether a lower bound was removed
bool CalibrationSolver::remove_floors() {
  if (stalled_search_ == searches_ && unbalanced() > far_from_balance) return false;
  if (penalty_ != no_penalty || !equations_.allow_zero(in_space() ? coarsely_met : met_balance))
    return false;
  const double floored = unbalanced();
  const CalibrationEquations::State with_floors = equations_.save();
  equations_.restore(settled_);
  infeasible_above_ = far_from_worth * floored;
  const double root = std::sqrt(static_cast<double>(equations_.num_points()));
  balance(std::min(first_tolerance_, near_to_worth * worth_dropping * floored / root));
  infeasible_above_ = std::numeric_limits<double>::infinity();
  if (unbalanced() <= worth_dropping * floored) {
    balance_without_dropped();
    if (unbalanced() <= worth_dropping * floored && !equations_.underconstrained()) return true;
  }
  equations_.take_all_back();
  equations_.restore(with_floors);
  equations_.report_balance(report_);
  return true;
}

/// Solves again without dropped bonds. Where few were dropped, the energies hardly change, and the
/// solution starts from the present state and multipliers.
void CalibrationSolver::balance_without_dropped() {
  const double reached = unbalanced();
  const bool few = equations_.drop_zero_weights() <= few_dropped;
  if (reduced_ || (irregular() && few)) start_ = std::move(multipliers_);
  if (few) {
    settled_ = equations_.without_dropped(std::move(settled_));
    equations_.restore(settled_);
  } else {
    settle();
  }
  balance(options_.tolerance);
  if (irregular() && few && unbalanced() > reached) {  // Newton's method diverged
    equations_.restore(settled_);
    balance(options_.tolerance);
  }
}

/// Solves again from the multipliers of the last solution, to refine it.
bool CalibrationSolver::go_on_from_multipliers() {
  const double reached = unbalanced();
  const bool few = reached > exact_balance && reached <= coarsely_met;
  if (!in_space() || moments_ != Moments::none || !few || multipliers_.empty()) return false;
  const CalibrationEquations::State coarse = equations_.save();
  start_ = std::move(multipliers_);
  equations_.restore(settled_);
  balance(options_.tolerance);
  if (unbalanced() <= reached) return true;
  equations_.restore(coarse);
  equations_.report_balance(report_);
  return false;
}

/// Solves again from the last weights, as long as each solution halves the largest unbalanced
/// force.
bool CalibrationSolver::go_on_from_weights() {
  const double before = unbalanced();
  if (!in_space() || before <= exact_balance || refinements_++ == most_refinements) return false;
  return balance(options_.tolerance) && unbalanced() <= 0.5 * before;
}

bool CalibrationSolver::make_attempts() {
  struct Attempt {
    bool (CalibrationSolver::*run)();
    Step accepted, rejected;  // next step
  };
  constexpr Attempt table[] = {
      {&CalibrationSolver::fix_zero_variables, Step::remove_floors, Step::keep_floors},
      {&CalibrationSolver::keep_floors, Step::remove_floors, Step::failed},
      {&CalibrationSolver::remove_floors, Step::done, Step::from_multipliers},
      {&CalibrationSolver::go_on_from_multipliers, Step::from_weights, Step::from_weights},
      {&CalibrationSolver::go_on_from_weights, Step::from_weights, Step::done},
  };
  settle();
  refinements_ = 0;
  Step step = Step::fix_zeros;
  while (step != Step::done && step != Step::failed) {
    const Attempt& attempt = table[static_cast<std::size_t>(step)];
    step = (this->*attempt.run)() ? attempt.accepted : attempt.rejected;
  }
  return step == Step::done;
}

/// Makes attempts, and restores the former state where their result is worse by the measure.
template <class Measure, class Run>
void CalibrationSolver::keep_if_nearer(Measure measure, Run run) {
  const CalibrationEquations::State best = equations_.save();
  const double reached = measure();
  run();
  if (measure() <= reached) return;
  equations_.take_all_back();
  equations_.restore(best);
  equations_.report_balance(report_);
}

CalibrationReport CalibrationSolver::run() {
  equations_.report_balance(report_);
  report_.residual_before = report_.residual_after;
  const double start = unbalanced();
  if (!make_attempts() && fits_energies_) {
    fits_energies_ = false;
    keep_if_nearer([&] { return left(); }, [&] { make_attempts(); });
  }
  if (moments_ == Moments::exact && !reduced_ && unbalanced() > met_balance) {
    const auto with_soft_moments = [&] {
      equations_.take_all_back();
      equations_.soften_moments();
      moments_ = Moments::soft;
      make_attempts();
    };
    keep_if_nearer([&] { return report_.residual_after; }, with_soft_moments);
  }
  if (!(unbalanced() <= start)) {  // too few neighbours everywhere
    equations_.take_all_back();
    equations_.report_balance(report_);
  }
  equations_.report_weights(report_);
  return report_;
}

}  // namespace perilink

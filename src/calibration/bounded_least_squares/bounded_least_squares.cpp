#include "calibration/bounded_least_squares/bounded_least_squares.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "calibration/bounded_least_squares/fixed_normal_equations.hpp"
#include "calibration/bounded_least_squares/interior_point.hpp"
#include "calibration/bounded_least_squares/symmetry_reduced/reduce.hpp"
#include "calibration/bounded_least_squares/symmetry_reduced/reduced_normal_equations.hpp"

namespace perilink {
namespace {

constexpr int most_newton_steps = 40;
/// Newton's method has diverged where the dual function stops growing before this fraction of a
/// step.
constexpr double shortest_step = 1e-5;

/// Relative growth of the dual function below this is round-off.
constexpr double lost_growth = 1e-11;

/// A step has diverged at this multiple of the residual at the end of the interior-point method.
constexpr double diverged = 100.0;

/// Root mean square of the residual at which the interior-point method has found the weights at
/// their bounds.
constexpr double rough = 1e-4;

/// Weights closer to a bound than this are at the bound.
constexpr double at_bound = 1e-3;
/// Multipliers are near the solution where the residual is below this times the root of the number
/// of points.
constexpr double near_the_end = 1e-4;

class DualNewton {
 public:
  using Vector = std::vector<double>;  // shape (points, rows)

  DualNewton(const PointEquations& equations, const LeastSquaresOptions& options,
             NormalSystem& normal)
      : equations_(equations),
        options_(options),
        normal_(normal),
        elongation_(equations.lower.size()),
        weights_(elongation_.size(), 1.0),
        residual_(equations.right.size(), 0.0) {}

  LeastSquaresResult solve();

 private:
  std::size_t rows() const { return static_cast<std::size_t>(equations_.rows); }
  double root_of_points() const {
    return std::sqrt(static_cast<double>(std::max<Index>(equations_.num_points(), 1)));
  }
  double choose_weights(const Vector& y);
  double dual(const Vector& y);
  void ascend(Vector y, double target, double most = std::numeric_limits<double>::infinity());
  double left();
  void finish(const Vector& y, double target);
  double search_line(const Vector& residual, const Vector& direction, Vector& y);
  void report();

  const PointEquations& equations_;
  const LeastSquaresOptions& options_;
  NormalSystem& normal_;
  std::vector<double> elongation_;  // A' y
  std::vector<double> weights_;
  Vector residual_;
  LeastSquaresResult result_;
};

/// Computes the weights of a dual vector and their part of the dual function. Weights between the
/// bounds are active.
double DualNewton::choose_weights(const Vector& y) {
  normal_.apply_transpose(y, elongation_);
  double charge = 0.0;
  for (std::size_t v = 0; v < weights_.size(); ++v) {
    const double free = 1.0 + elongation_[v];
    weights_[v] = std::clamp(free, equations_.lower[v], equations_.upper[v]);
    normal_.active_weight[v] = weights_[v] == free ? 1.0 : 0.0;
    charge += weights_[v] * free - 0.5 * weights_[v] * weights_[v];
  }
  for (std::size_t k = 0; k < normal_.compliance.size(); ++k) {
    normal_.compliance[k] = normal_.relaxation(k, y[k]) != 0.0 ? 1.0 : 0.0;
  }
  return charge;
}

double DualNewton::dual(const Vector& y) {
  double value = -choose_weights(y);
  for (std::size_t k = 0; k < y.size(); ++k) {
    const double ridge = equations_.ridge_of(k % rows());
    value += y[k] * (equations_.right[k] * equations_.scale[k] - 0.5 * ridge * y[k]);
    const double relaxation = normal_.relaxation(k, y[k]);
    value -= 0.5 * relaxation * relaxation;
  }
  return value;
}

/// Halves the step until the concave dual function grows. Near the end its growth is lost in
/// round-off: then until the residual, its gradient, shrinks. Multipliers of infeasible equations
/// would go to infinity, so the penalty limits the step.
/// \return length of the step over the first length tried
double DualNewton::search_line(const Vector& residual, const Vector& direction, Vector& y) {
  const double before = dual(y);
  const double slope = dot(residual, direction);
  Vector trial(y.size()), rest;
  double longest = 0.0;
  for (const double d : direction) longest = std::max(longest, std::abs(d));
  const bool near = norm(residual) < near_the_end * root_of_points();
  const double first = longest > 2.0 * options_.penalty ? 2.0 * options_.penalty / longest : 1.0;
  double step = first;
  for (int halvings = 0; halvings < 30; ++halvings, step *= 0.5) {
    for (std::size_t k = 0; k < y.size(); ++k) trial[k] = y[k] + step * direction[k];
    // Round-off of the sums in dual(): 1e-13 of their size.
    if (dual(trial) >= before + 1e-4 * step * slope - 1e-13 * std::abs(before)) break;
    if (!near || step * slope > lost_growth * std::abs(before)) continue;
    normal_.measure(weights_, trial, rest);
    if (norm(rest) < 0.5 * norm(residual)) break;
  }
  y = trial;
  return step / first;
}

/// Newton's method on the dual function, from the multipliers y.
/// \param most  norm of the residual, over its value at the start, at which the method has diverged
void DualNewton::ascend(Vector y, double target, double most) {
  Vector direction;
  choose_weights(y);
  normal_.measure(weights_, y, residual_);
  const auto reached = [&] { return std::max(target, round_off * norm(y)); };
  double start = 0.0, last_size = 0.0, last_length = 1.0;
  std::vector<double> pattern, relaxation;  // weights between their bounds in the last step
  double least = std::numeric_limits<double>::infinity();
  Vector best;  // multipliers of the least residual
  for (int step = 0; step < most_newton_steps; ++step) {
    const double size = norm(residual_);
    if (size <= reached() || result_.iterations >= options_.iterations) break;
    if (step == 0) start = size;
    if (size > std::min(most * start, options_.diverged * least)) break;
    if (size < least) best = y;
    least = std::min(least, size);
    const bool settled =
        last_length == 1.0 && pattern == normal_.active_weight && relaxation == normal_.compliance;
    if (settled && size > options_.infeasible_ratio * last_size) break;
    last_size = size;
    // Near the end one step is enough: further growth of the dual function is round-off.
    const bool near = !options_.start.empty() && size < near_the_end * root_of_points();
    const bool last = settled || (step == 0 && near);
    normal_.prepare_if_stale(settled, last);
    pattern = normal_.active_weight;
    relaxation = normal_.compliance;
    // The first steps only find the weights at their bounds.
    const double coarse = last ? 0.0 : step == 0 ? 1e-2 : 1e-3;
    const double reduction = std::max({coarse, 0.3 * target / size, 1e-12});
    result_.iterations += normal_.solve(residual_, reduction, direction);
    const double length = last_length = search_line(residual_, direction, y);
    normal_.measure(weights_, y, residual_);
    if (length < shortest_step) break;
  }
  if (std::isfinite(options_.diverged) && norm(residual_) > least) {
    y = std::move(best);
    choose_weights(y);
    normal_.measure(weights_, y, residual_);
  }
  result_.converged = norm(residual_) <= reached();
  result_.multipliers = std::move(y);
}

/// Returns the norm of the residuals of the exact equations.
double DualNewton::left() {
  normal_.measure(weights_, Vector(residual_.size(), 0.0), residual_);
  double sum = 0.0;
  for (std::size_t k = 0; k < residual_.size(); ++k) {
    if (equations_.ridge_of(k % rows()) == 0.0) sum += residual_[k] * residual_[k];
  }
  return std::sqrt(sum);
}

/// Continues by Newton's method after the interior-point method. Keeps the weights of the latter
/// where the residual grows, as with infeasible equations.
void DualNewton::finish(const Vector& y, double target) {
  const std::vector<double> interior = weights_;
  const double reached = left();
  ascend(y, target, diverged);
  if (!result_.converged && left() > reached) weights_ = interior;
}

LeastSquaresResult DualNewton::solve() {
  const double target = options_.tolerance * root_of_points();
  if (options_.method == Method::newton) {
    ascend(options_.start.empty() ? Vector(residual_.size(), 0.0) : options_.start, target);
  } else {
    // Newton's method refines the result, but not with penalties, where it diverges between their
    // kinks.
    const bool finished = std::isfinite(options_.penalty) || options_.tolerance >= rough;
    InteriorPoint interior(equations_, normal_, options_);
    result_.converged = interior.solve(finished ? target : rough * root_of_points(),
                                       options_.iterations, result_.iterations);
    normal_.regularisation = 0.0;
    result_.stalled = interior.stalled();
    weights_ = interior.weights();
    if (!finished && !interior.infeasible() && !interior.stalled())
      finish(interior.multipliers(), target);
  }
  report();
  return result_;
}

void DualNewton::report() {
  for (std::size_t v = 0; v < weights_.size(); ++v) {
    result_.at_lower += weights_[v] <= equations_.lower[v] + at_bound;
  }
  normal_.measure(weights_, Vector(residual_.size(), 0.0), residual_);
  for (std::size_t k = 0; k < residual_.size(); ++k) {
    const double rest = std::abs(residual_[k]);
    if (rest <= result_.residual) continue;
    result_.residual = rest;
    result_.worst_point = static_cast<Index>(k / rows());
  }
  result_.weights = std::move(weights_);
}

template <int Rows, int Odd, bool Grouped>
LeastSquaresResult solve(const PointEquations& equations, const LeastSquaresOptions& options,
                         KeptPreconditioner& kept) {
  FixedNormalEquations<Rows, Odd, Grouped> normal(equations, options, kept);
  return DualNewton(equations, options, normal).solve();
}

LeastSquaresResult solve_reduced(PointEquations equations, const LeastSquaresOptions& options,
                                 KeptPreconditioner& kept) {
  const ReducedEquations reduced = reduce(equations, kept.independent_rows);
  equations = {};
  ReducedNormalEquations normal(reduced, kept.reduced);
  LeastSquaresResult change = DualNewton(reduced.equations, options, normal).solve();
  change.weights = reduced.weights(change.weights);
  return change;
}

}  // namespace

LeastSquaresResult bounded_least_squares(PointEquations equations,
                                         const LeastSquaresOptions& options,
                                         KeptPreconditioner& kept) {
  if (!equations.unknown.empty()) return solve_reduced(std::move(equations), options, kept);
  const auto are = [&](int rows, int odd, bool grouped) {
    return equations.rows == rows && equations.odd == odd && equations.group.empty() != grouped;
  };
  // Moduli of a neighbourhood without and with moments in two and three dimensions.
  if (are(5, 0, false)) return solve<5, 0, false>(equations, options, kept);
  if (are(8, 0, false)) return solve<8, 0, false>(equations, options, kept);
  if (are(15, 0, false)) return solve<15, 0, false>(equations, options, kept);
  if (are(26, 0, false)) return solve<26, 0, false>(equations, options, kept);
  // Forces and moments, without and with energies.
  if (are(4, 4, false)) return solve<4, 4, false>(equations, options, kept);
  if (are(5, 4, true)) return solve<5, 4, true>(equations, options, kept);
  if (are(8, 6, false)) return solve<8, 6, false>(equations, options, kept);
  if (are(9, 6, true)) return solve<9, 6, true>(equations, options, kept);
  if (are(10, 10, false)) return solve<10, 10, false>(equations, options, kept);
  if (are(11, 10, true)) return solve<11, 10, true>(equations, options, kept);
  if (are(18, 13, false)) return solve<18, 13, false>(equations, options, kept);
  if (are(19, 13, true)) return solve<19, 13, true>(equations, options, kept);
  throw std::invalid_argument(std::to_string(equations.rows) + " equations per point, " +
                              std::to_string(equations.odd) + " of them odd, are not built in");
}

LeastSquaresResult bounded_least_squares(PointEquations equations,
                                         const LeastSquaresOptions& options) {
  KeptPreconditioner kept;
  return bounded_least_squares(std::move(equations), options, kept);
}

}  // namespace perilink

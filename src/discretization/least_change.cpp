#include "discretization/least_change.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "discretization/interior_point.hpp"
#include "discretization/normal_equations.hpp"
#include "discretization/tied_equations.hpp"

namespace perilink {
namespace {

/// A step at settled weights that leaves more than this of the residual leaves contradictions.
constexpr double contradiction = 0.9;
constexpr int most_newton_steps = 40;
/// Newton's method is lost where the dual function stops growing this early along a step.
constexpr double shortest_step = 1e-5;

/// Root mean square of the residual at which the interior point method has found out which weights
/// are at their bounds.
constexpr double rough = 1e-4;

template <class Normal>
class DualNewton {
 public:
  using Vector = std::vector<double>;  // shape (points, rows)

  DualNewton(const PointEquations& equations, const LeastChangeOptions& options, Normal& normal)
      : equations_(equations),
        options_(options),
        normal_(normal),
        elongation_(equations.lower.size()),
        weights_(elongation_.size(), 1.0) {}

  LeastChange solve();

 private:
  std::size_t rows() const { return static_cast<std::size_t>(equations_.rows); }
  double root_of_points() const {
    return std::sqrt(static_cast<double>(std::max<Index>(equations_.num_points(), 1)));
  }
  double choose_weights(const Vector& y);
  double dual(const Vector& y);
  void climb(Vector& y);
  double search_line(const Vector& residual, const Vector& direction, Vector& y);
  void report(const Vector& y);

  const PointEquations& equations_;
  const LeastChangeOptions& options_;
  Normal& normal_;
  std::vector<double> elongation_;  // A' y
  std::vector<double> weights_;
  Vector residual_;
  LeastChange result_;
};

/// Weights of a dual vector, and the part of the dual function that they make. Mobile are those
/// between the bounds.
template <class Normal>
double DualNewton<Normal>::choose_weights(const Vector& y) {
  normal_.apply_transpose(y, elongation_);
  double charge = 0.0;
  for (std::size_t v = 0; v < weights_.size(); ++v) {
    const double free = 1.0 + elongation_[v];
    weights_[v] = std::clamp(free, equations_.lower[v], equations_.upper[v]);
    normal_.mobility[v] = weights_[v] == free ? 1.0 : 0.0;
    charge += weights_[v] * free - 0.5 * weights_[v] * weights_[v];
  }
  return charge;
}

template <class Normal>
double DualNewton<Normal>::dual(const Vector& y) {
  double value = -choose_weights(y);
  for (std::size_t k = 0; k < y.size(); ++k) {
    const double ridge = equations_.ridge_of(k % rows());
    value += y[k] * (equations_.right[k] * equations_.scale[k] - 0.5 * ridge * y[k]);
  }
  return value;
}

/// Halves the step until the concave dual function grows. \return length of the step
template <class Normal>
double DualNewton<Normal>::search_line(const Vector& residual, const Vector& direction, Vector& y) {
  const double before = dual(y);
  const double slope = dot(residual, direction);
  Vector trial(y.size());
  double step = 1.0;
  for (int halvings = 0; halvings < 30; ++halvings, step *= 0.5) {
    for (std::size_t k = 0; k < y.size(); ++k) trial[k] = y[k] + step * direction[k];
    // Round-off of the sums in dual(): 1e-13 of their size.
    if (dual(trial) >= before + 1e-4 * step * slope - 1e-13 * std::abs(before)) break;
  }
  y = trial;
  return step;
}

/// Newton's method on the dual function.
template <class Normal>
void DualNewton<Normal>::climb(Vector& y) {
  const double target = options_.tolerance * root_of_points();
  Vector direction;
  choose_weights(y);
  normal_.measure(weights_, y, residual_);
  double last_size = 0.0;
  std::vector<double> pattern;  // weights between their bounds at the last step
  for (int step = 0; step < most_newton_steps; ++step) {
    const double size = norm(residual_);
    if (size <= target || result_.iterations >= options_.iterations) break;
    const bool settled = pattern == normal_.mobility;
    if (settled && size > contradiction * last_size) break;
    last_size = size;
    normal_.prepare_if_stale(settled);
    pattern = normal_.mobility;
    // The first steps only find out which weights are at their bounds.
    const double coarse = step == 0 ? 1e-2 : settled ? 0.0 : 1e-3;
    const double reduction = std::max({coarse, 0.3 * target / size, 1e-12});
    result_.iterations += normal_.solve(residual_, reduction, direction);
    const double length = search_line(residual_, direction, y);
    normal_.measure(weights_, y, residual_);
    if (length < shortest_step) break;
  }
  result_.converged = norm(residual_) <= target;
}

template <class Normal>
LeastChange DualNewton<Normal>::solve() {
  Vector y(equations_.right.size(), 0.0);
  if (options_.method == Method::newton) {
    climb(y);
    report(y);
    return result_;
  }
  InteriorPoint<Normal> interior(equations_, normal_);
  result_.iterations = interior.solve(std::max(options_.tolerance, rough) * root_of_points());
  y = interior.multipliers();
  if (options_.tolerance < rough) {
    climb(y);
  } else {
    weights_ = interior.weights();
    normal_.measure(weights_, y, residual_);
    result_.converged = norm(residual_) <= options_.tolerance * root_of_points();
  }
  report(y);
  return result_;
}

template <class Normal>
void DualNewton<Normal>::report(const Vector& y) {
  for (std::size_t v = 0; v < weights_.size(); ++v) {
    result_.at_lower += weights_[v] <= equations_.lower[v];
  }
  for (std::size_t k = 0; k < y.size(); ++k) {
    const double rest = std::abs(residual_[k] + equations_.ridge_of(k % rows()) * y[k]);
    if (rest <= result_.residual) continue;
    result_.residual = rest;
    result_.worst_point = static_cast<Index>(k / rows());
  }
  result_.weights = std::move(weights_);
}

template <int Rows, int Odd, bool Grouped>
LeastChange solve(const PointEquations& equations, const LeastChangeOptions& options,
                  std::unique_ptr<CoarseSpace>& coarse) {
  using Normal = NormalEquations<Rows, Odd, Grouped>;
  Normal normal(equations, options, coarse);
  return DualNewton<Normal>(equations, options, normal).solve();
}

LeastChange solve_tied(const PointEquations& equations, const LeastChangeOptions& options) {
  const TiedEquations tied = tie(equations);
  TiedNormalEquations normal(tied);
  LeastChange change = DualNewton<TiedNormalEquations>(tied.equations, options, normal).solve();
  change.weights = tied.weights(change.weights);
  return change;
}

}  // namespace

LeastChange least_change(const PointEquations& equations, const LeastChangeOptions& options,
                         std::unique_ptr<CoarseSpace>& factor) {
  if (!equations.unknown.empty()) return solve_tied(equations, options);
  const auto are = [&](int rows, int odd, bool grouped) {
    return equations.rows == rows && equations.odd == odd && equations.group.empty() != grouped;
  };
  // Moduli of a family of bonds without and with moments in two and three dimensions.
  if (are(5, 0, false)) return solve<5, 0, false>(equations, options, factor);
  if (are(8, 0, false)) return solve<8, 0, false>(equations, options, factor);
  if (are(15, 0, false)) return solve<15, 0, false>(equations, options, factor);
  if (are(26, 0, false)) return solve<26, 0, false>(equations, options, factor);
  // Their forces and moments, and with them energies.
  if (are(4, 4, false)) return solve<4, 4, false>(equations, options, factor);
  if (are(5, 4, true)) return solve<5, 4, true>(equations, options, factor);
  if (are(8, 6, false)) return solve<8, 6, false>(equations, options, factor);
  if (are(9, 6, true)) return solve<9, 6, true>(equations, options, factor);
  if (are(10, 10, false)) return solve<10, 10, false>(equations, options, factor);
  if (are(11, 10, true)) return solve<11, 10, true>(equations, options, factor);
  if (are(18, 13, false)) return solve<18, 13, false>(equations, options, factor);
  if (are(19, 13, true)) return solve<19, 13, true>(equations, options, factor);
  throw std::invalid_argument(std::to_string(equations.rows) + " equations per point, " +
                              std::to_string(equations.odd) + " of them odd, are not built in");
}

LeastChange least_change(const PointEquations& equations, const LeastChangeOptions& options) {
  std::unique_ptr<CoarseSpace> factor;
  return least_change(equations, options, factor);
}

}  // namespace perilink

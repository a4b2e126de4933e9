#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "calibration/bounded_least_squares/normal_equations.hpp"

namespace perilink {

/// Solves bounded_least_squares() by a primal-dual interior-point method. Weights w stay strictly
/// between their bounds, whose multipliers are z, Z > 0: w = 1 + A'y + z - Z, A w + ridge y = r,
/// and z (w - lower) = Z (upper - w) = mu, which goes to zero. Newton's method for all of these
/// reduces to the system of NormalEquations with the active-set weights
/// 1 / (1 + z / (w - lower) + Z / (upper - w)).
///
/// Newton's method on the dual function takes short steps where many weights pass their bounds at
/// once, and diverges where no weight is between the bounds. This method needs ten to thirty steps
/// for any bounds. The residual of an equation with a penalty p is the difference of two positive
/// variables, s (p - y) = S (p + y) = mu, which add s / (p - y) + S / (p + y) to the diagonal.
///
/// Without a penalty the residual of an equation may be regularisation * y. Infeasible equations
/// then end near the least squared residual; without regularisation they would shorten every step.
template <class Normal>
class InteriorPoint {
 public:
  using Vector = std::vector<double>;  // shape (points, rows)

  InteriorPoint(const PointEquations& equations, Normal& normal, const LeastSquaresOptions& options)
      : equations_(equations),
        normal_(normal),
        regularisation_(options.regularisation),
        infeasible_above_(options.infeasible_above),
        lower_(equations.lower),
        upper_(equations.upper),
        y_(equations.right.size(), 0.0),
        weights_(lower_.size()),
        elongation_(lower_.size(), 0.0),
        at_lower_(lower_.size()),
        at_upper_(lower_.size()) {}

  /// \param target  required norm of the scaled residual
  /// \param most  conjugate-gradient iterations after which no step begins
  /// \param iterations  the iterations made are added
  /// \return whether the target was reached
  bool solve(double target, int most, int& iterations);
  /// Whether the equations are infeasible by more than Newton's method can correct.
  bool infeasible() const { return infeasible_; }
  /// Whether the solution ended because its steps stayed short.
  bool stalled() const { return short_steps_ == most_short_steps; }
  const Vector& multipliers() const { return y_; }
  const std::vector<double>& weights() const { return weights_; }

 private:
  /// Returns the first multipliers of the bounds, the order of the multipliers of soft equations.
  /// In space a smaller gap saves steps; in the plane strips along a boundary would diverge.
  double first_gap() const { return equations_.dim == 3 ? 3.0 : 30.0; }
  /// z (w - lower) at the end: the error of weights at a bound is at most its square root.
  static constexpr double last_gap = 1e-4;
  static constexpr int most_steps = 60;
  /// Largest fraction of the way to the nearest bound in a step.
  static constexpr double boldness = 0.99;
  /// Reduction of the residual by a step while the active bounds change, and the least reduction
  /// later.
  static constexpr double coarse = 0.1, finest = 1e-8;
  /// Equations are infeasible, or at round-off, where steps in a row leave more than this of the
  /// residual at settled multipliers.
  static constexpr double infeasible_ratio = 0.9;
  static constexpr int most_stalls = 2;
  /// Without regularisation and penalty the solution ends after this number of steps in a row that
  /// are shorter than this.
  static constexpr double short_step = 0.1;
  static constexpr int most_short_steps = 10;
  /// Below this gap the multipliers of infeasible equations are known to about a third.
  static constexpr double settling_gap = 1.0;
  /// Smaller residuals do not show infeasibility: Newton's method removes them.
  static constexpr double infeasible_residual = 1e-4;

  void start();
  double gap() const;
  void measure(const std::vector<double>& weights, Vector& residual) const;
  template <class Visit>
  void for_each_rest(Visit visit);
  Vector linearize(double mu);
  template <class Visit>
  void for_each_pair(const std::vector<double>& change, std::size_t begin, std::size_t end,
                     Visit visit);
  template <class Visit>
  void for_each_pair_of_rests(const Vector& direction, Visit visit);
  double take_step(double mu, double reduction, int& iterations);
  double largest_rest() const;
  bool would_grow(int& iterations);

  const PointEquations& equations_;
  Normal& normal_;
  double regularisation_, infeasible_above_;
  bool infeasible_ = false;
  int short_steps_ = 0;  // in a row
  std::span<const double> lower_, upper_;
  Vector y_;
  std::vector<double> weights_;
  std::vector<double> elongation_;           // A' y
  std::vector<double> pull_;                 // on the weights, without the change of y
  std::vector<double> at_lower_, at_upper_;  // z, Z
  Vector over_, under_;                      // s, S; empty without a penalty
};

template <class Normal>
void InteriorPoint<Normal>::start() {
  for (std::size_t v = 0; v < weights_.size(); ++v) {
    const double margin = 0.1 * std::min(1.0, upper_[v] - lower_[v]);
    weights_[v] = std::clamp(1.0, lower_[v] + margin, upper_[v] - margin);
    at_lower_[v] = first_gap() / (weights_[v] - lower_[v]);
    at_upper_[v] = first_gap() / (upper_[v] - weights_[v]);
  }
  if (!std::isfinite(normal_.penalty())) return;
  over_.assign(y_.size(), first_gap() / normal_.penalty());
  under_ = over_;
}

/// Calls visit(k, s, p - y, S, p + y).
template <class Normal>
template <class Visit>
void InteriorPoint<Normal>::for_each_rest(Visit visit) {
  for (std::size_t k = 0; k < over_.size(); ++k) {
    if (!normal_.has_penalty(k)) continue;
    visit(k, over_[k], normal_.penalty() - y_[k], under_[k], normal_.penalty() + y_[k]);
  }
}

/// Returns the mean of z (w - lower) and Z (upper - w).
template <class Normal>
double InteriorPoint<Normal>::gap() const {
  if (weights_.empty()) return 0.0;
  double sum = 0.0;
  for (std::size_t v = 0; v < weights_.size(); ++v) {
    sum += at_lower_[v] * (weights_[v] - lower_[v]) + at_upper_[v] * (upper_[v] - weights_[v]);
  }
  return 0.5 * sum / static_cast<double>(weights_.size());
}

/// Computes the residual of the equations of the steps.
template <class Normal>
void InteriorPoint<Normal>::measure(const std::vector<double>& weights, Vector& residual) const {
  normal_.measure(weights, y_, residual);
  for (std::size_t k = 0; k < y_.size(); ++k) residual[k] -= regularisation_ * y_[k];
}

/// Sets up the linear system of a Newton step towards z (w - lower) = mu. \return its right side
template <class Normal>
auto InteriorPoint<Normal>::linearize(double mu) -> Vector {
  const std::size_t count = weights_.size();
  std::vector<double> change(count);
  pull_.resize(count);
  for_each_part_of(count, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const double below = weights_[v] - lower_[v], above = upper_[v] - weights_[v];
      normal_.active_weight[v] = 1.0 / (1.0 + at_lower_[v] / below + at_upper_[v] / above);
      pull_[v] = 1.0 + elongation_[v] - weights_[v] + mu / below - mu / above;
      change[v] = weights_[v] + normal_.active_weight[v] * pull_[v];
    }
  });
  Vector residual;
  measure(change, residual);
  for_each_rest([&](std::size_t k, double over, double below, double under, double above) {
    normal_.compliance[k] = over / below + under / above;
    residual[k] -= mu / below - mu / above;
  });
  return residual;
}

/// Calls visit(variable, slack, change of the slack) for a range of weights. The positive variable
/// times its slack tends to mu.
template <class Normal>
template <class Visit>
void InteriorPoint<Normal>::for_each_pair(const std::vector<double>& change, std::size_t begin,
                                          std::size_t end, Visit visit) {
  for (std::size_t v = begin; v < end; ++v) {
    visit(at_lower_[v], weights_[v] - lower_[v], change[v]);
    visit(at_upper_[v], upper_[v] - weights_[v], -change[v]);
  }
}

/// Calls visit(variable, slack, change of the slack) for residuals of equations with a penalty.
template <class Normal>
template <class Visit>
void InteriorPoint<Normal>::for_each_pair_of_rests(const Vector& direction, Visit visit) {
  for_each_rest([&](std::size_t k, double& over, double below, double& under, double above) {
    visit(over, below, -direction[k]);
    visit(under, above, direction[k]);
  });
}

/// Takes a Newton step towards mu, as far as the bounds allow. \return its length
template <class Normal>
double InteriorPoint<Normal>::take_step(double mu, double reduction, int& iterations) {
  const Vector residual = linearize(mu);
  Vector direction;
  normal_.prepare();
  iterations += normal_.solve(residual, reduction, direction);
  const std::size_t count = weights_.size();
  std::vector<double> stretch(count), change(count);
  normal_.apply_transpose(direction, stretch);
  const auto change_of = [&](double variable, double slack, double change_of_slack) {
    return (mu - variable * (slack + change_of_slack)) / slack;
  };
  double lengths[parts_of_vectors + 1];
  std::ranges::fill(lengths, 1.0);
  const auto limit_to = [&](double& length) {
    return [&](double variable, double slack, double change_of_slack) {
      const double step = change_of(variable, slack, change_of_slack);
      if (change_of_slack < 0.0) length = std::min(length, -boldness * slack / change_of_slack);
      if (step < 0.0) length = std::min(length, -boldness * variable / step);
    };
  };
  for_each_part_of(count, [&](std::size_t part, std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      change[v] = normal_.active_weight[v] * (stretch[v] + pull_[v]);
    }
    for_each_pair(change, begin, end, limit_to(lengths[part]));
  });
  for_each_pair_of_rests(direction, limit_to(lengths[parts_of_vectors]));
  const double length = *std::ranges::min_element(lengths);
  const auto go = [&](double& variable, double slack, double change_of_slack) {
    variable += length * change_of(variable, slack, change_of_slack);
  };
  for_each_pair_of_rests(direction, go);
  for_each_part_of(count, [&](std::size_t, std::size_t begin, std::size_t end) {
    for_each_pair(change, begin, end, go);
    for (std::size_t v = begin; v < end; ++v) {
      weights_[v] += length * change[v];
      elongation_[v] += length * stretch[v];
    }
  });
  combine(y_, y_, length, direction);
  return length;
}

/// Returns the largest residual due to the regularisation of an equation.
template <class Normal>
double InteriorPoint<Normal>::largest_rest() const {
  double largest = 0.0;
  for (const double y : y_) largest = std::max(largest, std::abs(y));
  return regularisation_ * largest;
}

/// Whether a step that removes the residual due to the multipliers would double them. Multipliers
/// of infeasible equations grow without bound, others change little.
template <class Normal>
bool InteriorPoint<Normal>::would_grow(int& iterations) {
  Vector rest(y_), change;
  for (double& value : rest) value *= regularisation_;
  iterations += normal_.solve(rest, coarse, change);
  return norm(change) > 0.5 * norm(y_);
}

template <class Normal>
bool InteriorPoint<Normal>::solve(double target, int most, int& iterations) {
  start();
  normal_.regularisation = regularisation_;
  double centring = 0.2, last_size = std::numeric_limits<double>::infinity();
  int stalls = 0;
  bool full = true;  // the last step
  Vector residual;
  for (int step = 0; step < most_steps && iterations < most; ++step) {
    measure(weights_, residual);
    for_each_rest([&](std::size_t k, double over, double, double under, double) {
      residual[k] -= over - under;
    });
    const double size = norm(residual), present = gap();
    const bool settled = present <= last_gap;
    // The residual of infeasible equations need not be more accurate.
    const double rest = regularisation_ * norm(y_), enough = std::max(target, 0.1 * rest);
    const double left = largest_rest();
    if (present < settling_gap && left > infeasible_above_) {
      infeasible_ = true;
      break;
    }
    if (settled && size <= enough) {
      infeasible_ = left > infeasible_residual && would_grow(iterations);
      return rest <= target && !infeasible_;
    }
    stalls = settled && full && size > infeasible_ratio * last_size ? stalls + 1 : 0;
    if (stalls == most_stalls) break;
    last_size = size;
    // Once the active bounds are settled, steps only reduce the residual.
    const double reduction = settled ? std::clamp(0.1 * enough / size, finest, coarse) : coarse;
    const double mu = std::max(centring * present, 0.1 * last_gap);
    const double length = take_step(mu, reduction, iterations);
    full = length > 0.8;
    centring = full ? 0.1 : 0.4;
    const bool exact = regularisation_ == 0.0 && over_.empty();
    short_steps_ = length < short_step && exact ? short_steps_ + 1 : 0;
    if (stalled()) break;
  }
  return false;
}

}  // namespace perilink

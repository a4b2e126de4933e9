#include "calibration/bounded_least_squares/interior_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibration/bounded_least_squares/direction_search.hpp"

namespace perilink {

void InteriorPoint::start() {
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
template <class Visit>
void InteriorPoint::for_each_rest(Visit visit) {
  for (std::size_t k = 0; k < over_.size(); ++k) {
    if (!normal_.has_penalty(k)) continue;
    visit(k, over_[k], normal_.penalty() - y_[k], under_[k], normal_.penalty() + y_[k]);
  }
}

/// Returns the mean of z (w - lower) and Z (upper - w).
double InteriorPoint::gap() const {
  if (weights_.empty()) return 0.0;
  double sum = 0.0;
  for (std::size_t v = 0; v < weights_.size(); ++v) {
    sum += at_lower_[v] * (weights_[v] - lower_[v]) + at_upper_[v] * (upper_[v] - weights_[v]);
  }
  return 0.5 * sum / static_cast<double>(weights_.size());
}

/// Computes the residual of the equations of the steps.
void InteriorPoint::measure(const std::vector<double>& weights, Vector& residual) const {
  normal_.measure(weights, y_, residual);
  for (std::size_t k = 0; k < y_.size(); ++k) residual[k] -= regularisation_ * y_[k];
}

/// Sets up the linear system of a Newton step towards z (w - lower) = mu. \return its right side
auto InteriorPoint::linearize(double mu) -> Vector {
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
template <class Visit>
void InteriorPoint::for_each_pair(const std::vector<double>& change, std::size_t begin,
                                  std::size_t end, Visit visit) {
  for (std::size_t v = begin; v < end; ++v) {
    visit(at_lower_[v], weights_[v] - lower_[v], change[v]);
    visit(at_upper_[v], upper_[v] - weights_[v], -change[v]);
  }
}

/// Calls visit(variable, slack, change of the slack) for residuals of equations with a penalty.
template <class Visit>
void InteriorPoint::for_each_pair_of_rests(const Vector& direction, Visit visit) {
  for_each_rest([&](std::size_t k, double& over, double below, double& under, double above) {
    visit(over, below, -direction[k]);
    visit(under, above, direction[k]);
  });
}

/// Takes a Newton step towards mu, as far as the bounds allow. \return its length
double InteriorPoint::take_step(double mu, double reduction, int& iterations) {
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
double InteriorPoint::largest_rest() const {
  double largest = 0.0;
  for (const double y : y_) largest = std::max(largest, std::abs(y));
  return regularisation_ * largest;
}

/// Whether a step that removes the residual due to the multipliers would double them. Multipliers
/// of infeasible equations grow without bound, others change little.
bool InteriorPoint::would_grow(int& iterations) {
  Vector rest(y_), change;
  for (double& value : rest) value *= regularisation_;
  iterations += normal_.solve(rest, coarse, change);
  return norm(change) > 0.5 * norm(y_);
}

bool InteriorPoint::solve(double target, int most, int& iterations) {
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

#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "discretization/normal_equations.hpp"

namespace perilink {

/// The problem of least_change() by a primal-dual interior-point method: weights w strictly between
/// their bounds with multipliers z, Z > 0 of these, w = 1 + A'y + z - Z, A w + ridge y = r and, on
/// the way to zero, z (w - lower) = Z (upper - w) = mu. Newton's method for all of these leaves the
/// system of NormalEquations with the mobility 1 / (1 + z / (w - lower) + Z / (upper - w)).
///
/// Newton's method on the dual function alone takes short steps where many weights pass their
/// bounds at once, and diverges where nothing is between the bounds; this one needs ten to thirty
/// steps whatever the bounds do. Where they contradict the equations the residual settles at the
/// least possible.
template <class Normal>
class InteriorPoint {
 public:
  using Vector = std::vector<double>;  // shape (points, rows)

  InteriorPoint(const PointEquations& equations, Normal& normal)
      : equations_(equations),
        normal_(normal),
        lower_(equations.lower),
        upper_(equations.upper),
        y_(equations.right.size(), 0.0),
        weights_(lower_.size()),
        elongation_(lower_.size(), 0.0),
        at_lower_(lower_.size()),
        at_upper_(lower_.size()) {}

  /// \param residual  norm of the scaled residual that is enough
  /// \return iterations of conjugate gradients
  int solve(double residual);
  const Vector& multipliers() const { return y_; }
  const std::vector<double>& weights() const { return weights_; }

 private:
  /// Multipliers of the bounds to begin with; those of soft equations grow to this order.
  static constexpr double first_gap = 30.0;
  /// z (w - lower) at the end: weights at a bound are off by its square root at most.
  static constexpr double last_gap = 1e-4;
  static constexpr int most_steps = 40;
  /// Part of the way to the nearest bound that a step may take.
  static constexpr double boldness = 0.99;
  /// A step of settled multipliers that leaves more than this of the residual leaves
  /// contradictions.
  static constexpr double contradiction = 0.9;

  void start();
  double gap() const;
  int take_step(double mu, double& length);

  const PointEquations& equations_;
  Normal& normal_;
  std::span<const double> lower_, upper_;
  Vector y_;
  std::vector<double> weights_;
  std::vector<double> elongation_;           // A' y
  std::vector<double> at_lower_, at_upper_;  // z, Z
};

template <class Normal>
void InteriorPoint<Normal>::start() {
  for (std::size_t v = 0; v < weights_.size(); ++v) {
    const double margin = 0.1 * std::min(1.0, upper_[v] - lower_[v]);
    weights_[v] = std::clamp(1.0, lower_[v] + margin, upper_[v] - margin);
    at_lower_[v] = first_gap / (weights_[v] - lower_[v]);
    at_upper_[v] = first_gap / (upper_[v] - weights_[v]);
  }
}

/// Mean of z (w - lower) and Z (upper - w).
template <class Normal>
double InteriorPoint<Normal>::gap() const {
  if (weights_.empty()) return 0.0;
  double sum = 0.0;
  for (std::size_t v = 0; v < weights_.size(); ++v) {
    sum += at_lower_[v] * (weights_[v] - lower_[v]) + at_upper_[v] * (upper_[v] - weights_[v]);
  }
  return 0.5 * sum / static_cast<double>(weights_.size());
}

/// A Newton step towards z (w - lower) = mu, as far as the bounds allow. \return iterations
template <class Normal>
int InteriorPoint<Normal>::take_step(double mu, double& length) {
  const std::size_t count = weights_.size();
  std::vector<double> pull(count), change(count);
  for (std::size_t v = 0; v < count; ++v) {
    const double below = weights_[v] - lower_[v], above = upper_[v] - weights_[v];
    normal_.mobility[v] = 1.0 / (1.0 + at_lower_[v] / below + at_upper_[v] / above);
    pull[v] = 1.0 + elongation_[v] - weights_[v] + mu / below - mu / above;
    change[v] = weights_[v] + normal_.mobility[v] * pull[v];
  }
  Vector residual, direction;
  normal_.measure(change, y_, residual);
  normal_.prepare();
  const int iterations = normal_.solve(residual, 1e-2, direction);
  std::vector<double> stretch(count);
  normal_.apply_transpose(direction, stretch);
  length = 1.0;
  const auto limit = [&](double distance, double approach) {
    if (approach > 0.0) length = std::min(length, boldness * distance / approach);
  };
  const auto change_of_z = [&](double z, double distance, double approach) {
    return (mu - z * (distance - approach)) / distance;
  };
  for (std::size_t v = 0; v < count; ++v) {
    const double below = weights_[v] - lower_[v], above = upper_[v] - weights_[v];
    change[v] = normal_.mobility[v] * (stretch[v] + pull[v]);
    limit(below, -change[v]);
    limit(above, change[v]);
    limit(at_lower_[v], -change_of_z(at_lower_[v], below, -change[v]));
    limit(at_upper_[v], -change_of_z(at_upper_[v], above, change[v]));
  }
  for (std::size_t v = 0; v < count; ++v) {
    const double below = weights_[v] - lower_[v], above = upper_[v] - weights_[v];
    at_lower_[v] += length * change_of_z(at_lower_[v], below, -change[v]);
    at_upper_[v] += length * change_of_z(at_upper_[v], above, change[v]);
    weights_[v] += length * change[v];
    elongation_[v] += length * stretch[v];
  }
  for (std::size_t k = 0; k < y_.size(); ++k) y_[k] += length * direction[k];
  return iterations;
}

template <class Normal>
int InteriorPoint<Normal>::solve(double target) {
  start();
  int iterations = 0;
  double centring = 0.2, last_size = std::numeric_limits<double>::infinity();
  Vector residual;
  for (int step = 0; step < most_steps; ++step) {
    normal_.measure(weights_, y_, residual);
    const double size = norm(residual), present = gap();
    if (present <= last_gap && (size <= target || size > contradiction * last_size)) break;
    last_size = size;
    double length = 1.0;
    iterations += take_step(centring * present, length);
    centring = length > 0.8 ? 0.1 : 0.4;
  }
  return iterations;
}

}  // namespace perilink

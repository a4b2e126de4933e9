#pragma once

#include <span>
#include <vector>

#include "calibration/bounded_least_squares/equations/normal_system.hpp"
#include "calibration/bounded_least_squares/equations/point_equations.hpp"

namespace perilink {

/// Solves bounded_least_squares() by a primal-dual interior-point method. Weights w stay strictly
/// between their bounds, whose multipliers are z, Z > 0: w = 1 + A'y + z - Z, A w + ridge y = r,
/// and z (w - lower) = Z (upper - w) = mu, which goes to zero. Newton's method for all of these
/// reduces to the NormalSystem with the active-set weights
/// 1 / (1 + z / (w - lower) + Z / (upper - w)).
///
/// Newton's method on the dual function takes short steps where many weights pass their bounds at
/// once, and diverges where no weight is between the bounds. This method needs ten to thirty steps
/// for any bounds. The residual of an equation with a penalty p is the difference of two positive
/// variables, s (p - y) = S (p + y) = mu, which add s / (p - y) + S / (p + y) to the diagonal.
///
/// Without a penalty the residual of an equation may be regularisation * y. Infeasible equations
/// then end near the least squared residual; without regularisation they would shorten every step.
class InteriorPoint {
 public:
  using Vector = std::vector<double>;  // shape (points, rows)

  InteriorPoint(const PointEquations& equations, NormalSystem& normal,
                const LeastSquaresOptions& options)
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
  NormalSystem& normal_;
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

}  // namespace perilink

#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace perilink {

/// The linear systems of the methods of bounded_least_squares(): S = A D A' + ridge, for scaled
/// equations A of weights and active-set weights D between 0 (at a bound) and 1.
class NormalSystem {
 public:
  using Vector = std::vector<double>;  // shape (points, rows)

  virtual ~NormalSystem() = default;

  /// Computes A' y.
  virtual void apply_transpose(const Vector& y, std::vector<double>& result) = 0;
  /// Computes the residual of the weights minus ridge times y and the relaxations.
  virtual void measure(const std::vector<double>& weights, const Vector& y,
                       Vector& residual) const = 0;
  /// Makes the preconditioner for the present active-set weights, or keeps an earlier factor while
  /// this takes less time than a new one.
  virtual void prepare() = 0;
  /// Makes the preconditioner, but keeps an earlier factor until it needs too many iterations.
  /// \param settled  the active weights are unchanged since the last step
  /// \param last  the step must satisfy the equations
  virtual void prepare_if_stale(bool settled, bool last) = 0;
  /// Solves S direction = residual until the residual is reduced by the factor.
  /// \return iterations; all of LeastSquaresOptions::iterations where a new factor does not help
  virtual int solve(const Vector& residual, double reduction, Vector& direction) = 0;

  /// Returns the largest multiplier of exact equations; infinity: they have no penalty.
  virtual double penalty() const = 0;
  virtual bool has_penalty(std::size_t equation) const = 0;
  /// Returns the relaxation of equation k: the excess of its multiplier y over the penalty.
  double relaxation(std::size_t k, double y) const {
    if (!has_penalty(k) || std::abs(y) <= penalty()) return 0.0;
    return y > 0.0 ? y - penalty() : y + penalty();
  }

  std::vector<double> active_weight;
  /// Compliance of exact equations, relaxation per unit of the multiplier, shape (points, rows);
  /// empty where no equation has a penalty.
  Vector compliance;
  /// Proximal regularisation, relative to equations of order one: infeasible residuals decay in
  /// each step by this over the smallest squared singular value. 0: the least value.
  double regularisation = 0.0;

 protected:
  explicit NormalSystem(std::size_t variables) : active_weight(variables, 1.0) {}
};

}  // namespace perilink

#pragma once

#include <limits>
#include <memory>
#include <vector>

#include <Eigen/Dense>

#include "calibration/bounded_least_squares/symmetry_reduced/reduced_equations.hpp"
#include "calibration/bounded_least_squares/symmetry_reduced/reduced_factor.hpp"

namespace perilink {

/// The counterpart of NormalEquations for symmetry-reduced variables. The matrices are small but
/// full, and symmetry makes some rows linearly dependent. A factor preconditions the conjugate
/// gradients and is renewed when it needs too many iterations.
class ReducedNormalEquations {
 public:
  using Vector = std::vector<double>;  // shape (points, rows)

  /// \param kept  holds the factor for the next problem
  ReducedNormalEquations(const ReducedEquations& reduced, std::unique_ptr<ReducedFactor>& kept);

  void apply_transpose(const Vector& y, std::vector<double>& result) const;
  /// Computes the residual of the unknowns minus ridge times y.
  void measure(const std::vector<double>& unknowns, const Vector& y, Vector& residual) const;
  /// Makes the factor for the present active-set weights.
  void prepare();
  void prepare_if_stale(bool settled, bool last);
  /// Solves S direction = residual until the residual is reduced by the factor. Renews a stale
  /// preconditioner where continuing would take longer, estimated from the last or the present
  /// solution.
  /// \return iterations
  int solve(const Vector& residual, double reduction, Vector& direction);

  /// Symmetry-reduced equations have no penalty.
  static constexpr double penalty() { return std::numeric_limits<double>::infinity(); }
  static constexpr bool has_penalty(std::size_t) { return false; }
  static constexpr double relaxation(std::size_t, double) { return 0.0; }

  std::vector<double> active_weight;
  Vector compliance;            // stays empty
  double regularisation = 0.0;  // stays zero: only lattices are symmetry-reduced

 private:
  const ReducedEquations& reduced_;
  ReducedEquations::Matrix transposed_;
  double regularisation_;
  Eigen::VectorXd shift_;  // added to the diagonal
  double eased_ = 0.0;     // part of the shift subtracted in products, not in the factor
  std::unique_ptr<ReducedFactor>& factor_;
  bool stale_ = true;  // whether the factor is of other active-set weights
  /// Decrease of the logarithm of the residual per iteration of the last solution.
  double gain_ = std::numeric_limits<double>::infinity();
};

}  // namespace perilink

#pragma once

#include <limits>
#include <memory>
#include <vector>

#include <Eigen/Dense>

#include "calibration/bounded_least_squares/symmetry_reduced/reduced_equations.hpp"
#include "calibration/bounded_least_squares/symmetry_reduced/reduced_factor.hpp"

namespace perilink {

/// The counterpart of NormalEquations for symmetry-reduced variables. The matrices are small but
/// full, and symmetry makes some rows linearly dependent: a factor preconditions the conjugate
/// gradients, and is renewed when it serves badly.
class ReducedNormalEquations {
 public:
  using Vector = std::vector<double>;  // shape (points, rows)

  /// \param kept  holds the factor for the next problem
  ReducedNormalEquations(const ReducedEquations& reduced, std::unique_ptr<ReducedFactor>& kept);

  void apply_transpose(const Vector& y, std::vector<double>& result) const;
  /// Residual of the unknowns, less ridge times y.
  void measure(const std::vector<double>& unknowns, const Vector& y, Vector& residual) const;
  /// Makes the factor for the present active-set weights.
  void prepare();
  void prepare_if_stale(bool settled, bool last);
  /// S direction = residual, the residual reduced by the factor. A stale preconditioner is made
  /// anew where it would take longer to go on with it, by the last solution or by this one.
  /// \return iterations
  int solve(const Vector& residual, double reduction, Vector& direction);

  /// Symmetry-reduced equations have no penalty.
  static constexpr double penalty() { return std::numeric_limits<double>::infinity(); }
  static constexpr bool has_penalty(std::size_t) { return false; }
  static constexpr double relaxation(std::size_t, double) { return 0.0; }

  std::vector<double> active_weight;
  Vector compliance;            // stays empty
  double regularisation = 0.0;  // stays zero: only lattices are reduced

 private:
  const ReducedEquations& reduced_;
  ReducedEquations::Matrix transposed_;
  double regularisation_;
  Eigen::VectorXd shift_;  // added to the diagonal
  double eased_ = 0.0;     // and taken back in the products, but not in the factor
  std::unique_ptr<ReducedFactor>& factor_;
  bool stale_ = true;  // the factor is of other active-set weights
  /// Decrease of the logarithm of the residual per iteration of the last solution.
  double gain_ = std::numeric_limits<double>::infinity();
};

}  // namespace perilink

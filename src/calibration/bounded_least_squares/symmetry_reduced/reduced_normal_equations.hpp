#pragma once

#include <limits>
#include <memory>
#include <vector>

#include <Eigen/Dense>

#include "calibration/bounded_least_squares/equations/normal_system.hpp"
#include "calibration/bounded_least_squares/symmetry_reduced/reduced_equations.hpp"
#include "calibration/bounded_least_squares/symmetry_reduced/reduced_factor.hpp"

namespace perilink {

/// NormalSystem of symmetry-reduced variables. The matrices are small but full, and symmetry makes
/// some rows linearly dependent. A factor preconditions the conjugate gradients and is renewed when
/// it needs too many iterations. Only lattices are symmetry-reduced: no equation has a penalty, and
/// the regularisation stays zero.
class ReducedNormalEquations final : public NormalSystem {
 public:
  /// \param kept  holds the factor for the next problem
  ReducedNormalEquations(const ReducedEquations& reduced, std::unique_ptr<ReducedFactor>& kept);

  void apply_transpose(const Vector& y, std::vector<double>& result) override;
  void measure(const std::vector<double>& unknowns, const Vector& y,
               Vector& residual) const override;
  void prepare() override;
  void prepare_if_stale(bool settled, bool last) override;
  int solve(const Vector& residual, double reduction, Vector& direction) override;
  double penalty() const override { return std::numeric_limits<double>::infinity(); }
  bool has_penalty(std::size_t) const override { return false; }

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

#pragma once

#include <limits>
#include <memory>
#include <vector>

#include <Eigen/Dense>

#include "calibration/least_change/tied/tied_equations.hpp"
#include "calibration/least_change/tied/tied_factor.hpp"

namespace perilink {

/// The counterpart of NormalEquations for tied variables. The matrices are small but full, and
/// symmetry makes some rows depend on others: a factor, renewed when it serves badly, preconditions
/// the conjugate gradients.
class TiedNormalEquations {
 public:
  using Vector = std::vector<double>;  // shape (points, rows)

  /// \param kept  holds the factor, for the next search
  TiedNormalEquations(const TiedEquations& tied, std::unique_ptr<TiedFactor>& kept);

  void apply_transpose(const Vector& y, std::vector<double>& result) const;
  /// What the unknowns leave of the right sides, less ridge times y.
  void measure(const std::vector<double>& unknowns, const Vector& y, Vector& residual) const;
  /// Makes the factor for the mobility as it is now.
  void prepare();
  void prepare_if_stale(bool settled, bool last);
  /// S direction = residual, the residual reduced by the factor. A stale preconditioner is made
  /// anew where it would take longer to go on with it, by the last solution or by this one.
  /// \return iterations
  int solve(const Vector& residual, double reduction, Vector& direction);

  /// Operations so far.
  double spent() const { return spent_; }

  /// Tied equations have no price.
  static constexpr double price() { return std::numeric_limits<double>::infinity(); }
  static constexpr bool has_price(std::size_t) { return false; }
  static constexpr double given_up(std::size_t, double) { return 0.0; }

  std::vector<double> mobility;
  Vector compliance;       // stays empty
  double proximity = 0.0;  // stays zero: tied equations are those of lattices

 private:
  const TiedEquations& tied_;
  TiedEquations::Matrix transposed_;
  double proximity_;
  Eigen::VectorXd shift_;  // added to the diagonal
  double eased_ = 0.0;     // and taken back in the products, but not in the factor
  std::unique_ptr<TiedFactor>& factor_;
  bool stale_ = true;  // the factor is of another mobility
  /// What an iteration of the last solution took off the logarithm of the residual.
  double gain_ = std::numeric_limits<double>::infinity();
  double spent_ = 0.0;
};

}  // namespace perilink

#pragma once

#include <memory>
#include <vector>

#include "calibration/bounded_least_squares/equations/point_equations.hpp"
#include "calibration/bounded_least_squares/equations/point_matrix.hpp"
#include "solver/factor.hpp"

namespace perilink {

/// Factor of the whole system A D A' + diagonal of bounded_least_squares(), for bodies and
/// boundaries in the plane and for few variables.
class EquationsFactor {
 public:
  /// Makes the pattern, which does not depend on the weights.
  explicit EquationsFactor(const PointEquations& equations);

  /// Factorises for the equations of the constructor; to be called again when the weights change.
  /// \param active  active-set weight per variable, from 0 to 1
  /// \param diagonal  added to the diagonal of the system, shape (points, rows)
  void factorize(const PointEquations& equations, const std::vector<double>& active,
                 const std::vector<double>& diagonal);

  /// Computes result = S^-1 residual, both of shape (points, rows).
  void solve(const std::vector<double>& residual, std::vector<double>& result) const;

 private:
  void fill(const PointEquations& equations, const std::vector<double>& active,
            const std::vector<double>& diagonal, double floor);

  int rows_;
  PointMatrix matrix_;
  std::unique_ptr<Factor> factor_;
};

}  // namespace perilink

#pragma once

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include "calibration/least_change/point_equations.hpp"
#include "calibration/least_change/point_matrix.hpp"
#include "solver/factor.hpp"

namespace perilink {

/// The problem of least_change() whose variables share unknowns (PointEquations::unknown), with a
/// column of the matrix for each unknown. That of n variables stands for sqrt(n) times their
/// change, w = 1 + (u - 1) / sqrt(n), so that squares of changes count for each variable.
struct TiedEquations {
  using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

  PointEquations equations;  ///< right sides, scale and ridge; bounds of the unknowns
  /// Scaled, shape (points * rows, unknowns). Where rows of a point follow from each other they are
  /// those of a basis, and zero behind it.
  Matrix matrix;
  std::vector<double> root;       ///< sqrt(n) of each unknown
  std::vector<Index> unknown_of;  ///< per variable

  /// Weights of the variables from the unknowns.
  std::vector<double> weights(std::span<const double> unknowns) const;
};

/// \param bases  for the rows of each point, shape (rows, rows): empty at first, and kept for the
///               next search, whose factor and multipliers go by them
TiedEquations tie(const PointEquations& equations, std::vector<Eigen::MatrixXd>& bases);

/// Factor of the system of tied variables, M D M' + shift.
class TiedFactor {
 public:
  /// \param columns  the matrix, transposed
  TiedFactor(const TiedEquations& tied, const TiedEquations::Matrix& columns);

  /// Whether it can be made for these columns, too.
  bool fits(const TiedEquations& tied, const TiedEquations::Matrix& columns) const;
  /// \param mobility  D
  /// \param shift     added to the diagonal
  void factorize(const TiedEquations::Matrix& columns, std::span<const double> mobility,
                 std::span<const double> shift);
  void solve(std::span<const double> residual, std::span<double> result) const;
  /// Iterations of conjugate gradients that take as long as a new factor.
  int worth() const;
  /// What a factor takes, and a solution in operations of a factor.
  double operations() const { return statistics_.flops; }
  double operations_of_solution() const;

 private:
  std::vector<Index> place_rows(const TiedEquations& tied);

  Index rows_;
  std::vector<Index> row_;    // those that hold something, ascending
  std::vector<Index> place_;  // per row: its place among those of its point
  FactorStatistics statistics_;
  PointMatrix matrix_;
  std::unique_ptr<Factor> factor_;
};

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
  /// S direction = residual, the residual reduced by the factor. \return iterations
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
  Eigen::VectorXd shift_;  // added to the diagonal
  double eased_ = 0.0;     // and taken back in the products, but not in the factor
  std::unique_ptr<TiedFactor>& factor_;
  int last_iterations_ = 0;
  double spent_ = 0.0;
};

}  // namespace perilink

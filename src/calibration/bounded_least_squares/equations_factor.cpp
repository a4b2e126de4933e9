#include "calibration/bounded_least_squares/equations_factor.hpp"

#include <omp.h>

#include <array>

#include <Eigen/Core>

#include "base/error.hpp"
#include "calibration/bounded_least_squares/equations/variable_parts.hpp"
#include "solver/factor_routes.hpp"

namespace perilink {
namespace {

/// Additions to the diagonal, relative to its mean at each point: round-off must not make pivots of
/// dependent rows negative. Conjugate gradients correct the error of the factor. Larger values are
/// needed only with many dependent rows.
constexpr std::array<double, 3> floors = {1e-14, 1e-12, 1e-10};

PointMatrix::Pairs shared_points(const PointEquations& equations) {
  PointMatrix::Pairs pairs;
  ColumnBlocks<Eigen::Matrix<double, 1, 1>> column;
  for (Index v = 0; v < equations.num_variables(); ++v) {
    column.count = 0;
    for_each_part(equations, v, [&](Index p, int, int, double) { column.of(p); });
    for (int k = 0; k < column.count; ++k) {
      for (int l = 0; l < column.count; ++l) {
        if (column.keys[k] < column.keys[l]) pairs.emplace_back(column.keys[k], column.keys[l]);
      }
    }
  }
  return pairs;
}

std::vector<Index> first_rows(const PointEquations& equations) {
  std::vector<Index> first;
  for (Index p = 0; p <= equations.num_points(); ++p) first.push_back(p * equations.rows);
  return first;
}

}  // namespace

EquationsFactor::EquationsFactor(const PointEquations& equations)
    : rows_(equations.rows), matrix_(first_rows(equations), shared_points(equations)) {}

void EquationsFactor::fill(const PointEquations& equations, const std::vector<double>& active,
                           const std::vector<double>& diagonal, double floor) {
  matrix_.set_zero();
  ColumnBlocks<Eigen::VectorXd> column;
  column.blocks.fill(Eigen::VectorXd::Zero(rows_));
  for (Index v = 0; v < equations.num_variables(); ++v) {
    if (active[v] == 0.0) continue;
    gather_column(equations, v, column);
    for (int k = 0; k < column.count; ++k) {
      for (int l = 0; l < column.count; ++l) {
        if (column.keys[k] > column.keys[l]) continue;
        const bool own = k == l;
        for (int c = 0; c < rows_; ++c) {
          const double factor = active[v] * column.blocks[k][c];
          if (factor == 0.0) continue;
          double* values = matrix_.block(column.keys[k], column.keys[l], c);
          for (int r = own ? c : 0; r < rows_; ++r) values[r] += factor * column.blocks[l][r];
        }
      }
    }
  }
  for (Index p = 0; p < equations.num_points(); ++p) {
    double trace = 0.0;
    for (int r = 0; r < rows_; ++r) trace += matrix_.block(p, p, r)[r];
    for (int r = 0; r < rows_; ++r) {
      double& entry = matrix_.block(p, p, r)[r];
      entry += entry > 0.0
                   ? diagonal[static_cast<std::size_t>(p * rows_ + r)] + floor * trace / rows_
                   : 1.0;
    }
  }
}

void EquationsFactor::factorize(const PointEquations& equations, const std::vector<double>& active,
                                const std::vector<double>& diagonal) {
  for (const double floor : floors) {
    fill(equations, active, diagonal, floor);
    try {
      if (factor_) return factor_->refactorize(matrix_.matrix());
      factor_ = make_factor(FactorRoute::in_place, omp_get_max_threads());
      return factor_->factorize(matrix_.matrix(), matrix_.point_of_rows());
    } catch (const SolverError&) {
      if (floor == floors.back()) throw;
      factor_.reset();
    }
  }
}

void EquationsFactor::solve(const std::vector<double>& residual,
                            std::vector<double>& result) const {
  factor_->solve(residual, result);
}

}  // namespace perilink

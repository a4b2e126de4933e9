#include "calibration/least_change/equations_factor.hpp"

#include <omp.h>

#include <algorithm>
#include <array>
#include <utility>

#include <Eigen/Core>

#include "base/error.hpp"
#include "calibration/least_change/variable_parts.hpp"
#include "solver/factor_routes.hpp"

namespace perilink {
namespace {

/// Added to the diagonal, relative to its mean at each point: round-off must not make rows negative
/// that depend on others. What the factor misses by it the conjugate gradients make up for; more is
/// needed only where many rows depend on others.
constexpr std::array<double, 3> floors = {1e-14, 1e-12, 1e-10};

}  // namespace

EquationsFactor::EquationsFactor(const PointEquations& equations) : rows_(equations.rows) {
  std::vector<std::pair<Index, Index>> pairs;
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
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  const Index points = equations.num_points(), size = points * rows_;
  offsets_.assign(static_cast<std::size_t>(points) + 1, 0);
  for (const auto& [point, later] : pairs) {
    ++offsets_[point + 1];
    later_.push_back(later);
  }
  for (Index p = 0; p < points; ++p) offsets_[p + 1] += offsets_[p];
  matrix_.resize(size, size);
  matrix_.resizeNonZeros(static_cast<Index>(later_.size()) * rows_ * rows_ +
                         points * rows_ * (rows_ + 1) / 2);
  Index next = 0;
  for (Index p = 0; p < points; ++p) {
    for (Index c = 0; c < rows_; ++c) {
      matrix_.outerIndexPtr()[p * rows_ + c] = next;
      for (Index r = c; r < rows_; ++r) matrix_.innerIndexPtr()[next++] = p * rows_ + r;
      for (Index k = offsets_[p]; k < offsets_[p + 1]; ++k) {
        for (Index r = 0; r < rows_; ++r) matrix_.innerIndexPtr()[next++] = later_[k] * rows_ + r;
      }
    }
  }
  matrix_.outerIndexPtr()[size] = next;
}

/// Where the rows of a point begin in a column of another one before it, or in its own (where
/// those above the column are not stored).
double* EquationsFactor::block(Index upper, Index lower, int column) {
  double* begin = matrix_.valuePtr() + matrix_.outerIndexPtr()[upper * rows_ + column];
  if (upper == lower) return begin - column;
  const auto first = later_.begin() + offsets_[upper], last = later_.begin() + offsets_[upper + 1];
  return begin + rows_ - column + (std::lower_bound(first, last, lower) - first) * rows_;
}

void EquationsFactor::fill(const PointEquations& equations, const std::vector<double>& active,
                           const std::vector<double>& diagonal, double floor) {
  std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
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
          double* values = block(column.keys[k], column.keys[l], c);
          for (int r = own ? c : 0; r < rows_; ++r) values[r] += factor * column.blocks[l][r];
        }
      }
    }
  }
  for (Index p = 0; p < equations.num_points(); ++p) {
    double trace = 0.0;
    for (int r = 0; r < rows_; ++r) trace += block(p, p, r)[r];
    for (int r = 0; r < rows_; ++r) {
      double& entry = block(p, p, r)[r];
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
      if (factor_) return factor_->refactorize(matrix_);
      std::vector<Index> point_of(static_cast<std::size_t>(matrix_.cols()));
      for (std::size_t k = 0; k < point_of.size(); ++k) {
        point_of[k] = static_cast<Index>(k / static_cast<std::size_t>(rows_));
      }
      factor_ = make_factor(FactorRoute::in_place, omp_get_max_threads());
      return factor_->factorize(matrix_, point_of);
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

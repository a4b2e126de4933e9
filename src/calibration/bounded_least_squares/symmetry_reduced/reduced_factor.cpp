#include "calibration/bounded_least_squares/symmetry_reduced/reduced_factor.hpp"

#include <omp.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>

#include "base/error.hpp"
#include "calibration/bounded_least_squares/equations/point_matrix.hpp"

namespace perilink {
namespace {

/// Further additions to the diagonal of the factor, relative to its mean: round-off of single
/// precision must not make pivots of dependent rows negative. Larger values are used where it does.
constexpr std::array<double, 3> pivot_floors = {1e-7, 1e-6, 1e-5};

std::vector<std::pair<Index, Index>> shared_points(const ReducedEquations::Matrix& columns,
                                                   Index rows) {
  auto pairs = shared_variables(columns, rows);
  std::erase_if(pairs,
                [](const std::pair<Index, Index>& pair) { return pair.first == pair.second; });
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace

ReducedFactor::ReducedFactor(const ReducedEquations& reduced,
                             const ReducedEquations::Matrix& columns)
    : rows_(reduced.equations.rows), pairs_(shared_points(columns, rows_)) {
  const Index num_points = reduced.equations.num_points();
  const auto holds = [&](Index row) {
    return reduced.matrix.outerIndexPtr()[row + 1] > reduced.matrix.outerIndexPtr()[row];
  };
  std::vector<Index> each(static_cast<std::size_t>(num_points) + 1), sizes(each.size() - 1, 0);
  std::iota(each.begin(), each.end(), 0);
  for (Index row = 0; row < num_points * rows_; ++row) sizes[row / rows_] += holds(row);
  const PointMatrix graph(std::move(each), pairs_);
  factor_ = std::make_unique<PreconditionerFactor>(graph.matrix(), sizes, omp_get_max_threads());
  place_.assign(reduced.equations.right.size(), no_index);
  for (const Index p : factor_->order()) {
    for (Index row = p * rows_; row < (p + 1) * rows_; ++row) {
      if (!holds(row)) continue;
      place_[row] = static_cast<Index>(row_.size());
      row_.push_back(row);
    }
  }
}

bool ReducedFactor::fits(const ReducedEquations& reduced,
                         const ReducedEquations::Matrix& columns) const {
  if (rows_ != reduced.equations.rows || place_.size() != reduced.equations.right.size())
    return false;
  const std::span<const int> used(columns.innerIndexPtr(),
                                  static_cast<std::size_t>(columns.nonZeros()));
  return std::ranges::all_of(used, [&](int row) { return place_[row] != no_index; }) &&
         std::ranges::includes(pairs_, shared_points(columns, rows_));
}

void ReducedFactor::sort(ReducedEquations::Matrix& columns) const {
  std::vector<std::pair<int, double>> entries;
  for (Eigen::Index u = 0; u < columns.rows(); ++u) {
    const int begin = columns.outerIndexPtr()[u], end = columns.outerIndexPtr()[u + 1];
    entries.clear();
    for (int k = begin; k < end; ++k) {
      entries.emplace_back(columns.innerIndexPtr()[k], columns.valuePtr()[k]);
    }
    std::ranges::sort(entries, {}, [&](const auto& entry) { return place_[entry.first]; });
    for (int k = begin; k < end; ++k) {
      std::tie(columns.innerIndexPtr()[k], columns.valuePtr()[k]) = entries[k - begin];
    }
  }
}

/// Returns the positions of the entries of rows among the entries of their unknowns.
std::vector<int> ReducedFactor::own_entries(const ReducedEquations::Matrix& matrix,
                                            const ReducedEquations::Matrix& columns) const {
  std::vector<int> own(static_cast<std::size_t>(matrix.nonZeros()));
  std::vector<int> next(matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.rows());
  for (Eigen::Index u = 0; u < columns.rows(); ++u) {
    for (int k = columns.outerIndexPtr()[u]; k < columns.outerIndexPtr()[u + 1]; ++k) {
      own[next[columns.innerIndexPtr()[k]]++] = k;
    }
  }
  return own;
}

void ReducedFactor::factorize(const ReducedEquations::Matrix& matrix,
                              const ReducedEquations::Matrix& columns,
                              std::span<const double> active_weight,
                              std::span<const double> shift) {
  const std::vector<int> own = own_entries(matrix, columns);
  const int* row = columns.innerIndexPtr();
  const double* value = columns.valuePtr();
  double trace = 0.0;
  for (Eigen::Index k = 0; k < matrix.nonZeros(); ++k) {
    const double number = matrix.valuePtr()[k];
    trace += number * number * active_weight[matrix.innerIndexPtr()[k]];
  }
  const double mean = trace / static_cast<double>(row_.size());
  for (const double floor : pivot_floors) {
    const auto add = [&](Index column, std::span<const Index> place, std::span<double> values) {
      const Index own_row = row_[column];
      for (int k = matrix.outerIndexPtr()[own_row]; k < matrix.outerIndexPtr()[own_row + 1]; ++k) {
        const int unknown = matrix.innerIndexPtr()[k];
        const double factor = matrix.valuePtr()[k] * active_weight[unknown];
        if (factor == 0.0) continue;
        for (int e = own[k]; e < columns.outerIndexPtr()[unknown + 1]; ++e) {
          values[place[place_[row[e]]]] += factor * value[e];
        }
      }
      double& diagonal = values[place[column]];
      diagonal += (diagonal > 0.0 ? shift[own_row] : 1.0) + floor * mean;
    };
    if (factor_->factorize(add)) return;
  }
  throw SolverError("the symmetry-reduced calibration equations have no factor");
}

void ReducedFactor::solve(std::span<const double> residual, std::span<double> result) const {
  std::vector<double> some;
  for (const Index row : row_) some.push_back(residual[row]);
  factor_->solve(some);
  std::ranges::fill(result, 0.0);
  for (std::size_t k = 0; k < row_.size(); ++k) result[row_[k]] = some[k];
}

double ReducedFactor::iterations_of_factor() const {
  // An operation of a solution, limited by memory, takes as long as this many operations of a
  // factorisation.
  constexpr double slower = 5.5;
  const FactorStatistics statistics = factor_->statistics();
  return statistics.flops / (4.0 * slower * statistics.entries);
}

}  // namespace perilink

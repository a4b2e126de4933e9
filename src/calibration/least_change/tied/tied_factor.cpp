#include "calibration/least_change/tied/tied_factor.hpp"

#include <omp.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>

#include "base/error.hpp"
#include "solver/factor_routes.hpp"
#include "solver/ordering.hpp"

namespace perilink {
namespace {

/// Added to the diagonal of the factor beside that, relative to its mean: round-off of single
/// precision must not make rows negative that depend on others. More where it does.
constexpr std::array<double, 3> floors = {1e-7, 1e-6, 1e-5};
/// A new factor costs as much as this many iterations at least ...
constexpr double stale_iterations = 10.0;
/// ... and more of large factors: an operation of a solution, whose speed is that of the memory,
/// takes as long as so many of a factor. New factors are worth more than their time.
constexpr double slower = 4.0, worth_more = 4.0;

PointMatrix::Pairs shared_points(const TiedEquations::Matrix& columns, Index rows) {
  PointMatrix::Pairs pairs = shared_variables(columns, rows);
  std::erase_if(pairs,
                [](const std::pair<Index, Index>& pair) { return pair.first == pair.second; });
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

/// Where each point comes in the order of elimination.
std::vector<Index> order_of(const PointMatrix::Pairs& pairs, Index num_points) {
  std::vector<Index> each(static_cast<std::size_t>(num_points) + 1);
  std::iota(each.begin(), each.end(), 0);
  const PointMatrix graph(std::move(each), pairs);
  return invert(elimination_order(graph.matrix()));
}

}  // namespace

TiedFactor::TiedFactor(const TiedEquations& tied, const TiedEquations::Matrix& columns)
    : rows_(tied.equations.rows), matrix_(make_matrix(tied, shared_points(columns, rows_))) {}

PointMatrix::Pairs TiedFactor::in_order(PointMatrix::Pairs pairs) const {
  for (auto& [p, q] : pairs) std::tie(p, q) = std::minmax({order_[p], order_[q]});
  return pairs;
}

/// The pattern, of the rows that hold something.
PointMatrix TiedFactor::make_matrix(const TiedEquations& tied, const PointMatrix::Pairs& pairs) {
  order_ = order_of(pairs, tied.equations.num_points());
  place_.assign(tied.equations.right.size(), no_index);
  std::vector<Index> first_row;
  for (const Index p : invert(order_)) {
    first_row.push_back(static_cast<Index>(row_.size()));
    for (Index k = p * rows_; k < (p + 1) * rows_; ++k) {
      if (tied.matrix.outerIndexPtr()[k + 1] == tied.matrix.outerIndexPtr()[k]) continue;
      place_[k] = static_cast<Index>(row_.size()) - first_row.back();
      row_.push_back(k);
    }
  }
  first_row.push_back(static_cast<Index>(row_.size()));
  return {std::move(first_row), in_order(pairs)};
}

bool TiedFactor::fits(const TiedEquations& tied, const TiedEquations::Matrix& columns) const {
  if (rows_ != tied.equations.rows || place_.size() != tied.equations.right.size()) return false;
  const std::span<const int> used(columns.innerIndexPtr(),
                                  static_cast<std::size_t>(columns.nonZeros()));
  return std::ranges::all_of(used, [&](int row) { return place_[row] != no_index; }) &&
         matrix_.holds(in_order(shared_points(columns, rows_)));
}

void TiedFactor::factorize(const TiedEquations::Matrix& columns, std::span<const double> mobility,
                           std::span<const double> shift) {
  matrix_.set_zero();
  const int* row_of = columns.innerIndexPtr();
  const double* value = columns.valuePtr();
  for (Index u = 0; u < static_cast<Index>(columns.rows()); ++u) {
    if (mobility[u] == 0.0) continue;
    for_each_point(columns, u, rows_, [&](int first, int last) {
      const Index upper = order_[row_of[first] / rows_];
      for_each_point(columns, u, rows_, [&](int from, int to) {
        const Index lower = order_[row_of[from] / rows_];
        if (lower < upper) return;
        for (int c = first; c < last; ++c) {
          const double factor = value[c] * mobility[u];
          double* entries = matrix_.block(upper, lower, place_[row_of[c]]);
          for (int r = upper == lower ? c : from; r < to; ++r) {
            entries[place_[row_of[r]]] += factor * value[r];
          }
        }
      });
    });
  }
  const auto entry = [&](Index row) -> double& {
    const Index point = order_[row / rows_];
    return matrix_.block(point, point, place_[row])[place_[row]];
  };
  if (!factor_) {
    factor_ = std::make_unique<PreconditionerFactor>(matrix_.matrix(), omp_get_max_threads());
    statistics_ = factor_->statistics();
  }
  double trace = 0.0;
  for (const Index row : row_) trace += entry(row);
  const double mean = trace / static_cast<double>(row_.size());
  for (const Index row : row_) entry(row) += entry(row) > 0.0 ? shift[row] : 1.0;
  double before = 0.0;
  for (const double floor : floors) {
    for (const Index row : row_) entry(row) += (floor - before) * mean;
    before = floor;
    if (factor_->factorize(matrix_.matrix())) return;
  }
  throw SolverError("the equations of bonds that are made alike have no factor");
}

void TiedFactor::solve(std::span<const double> residual, std::span<double> result) const {
  std::vector<double> some;
  for (const Index row : row_) some.push_back(residual[row]);
  factor_->solve(some);
  std::ranges::fill(result, 0.0);
  for (std::size_t k = 0; k < row_.size(); ++k) result[row_[k]] = some[k];
}

double TiedFactor::price() const {
  return std::max(stale_iterations, statistics_.flops / operations_of_solution());
}

double TiedFactor::worth() const { return std::max(stale_iterations, price() / worth_more); }

double TiedFactor::operations_of_solution() const { return 4.0 * slower * statistics_.entries; }

}  // namespace perilink

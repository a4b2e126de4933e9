#include "calibration/bounded_least_squares/symmetry_reduced/independent_rows.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/dense/decompositions.hpp"
#include "base/side_by_side.hpp"

namespace perilink {
namespace {

/// Squares of rows are zero below this fraction of the largest of their point or of their former
/// size. Round-off gives 1e-17 of the first and 4e-15 of the second; independent rows have 1e-9.
constexpr double independent = 1e-13;
/// Fraction of the squares of the rows that an earlier basis may leave out.
constexpr double missed = 1e-9;

/// Points that share at least this fraction of their variables may have linearly dependent rows,
/// ...
constexpr double alike = 0.5;
/// ... which are examined together, up to this number.
constexpr std::size_t most_together = 600;
/// Least inconsistency of the right side of a dependent row, over the largest right side. Round-off
/// gives 1e-12.
constexpr double implied_right = 1e-10;

/// Returns an orthonormal basis of the rows of a point as columns, filled with zeros.
/// \param products  A A'
Eigen::MatrixXd basis_of(const Eigen::MatrixXd& products) {
  const Eigen::Index rows = products.rows();
  const Eigenvectors squares = eigenvectors(products);
  const Eigen::VectorXd& sizes = squares.values;  // ascending
  const Eigen::Index none = (sizes.array() <= independent * sizes[rows - 1]).count();
  if (none == 0) return Eigen::MatrixXd::Identity(rows, rows);
  Eigen::MatrixXd basis = squares.vectors.rowwise().reverse();
  basis.rightCols(none).setZero();
  return basis;
}

/// Returns groups of points that share most of their variables.
std::vector<std::vector<Index>> alike_points(const ReducedEquations& reduced) {
  const Index num_points = reduced.equations.num_points();
  const auto pairs = shared_variables(reduced.matrix.transpose(), reduced.equations.rows);
  const auto count = [&](Index p, Index q) {
    const auto all = std::ranges::equal_range(pairs, std::pair(p, q));
    return static_cast<double>(std::ranges::ssize(all));
  };
  std::vector<double> variables;
  std::vector<Index> leader(static_cast<std::size_t>(num_points));
  std::iota(leader.begin(), leader.end(), 0);
  for (Index p = 0; p < num_points; ++p) variables.push_back(count(p, p));
  const auto lead = [&](Index p) {
    while (leader[p] != p) p = leader[p] = leader[leader[p]];
    return p;
  };
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [p, q] = pairs[k];
    if (p == q || (k > 0 && pairs[k] == pairs[k - 1])) continue;
    if (count(p, q) <= alike * std::min(variables[p], variables[q])) continue;
    const auto [first, second] = std::minmax({lead(p), lead(q)});
    leader[second] = first;
  }
  std::vector<std::vector<Index>> groups(static_cast<std::size_t>(num_points));
  for (Index p = 0; p < num_points; ++p) groups[lead(p)].push_back(p);
  return groups;
}

/// Marks linearly dependent rows among the given rows.
/// \param before  marks of an earlier problem, which are preferred
void find_implied(const ReducedEquations& reduced, const std::vector<Index>& rows,
                  const std::vector<std::uint8_t>& before, std::vector<std::uint8_t>& implied) {
  if (rows.size() < 2) return;
  const Eigen::Index size = static_cast<Eigen::Index>(rows.size());
  ReducedEquations::Matrix own(size, reduced.matrix.cols());
  Eigen::VectorXd right(size);
  for (Eigen::Index k = 0; k < size; ++k) {
    own.startVec(k);
    const double scale = 1.0 / reduced.matrix.row(rows[k]).norm();
    right[k] = scale * reduced.equations.right[rows[k]];
    for (ReducedEquations::Matrix::InnerIterator entry(reduced.matrix, rows[k]); entry; ++entry) {
      own.insertBack(k, entry.col()) = scale * entry.value();
    }
  }
  own.finalize();
  const Eigen::MatrixXd products = (own * own.transpose()).toDense();
  Eigen::MatrixXd factor(size, size);  // Cholesky factor of the independent rows
  Eigen::VectorXd left = products.diagonal();
  const double largest = right.cwiseAbs().maxCoeff();
  std::vector<std::uint8_t> open(rows.size(), 1);
  Eigen::Index taken = 0;
  for (const bool again : {false, true}) {
    while (true) {
      Eigen::Index next = -1;
      for (Eigen::Index k = 0; k < size; ++k) {
        if (!open[k] || left[k] <= independent || (before[rows[k]] && !again)) continue;
        if (next < 0 || left[k] > left[next]) next = k;
      }
      if (next < 0) break;
      open[next] = 0;
      const double pivot = std::sqrt(left[next]);
      auto column = factor.col(taken);
      column = products.col(next);
      column.noalias() -= factor.leftCols(taken) * factor.row(next).head(taken).transpose();
      column /= pivot;
      left -= column.cwiseAbs2();
      right -= (right[next] / pivot * column).eval();
      ++taken;
    }
  }
  for (Eigen::Index k = 0; k < size; ++k) {
    implied[rows[k]] = open[k] && std::abs(right[k]) <= implied_right * largest;
  }
}

}  // namespace

void turn_rows(PointRows& own, Eigen::MatrixXd& basis) {
  const Eigen::Index rows = own.values.rows();
  const Eigen::MatrixXd products = own.values * own.values.transpose();
  const auto misses_some = [&] {
    const double held = (basis.transpose() * products * basis).trace();
    return held < (1.0 - missed) * products.trace();
  };
  if (basis.rows() != rows || misses_some()) basis = basis_of(products);
  own.values = (basis.transpose() * own.values).eval();
  own.right = (basis.transpose() * own.right).eval();
}

void leave_out_implied(ReducedEquations& reduced, std::vector<std::uint8_t>& implied) {
  const Index per_point = reduced.equations.rows;
  implied.resize(reduced.equations.right.size(), 0);
  const std::vector<std::uint8_t> before =
      std::exchange(implied, std::vector<std::uint8_t>(implied.size(), 0));
  std::vector<std::vector<Index>> together;  // rows
  for (const auto& group : alike_points(reduced)) {
    if (group.size() < 2) continue;
    together.emplace_back();
    for (const Index p : group) {
      if (together.back().size() > most_together) together.emplace_back();
      for (Index k = p * per_point; k < (p + 1) * per_point; ++k) {
        if (reduced.matrix.outerIndexPtr()[k + 1] > reduced.matrix.outerIndexPtr()[k]) {
          together.back().push_back(k);
        }
      }
    }
  }
  for_each_side_by_side(static_cast<Index>(together.size()), omp_get_max_threads(),
                        [&](Index g) { find_implied(reduced, together[g], before, implied); });
  reduced.matrix.prune([&](Eigen::Index row, Eigen::Index, double) { return !implied[row]; });
  for (std::size_t k = 0; k < implied.size(); ++k) {
    if (implied[k]) reduced.equations.right[k] = 0.0;
  }
}

}  // namespace perilink

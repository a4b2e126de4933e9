#include "calibration/bounded_least_squares/coarse_system.hpp"

#include <omp.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/side_by_side.hpp"
#include "solver/dense/dense_kernels.hpp"
#include "solver/factor_routes.hpp"

namespace perilink {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Largest stiffness of modes of aggregates relative to their blocks, and their expected number.
/// All these modes are used: with many weights at their bounds, a limit of 120 costs thousands of
/// iterations.
constexpr double soft_in_large = 0.02;
constexpr int expected_in_large = 140;

/// Least number of modes for threads in a solution.
constexpr Index fields_for_threads = 5000;

/// Relative increase of the diagonal, so that singular blocks have a factor.
constexpr double raise = 1e-13;

constexpr auto no_factor = "the block of a box has no factor";

MatrixXd with_raised_diagonal(MatrixXd block) {
  for (Eigen::Index k = 0; k < block.rows(); ++k) {
    block(k, k) = block(k, k) > 0.0 ? (1.0 + raise) * block(k, k) : 1.0;
  }
  return block;
}

SubdomainModes fields_of(const MatrixXd& columns) {
  return {static_cast<std::size_t>(columns.cols()),
          {columns.data(), static_cast<std::size_t>(columns.size())}};
}

}  // namespace

bool SubdomainMatrix::has(Index a, Index b) const {
  return std::ranges::binary_search(pairs, std::pair(std::min(a, b), std::max(a, b)));
}

MatrixXd& SubdomainMatrix::block(Index a, Index b) {
  return const_cast<MatrixXd&>(std::as_const(*this).block(a, b));
}

const MatrixXd& SubdomainMatrix::block(Index a, Index b) const {
  const auto found = std::ranges::lower_bound(pairs, std::pair(std::min(a, b), std::max(a, b)));
  return blocks[static_cast<std::size_t>(found - pairs.begin())];
}

void CoarseSystem::factorize(const SubdomainMatrix& matrix, const SubdomainMatrix& inside) {
  first_ = matrix.first;
  if (!is_nested(matrix.num_subdomains())) return factorize_directly(matrix);
  if (fields_.empty()) find_fields(matrix, inside);
  roots_.resize(static_cast<std::size_t>(matrix.num_subdomains()));
  const int threads = prepare_blas(omp_get_max_threads());
  for_each_side_by_side(matrix.num_subdomains(), threads, [&](Index box) {
    const MatrixXd own = with_raised_diagonal(matrix.block(box, box));
    const Eigen::LLT<MatrixXd> factor(own);
    if (factor.info() != Eigen::Success) throw SolverError(no_factor);
    const MatrixXd lower = factor.matrixL().solve(MatrixXd::Identity(own.rows(), own.cols()));
    roots_[box] = fields_of(lower.transpose());
  });
  if (first_large_.back() > 0) factorize_directly(of_large_boxes(matrix));
}

void CoarseSystem::find_fields(const SubdomainMatrix& matrix, const SubdomainMatrix& inside) {
  const Index large = large_box(matrix.num_subdomains() - 1) + 1;
  fields_.resize(static_cast<std::size_t>(large));
  for_each_side_by_side(large, prepare_blas(omp_get_max_threads()),
                        [&](Index g) { fields_[g] = near_null_modes(g, matrix, inside); });
  first_large_.assign(1, 0);
  for (const SubdomainModes& fields : fields_) {
    first_large_.push_back(first_large_.back() + static_cast<Index>(fields.count()));
  }
}

/// Returns near-null-space modes of an aggregate, as CoarseSpace::near_null_modes() does for
/// points.
SubdomainModes CoarseSystem::near_null_modes(Index large, const SubdomainMatrix& matrix,
                                             const SubdomainMatrix& inside) {
  const Index begin = large * boxes_of_large;
  const Index end = std::min(matrix.num_subdomains(), begin + boxes_of_large);
  const auto place = [&](Index box) { return matrix.first[box] - matrix.first[begin]; };
  MatrixXd local = MatrixXd::Zero(place(end), place(end));
  std::vector<Eigen::LLT<MatrixXd>> own;
  for (Index b = begin; b < end; ++b) {
    own.emplace_back(with_raised_diagonal(matrix.block(b, b)));
    if (own.back().info() != Eigen::Success) throw SolverError(no_factor);
    for (Index a = begin; a <= b; ++a) {
      if (!matrix.has(a, b)) continue;
      const MatrixXd& block = inside.block(a, b);
      local.block(place(b), place(a), block.rows(), block.cols()) = block;
      local.block(place(a), place(b), block.cols(), block.rows()) = block.transpose();
    }
  }
  for (Index b = begin; b < end; ++b) {
    auto rows = local.middleRows(place(b), matrix.size(b));
    own[b - begin].matrixL().solveInPlace(rows);
  }
  for (Index b = begin; b < end; ++b) {
    auto columns = local.middleCols(place(b), matrix.size(b));
    own[b - begin].matrixU().solveInPlace<Eigen::OnTheRight>(columns);
  }
  MatrixXd fields = eigenvectors_below(local, soft_in_large, expected_in_large);
  for (Index b = begin; b < end; ++b) {
    auto rows = fields.middleRows(place(b), matrix.size(b));
    own[b - begin].matrixU().solveInPlace(rows);
  }
  return fields_of(fields);
}

/// Returns P2' A P2.
SubdomainMatrix CoarseSystem::of_large_boxes(const SubdomainMatrix& matrix) const {
  SubdomainMatrix large{first_large_, {}, {}};
  for (const auto& [a, b] : matrix.pairs) large.pairs.emplace_back(large_box(a), large_box(b));
  std::ranges::sort(large.pairs);
  large.pairs.erase(std::unique(large.pairs.begin(), large.pairs.end()), large.pairs.end());
  for (const auto& [a, b] : large.pairs) {
    large.blocks.push_back(MatrixXd::Zero(large.size(b), large.size(a)));
  }
  std::vector<std::vector<double>> fields;
  for (const SubdomainModes& of : fields_) fields.push_back(of.values());
  const auto rows_of = [&](Index box) {  // rows of a subdomain, transposed
    const Index g = large_box(box), count = large.size(g);
    const std::size_t start =
        static_cast<std::size_t>(matrix.first[box] - matrix.first[g * boxes_of_large]);
    return Eigen::Map<const MatrixXd>(fields[g].data() + start * static_cast<std::size_t>(count),
                                      count, matrix.size(box));
  };
  for (std::size_t n = 0; n < matrix.pairs.size(); ++n) {
    const auto [a, b] = matrix.pairs[n];
    const MatrixXd left = rows_of(b), right = rows_of(a);
    MatrixXd half = MatrixXd::Zero(right.rows(), left.cols());
    add_product(right, matrix.blocks[n], half);
    MatrixXd& sum = large.block(large_box(a), large_box(b));
    add_product(left, half, sum);
    if (a != b && large_box(a) == large_box(b)) add_product(half, left, sum);
  }
  return large;
}

void CoarseSystem::factorize_directly(const SubdomainMatrix& matrix) {
  const Index unknowns = matrix.first.back();
  SparseMatrix coarse(unknowns, unknowns);
  Index size = 0;
  for (const MatrixXd& block : matrix.blocks) size += static_cast<Index>(block.size());
  coarse.resizeNonZeros(size);
  std::vector<Index> group;
  Index next = 0;
  for (std::size_t first = 0, last; first < matrix.pairs.size(); first = last) {
    const Index box = matrix.pairs[first].first;
    for (last = first; last < matrix.pairs.size() && matrix.pairs[last].first == box;) ++last;
    for (Eigen::Index c = 0; c < matrix.size(box); ++c) {
      coarse.outerIndexPtr()[group.size()] = next;
      group.push_back(box);
      for (std::size_t n = first; n < last; ++n) {
        const MatrixXd& block = matrix.blocks[n];
        for (Eigen::Index r = n == first ? c : 0; r < block.rows(); ++r, ++next) {
          double value = block(r, c);
          if (n == first && r == c) value = value > 0.0 ? (1.0 + raise) * value : 1.0;
          coarse.innerIndexPtr()[next] =
              matrix.first[matrix.pairs[n].second] + static_cast<Index>(r);
          coarse.valuePtr()[next] = value;
        }
      }
    }
  }
  coarse.outerIndexPtr()[unknowns] = next;
  coarse.resizeNonZeros(next);
  if (factor_ && pairs_ == matrix.pairs) return factor_->refactorize(coarse);
  pairs_ = matrix.pairs;
  factor_ = make_factor(FactorRoute::in_place, 1);  // one thread: synchronisation would take longer
  factor_->factorize(coarse, group);
}

void CoarseSystem::solve(std::span<double> values) const {
  if (fields_.empty()) return factor_->solve(values, values);
  const Index boxes = static_cast<Index>(roots_.size());
  const Index large = static_cast<Index>(fields_.size());
  const std::vector<double> right(values.begin(), values.end());
  std::vector<double> sums(static_cast<std::size_t>(first_large_.back()), 0.0);
  const auto begin_of = [&](Index g) { return first_[std::min(boxes, g * boxes_of_large)]; };
#pragma omp parallel for schedule(static) if (first_.back() > fields_for_threads)
  for (Index g = 0; g < large; ++g) {
    fields_[g].add_sums(0, {right.data() + begin_of(g), right.data() + begin_of(g + 1)},
                        sums.data() + first_large_[g]);
  }
  if (!sums.empty()) factor_->solve(sums, sums);
  std::ranges::fill(values, 0.0);
#pragma omp parallel for schedule(static) if (first_.back() > fields_for_threads)
  for (Index g = 0; g < large; ++g) {
    for (Index b = g * boxes_of_large; b < std::min(boxes, (g + 1) * boxes_of_large); ++b) {
      std::vector<double> local(roots_[b].count(), 0.0);
      roots_[b].add_sums(0, {right.data() + first_[b], right.data() + first_[b + 1]}, local.data());
      roots_[b].add_fields(local, values.data() + first_[b]);
    }
    fields_[g].add_fields({sums.data() + first_large_[g], sums.data() + first_large_[g + 1]},
                          values.data() + begin_of(g));
  }
}

}  // namespace perilink

#include "solver/preconditioner_factor.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <numeric>
#include <optional>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/thread_choice.hpp"
#include "solver/cholmod_support.hpp"
#include "solver/supernodes/supernodal_cholesky.hpp"
#include "solver/supernodes/supernodal_kernels.hpp"
#include "solver/supernodes/supernodes.hpp"

namespace perilink {
namespace {

/// Numbers per allocation; blocks of this size fit into freed memory.
constexpr std::size_t piece = std::size_t{1} << 18;
/// Wider supernodes are split, because half of their triangle would be unused.
constexpr Index widest = 512;
/// Numbers of a factor from which several threads solve. Subtrees have at most the second part of
/// the numbers. Subtrees of one share have together the third part or slightly more.
constexpr double enough_for_threads = 2e6, most_of_subtree = 0.4, least_together = 0.2;

std::vector<Index> one_each(const SparseMatrix& graph) {
  std::vector<Index> each(static_cast<std::size_t>(graph.cols()));
  std::iota(each.begin(), each.end(), 0);
  return each;
}

}  // namespace

struct PreconditionerFactor::Parts {
  /// Pattern of supernodes of rows, derived from supernodes of points.
  struct Pattern {
    /// \param sizes  rows of each point
    Pattern(const cholmod_factor& points, std::span<const Index> sizes);

    cholmod_factor view{};  // pattern as a CHOLMOD factor; it points to the arrays below
    std::vector<Index> first_column{0}, first_row{0}, rows;
    double flops = 0.0;
  };

  /// Subtrees that one thread solves together.
  struct Share {
    std::vector<std::pair<Index, Index>> subtrees;  // [first, last] supernodes
    std::vector<double> above;                      // their sums for rows above them, size n
  };

  Parts(const SparseMatrix& graph, std::span<const Index> sizes, int most_threads);

  Supernode<float> block(Index s) const { return supernode_of(pattern->view, values[s], s); }
  void take_memory();
  void share_subtrees();
  void eliminate(Index s, double* side, double* above, Index end, double* rows) const;
  void substitute(Index s, double* side, double* rows) const;
  template <class Visit>
  void for_each_share(int most, Visit visit);
  void solve(std::span<double> side, int most);

  int threads;
  std::vector<Index> order;
  std::optional<Pattern> pattern;
  Index count = 0;  // supernodes
  std::vector<std::unique_ptr<float[]>> memory;
  std::vector<float*> values;              // per supernode
  std::vector<double> pivots;              // one over D
  std::vector<Share> shares;               // independent of the number of threads
  std::vector<Index> top;                  // supernodes above the subtrees, descending
  std::vector<std::vector<double>> local;  // per thread: rows of a supernode
  ThreadChoice choice;                     // for solutions
};

PreconditionerFactor::Parts::Pattern::Pattern(const cholmod_factor& points,
                                              std::span<const Index> sizes) {
  const Index* order = static_cast<const Index*>(points.Perm);
  std::vector<Index> first{0};  // first row of each point in the order of elimination
  for (std::size_t p = 0; p < points.n; ++p) first.push_back(first.back() + sizes[order[p]]);
  std::vector<Index> own;
  for (Index s = 0; s < static_cast<Index>(points.nsuper); ++s) {
    const auto node = supernode_of(points, s);
    own.clear();
    for (Index k = 0; k < node.count; ++k) {
      for (Index r = first[node.rows[k]]; r < first[node.rows[k] + 1]; ++r) own.push_back(r);
    }
    const Index end = first[node.first + node.columns];
    for (Index begin = first[node.first]; begin < end; begin = first_column.back()) {
      const Index parts = (end - begin + widest - 1) / widest;
      const Index columns = (end - begin + parts - 1) / parts;
      const Index count = static_cast<Index>(own.size()) - (begin - first[node.first]);
      for (Index c = 0; c < columns; ++c) flops += std::pow(count - c, 2);
      rows.insert(rows.end(), own.end() - count, own.end());
      view.xsize += static_cast<std::size_t>(count) * columns;
      first_column.push_back(begin + columns);
      first_row.push_back(static_cast<Index>(rows.size()));
    }
  }
  view.n = static_cast<std::size_t>(first.back());
  view.is_super = 1;
  view.nsuper = first_column.size() - 1;
  view.ssize = rows.size();
  view.super = first_column.data();
  view.pi = first_row.data();
  view.s = rows.data();
}

PreconditionerFactor::Parts::Parts(const SparseMatrix& graph, std::span<const Index> sizes,
                                   int most_threads)
    : threads(most_threads), choice(most_threads) {
  CholmodSession session;
  // CHOLMOD's limits for merging supernodes count columns; here columns are points.
  const double mean = static_cast<double>(std::accumulate(sizes.begin(), sizes.end(), Index{0})) /
                      static_cast<double>(std::max<std::size_t>(sizes.size(), 1));
  for (std::size_t& most : session.get()->nrelax) {
    most = static_cast<std::size_t>(static_cast<double>(most) / std::max(mean, 1.0));
  }
  const CholmodFactorPtr points = analyze_supernodal(session, graph, one_each(graph));
  const Index* perm = static_cast<const Index*>(points->Perm);
  order.assign(perm, perm + points->n);
  pattern.emplace(*points, sizes);
  count = static_cast<Index>(pattern->view.nsuper);
  pivots.resize(pattern->view.n);
  take_memory();
  share_subtrees();
}

void PreconditionerFactor::Parts::take_memory() {
  std::size_t longest = 0, size = 0;
  std::vector<std::size_t> places;  // offsets of the supernodes in the next block of memory
  for (Index s = 0; s < count; ++s) {
    const auto node = supernode_of<float>(pattern->view, nullptr, s);
    longest = std::max(longest, static_cast<std::size_t>(node.count));
    places.push_back(size);
    size += static_cast<std::size_t>(node.count) * static_cast<std::size_t>(node.columns);
    if (size < piece && s + 1 < count) continue;
    memory.push_back(std::make_unique_for_overwrite<float[]>(size));
    for (const std::size_t place : places) values.push_back(memory.back().get() + place);
    places.clear();
    size = 0;
  }
  local.assign(static_cast<std::size_t>(threads), std::vector<double>(longest));
}

void PreconditionerFactor::Parts::share_subtrees() {
  std::vector<double> numbers;
  for (Index s = 0; s < count; ++s) {
    const auto node = supernode_of<float>(pattern->view, nullptr, s);
    numbers.push_back(static_cast<double>(node.count) * node.columns);
  }
  const double all = static_cast<double>(pattern->view.xsize);
  const bool parted = all > enough_for_threads;
  SupernodeTree::Cut cut =
      SupernodeTree(pattern->view).cut(numbers, (parted ? most_of_subtree : 1.0) * all);
  top = std::move(cut.top);
  const double enough = (parted ? least_together : 1.0) * all;
  double together = enough;  // numbers in the last share
  for (const auto& [first, last] : cut.subtrees) {
    if (together >= enough) {
      shares.push_back({{}, std::vector<double>(pattern->view.n)});
      together = 0.0;
    }
    shares.back().subtrees.emplace_back(first, last);
    together = std::accumulate(numbers.begin() + first, numbers.begin() + last + 1, together);
  }
}

/// Eliminates forward with a supernode; rows from `end` on are in `above_side`.
void PreconditionerFactor::Parts::eliminate(Index s, double* side, double* above_side, Index end,
                                            double* rows) const {
  const Supernode<float> node = block(s);
  std::copy_n(side + node.first, node.columns, rows);
  const auto at = [&](Index r) -> double& {
    return node.rows[r] < end ? side[node.rows[r]] : above_side[node.rows[r]];
  };
  for (Index r = node.columns; r < node.count; ++r) rows[r] = at(r);
  supernodal::forward(node.values, node.count, node.columns, 0, rows);
  std::copy_n(rows, node.columns, side + node.first);
  for (Index r = node.columns; r < node.count; ++r) at(r) = rows[r];
}

/// Substitutes backward with a supernode.
void PreconditionerFactor::Parts::substitute(Index s, double* side, double* rows) const {
  const Supernode<float> node = block(s);
  std::copy_n(side + node.first, node.columns, rows);
  for (Index r = node.columns; r < node.count; ++r) rows[r] = side[node.rows[r]];
  supernodal::backward(node.values, node.count, node.columns, rows);
  std::copy_n(rows, node.columns, side + node.first);
}

/// Calls visit(share, buffer for rows) in up to `most` threads.
template <class Visit>
void PreconditionerFactor::Parts::for_each_share(int most, Visit visit) {
#pragma omp parallel for schedule(dynamic, 1) num_threads(most) if (shares.size() > 1)
  for (std::size_t t = 0; t < shares.size(); ++t) {
    visit(shares[t], local[static_cast<std::size_t>(omp_get_thread_num())].data());
  }
}

PreconditionerFactor::PreconditionerFactor(const SparseMatrix& graph, std::span<const Index> sizes,
                                           int threads) try
    : parts_(std::make_unique<Parts>(graph, sizes, threads)) {
} catch (const std::bad_alloc&) {
  throw SolverError("out of memory for the factor of a preconditioner of " +
                    std::to_string(graph.cols()) + " points");
}

PreconditionerFactor::~PreconditionerFactor() = default;

std::span<const Index> PreconditionerFactor::order() const { return parts_->order; }

bool PreconditionerFactor::factorize(const AddColumn& add) {
  const Index failed =
      factorize_supernodes<float>(add, parts_->pattern->view, parts_->values, parts_->threads);
  if (failed < static_cast<Index>(parts_->pattern->view.n)) return false;
  turn_into_ldl();
  return std::ranges::all_of(parts_->pivots, [](double p) { return p > 0.0 && std::isfinite(p); });
}

void PreconditionerFactor::turn_into_ldl() {
#pragma omp parallel for schedule(dynamic, 16) num_threads(parts_->threads)
  for (Index s = 0; s < parts_->count; ++s) {
    const Supernode<float> node = parts_->block(s);
    for (Index j = 0; j < node.columns; ++j) {
      float* column = node.column(j);
      const float inverse = 1.0F / column[j];
      parts_->pivots[node.first + j] = static_cast<double>(inverse) * inverse;
      for (Index r = j + 1; r < node.count; ++r) column[r] *= inverse;
    }
  }
}

void PreconditionerFactor::solve(std::span<double> side) {
  if (parts_->shares.size() < 2) return parts_->solve(side, 1);
  parts_->choice.run([&](int threads) { parts_->solve(side, threads); });
}

void PreconditionerFactor::Parts::solve(std::span<double> side, int most) {
  for_each_share(most, [&](Share& share, double* rows) {
    std::ranges::fill(share.above, 0.0);
    for (const auto& [first, last] : share.subtrees) {
      const Index end = pattern->first_column[last + 1];
      for (Index s = first; s <= last; ++s) {
        eliminate(s, side.data(), share.above.data(), end, rows);
      }
    }
  });
  for (const Share& share : shares) {
    for (std::size_t row = 0; row < side.size(); ++row) side[row] += share.above[row];
  }
  double* rows = local.front().data();
  for (const Index s : top | std::views::reverse) {
    eliminate(s, side.data(), nullptr, static_cast<Index>(side.size()), rows);
  }
  for (std::size_t k = 0; k < side.size(); ++k) side[k] *= pivots[k];
  for (const Index s : top) substitute(s, side.data(), rows);
  for_each_share(most, [&](Share& share, double* own) {
    for (const auto& [first, last] : share.subtrees) {
      for (Index s = last; s >= first; --s) substitute(s, side.data(), own);
    }
  });
}

FactorStatistics PreconditionerFactor::statistics() const {
  const Parts::Pattern& pattern = *parts_->pattern;
  FactorStatistics result = measure_factor(pattern.view, pattern.flops);
  result.bytes = 4.0 * (result.entries + static_cast<double>(pattern.view.ssize));
  return result;
}

}  // namespace perilink

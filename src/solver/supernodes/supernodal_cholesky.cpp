#include "solver/supernodes/supernodal_cholesky.hpp"

#include <omp.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "solver/dense/dense_kernels.hpp"
#include "solver/dense/lapack.hpp"
#include "solver/supernodes/supernodes.hpp"

namespace perilink {
namespace {

/// Rows of a supernode that are worked on together, and columns: enough for BLAS to be fast, few
/// enough for threads to share.
constexpr Index tile_rows = 256, panel_columns = 128;
/// Operations below which starting threads costs more than it saves.
constexpr double least_shared = 1e7;
constexpr double one = 1.0, minus_one = -1.0, zero = 0.0;

/// Rows [first, last) of a supernode pull at the columns of a later one, and all from `first` on at
/// its rows.
struct Pull {
  Index source, first, last;
};

/// What a thread needs for itself.
struct Workspace {
  std::vector<Index> place;  ///< per row of the matrix: its own number in the supernode at hand
  std::unique_ptr<double[]> product;  ///< shape (tile_rows, widest supernode)
};

class Factorization {
 public:
  Factorization(const SparseMatrix& lower, cholmod_factor& factor, int threads);
  Index run();

 private:
  Supernode supernode(Index s) const { return supernode_of(factor_, s); }
  void find_pulls();
  double operations(Index s) const;
  Index compute(Index s, int thread, int threads);
  void place_matrix(const Supernode& node, Index column, const std::vector<Index>& place) const;
  void pull(const Supernode& node, const Pull& pull, Index begin, Index end,
            const std::vector<Index>& place, double* product) const;
  Index factorize_columns(const Supernode& node, int threads) const;
  template <class Visit>
  static void share(Index count, int threads, Visit visit);

  const SparseMatrix& lower_;
  cholmod_factor& factor_;
  int threads_ = 1;
  Index count_, widest_ = 0;
  SupernodeTree tree_;
  SupernodeTree::Cut cut_;
  std::vector<Index> begin_;  ///< per supernode: its first pull
  std::vector<Pull> pulls_;
  std::vector<Workspace> workspaces_;  ///< per thread
};

Factorization::Factorization(const SparseMatrix& lower, cholmod_factor& factor, int threads)
    : lower_(lower), factor_(factor), count_(static_cast<Index>(factor.nsuper)), tree_(factor) {
  find_pulls();
  std::vector<double> work;
  for (Index s = 0; s < count_; ++s) work.push_back(operations(s));
  const double total = std::accumulate(work.begin(), work.end(), 0.0);
  threads_ = threads > 1 && total > least_shared ? prepare_blas(threads) : 1;
  cut_ = tree_.cut(std::move(work), threads_ > 1 ? total / (8.0 * threads_) : total);
  workspaces_.resize(static_cast<std::size_t>(threads_));
  for (Workspace& own : workspaces_) {
    own.place.resize(factor_.n);
    own.product =
        std::make_unique_for_overwrite<double[]>(static_cast<std::size_t>(widest_) * tile_rows);
  }
}

/// Pulls in the order of their sources.
void Factorization::find_pulls() {
  const auto for_each_target = [&](Index s, auto visit) {
    const Supernode node = supernode(s);
    for (Index first = node.columns, last = first; first < node.count; first = last) {
      const Index target = tree_.of_column[node.rows[first]];
      while (last < node.count && tree_.of_column[node.rows[last]] == target) ++last;
      visit(target, Pull{s, first, last});
    }
  };
  begin_.assign(static_cast<std::size_t>(count_) + 1, 0);
  for (Index s = 0; s < count_; ++s) {
    for_each_target(s, [&](Index target, const Pull&) { ++begin_[target + 1]; });
    widest_ = std::max(widest_, supernode(s).columns);
  }
  for (Index s = 0; s < count_; ++s) begin_[s + 1] += begin_[s];
  pulls_.resize(static_cast<std::size_t>(begin_.back()));
  std::vector<Index> next(begin_.begin(), begin_.end() - 1);
  for (Index s = 0; s < count_; ++s) {
    for_each_target(s, [&](Index target, const Pull& pull) { pulls_[next[target]++] = pull; });
  }
}

/// What its columns and those that pull at them take.
double Factorization::operations(Index s) const {
  const Supernode node = supernode(s);
  const auto product = [](double m, double n, double k) { return 2.0 * m * n * k; };
  double sum = product(node.count, node.columns, node.columns);
  for (Index k = begin_[s]; k < begin_[s + 1]; ++k) {
    const Supernode source = supernode(pulls_[k].source);
    sum +=
        product(source.count - pulls_[k].first, pulls_[k].last - pulls_[k].first, source.columns);
  }
  return sum;
}

template <class Visit>
void Factorization::share(Index count, int threads, Visit visit) {
  if (threads == 1) {
    for (Index k = 0; k < count; ++k) visit(k);
    return;
  }
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (Index k = 0; k < count; ++k) visit(k);
}

Index Factorization::run() {
  const Index size = static_cast<Index>(factor_.n);
  Index failed = size;
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads_) reduction(min : failed)
  for (std::size_t t = 0; t < cut_.subtrees.size(); ++t) {
    const auto [first, last] = cut_.subtrees[t];
    Index column = size;
    for (Index s = first; s <= last && column == size; ++s) {
      column = compute(s, omp_get_thread_num(), 1);
    }
    failed = std::min(failed, column);
  }
  for (auto s = cut_.top.rbegin(); s != cut_.top.rend() && failed == size; ++s) {
    failed = compute(*s, 0, operations(*s) < least_shared ? 1 : threads_);
  }
  return failed;
}

/// \param thread   that calls
/// \param threads  that share the work, from the first one on
/// \return the column at which the matrix is not positive definite; n where it is
Index Factorization::compute(Index s, int thread, int threads) {
  const Supernode node = supernode(s);
  std::vector<Index>& place = workspaces_[thread].place;
  for (Index r = 0; r < node.count; ++r) place[node.rows[r]] = r;
  share(node.columns, threads, [&](Index column) { place_matrix(node, column, place); });
  if (begin_[s] < begin_[s + 1]) {
    share((node.count + tile_rows - 1) / tile_rows, threads, [&](Index tile) {
      const int worker = threads > 1 ? omp_get_thread_num() : thread;
      const Index begin = tile * tile_rows, end = std::min(begin + tile_rows, node.count);
      for (Index k = begin_[s]; k < begin_[s + 1]; ++k) {
        pull(node, pulls_[k], begin, end, place, workspaces_[worker].product.get());
      }
    });
  }
  return factorize_columns(node, threads);
}

/// The numbers of the matrix, zeros between them.
void Factorization::place_matrix(const Supernode& node, Index column,
                                 const std::vector<Index>& place) const {
  double* values = node.column(column);
  std::fill_n(values, node.count, 0.0);
  for (SparseMatrix::InnerIterator entry(lower_, node.first + column); entry; ++entry) {
    values[place[entry.row()]] = entry.value();
  }
}

/// Takes what a source pulls with from rows [begin, end) of a supernode. What is above the diagonal
/// is never read.
void Factorization::pull(const Supernode& node, const Pull& pull, Index begin, Index end,
                         const std::vector<Index>& place, double* product) const {
  const Supernode source = supernode(pull.source);
  const auto number_of = [&](Index own) {
    if (own == node.count) return source.count;
    const Index* rows =
        std::lower_bound(source.rows + pull.first, source.rows + source.count, node.rows[own]);
    return static_cast<Index>(rows - source.rows);
  };
  const Index from = begin == 0 ? pull.first : number_of(begin), to = number_of(end);
  const Index m = to - from, n = std::min(pull.last, to) - pull.first;
  if (m <= 0) return;
  const auto place_of = [&](Index k) { return place[source.rows[k]]; };
  const double* rows = source.values + from;
  const double* columns = source.values + pull.first;
  double* target = node.column(place_of(pull.first)) + place_of(from);
  if (place_of(to - 1) - place_of(from) == m - 1 &&
      place_of(pull.first + n - 1) - place_of(pull.first) == n - 1) {
    dgemm_("N", "T", &m, &n, &source.columns, &minus_one, rows, &source.count, columns,
           &source.count, &one, target, &node.count);
    return;
  }
  dgemm_("N", "T", &m, &n, &source.columns, &one, rows, &source.count, columns, &source.count,
         &zero, product, &m);
  for (Index c = 0; c < n; ++c, product += m) {
    double* values = node.column(place_of(pull.first + c));
    for (Index r = std::max(from, pull.first + c); r < to; ++r) {
      values[place_of(r)] -= product[r - from];
    }
  }
}

/// The supernode as a dense matrix, panel after panel.
Index Factorization::factorize_columns(const Supernode& node, int threads) const {
  for (Index begin = 0; begin < node.columns; begin += panel_columns) {
    const Index n = std::min(panel_columns, node.columns - begin), below = begin + n;
    double* panel = node.column(begin);
    double* diagonal = panel + begin;
    if (begin > 0) {
      dsyrk_("L", "N", &n, &begin, &minus_one, node.values + begin, &node.count, &one, diagonal,
             &node.count);
    }
    int info = 0;
    dpotrf_("L", &n, diagonal, &node.count, &info);
    if (info != 0) return node.first + begin + info - 1;
    share((node.count - below + tile_rows - 1) / tile_rows, threads, [&](Index tile) {
      const Index row = below + tile * tile_rows, m = std::min(tile_rows, node.count - row);
      if (begin > 0) {
        dgemm_("N", "T", &m, &n, &begin, &minus_one, node.values + row, &node.count,
               node.values + begin, &node.count, &one, panel + row, &node.count);
      }
      dtrsm_("R", "L", "T", "N", &m, &n, &one, diagonal, &node.count, panel + row, &node.count);
    });
  }
  return static_cast<Index>(factor_.n);
}

}  // namespace

Index factorize_supernodes(const SparseMatrix& lower, cholmod_factor& factor, int threads) {
  return Factorization(lower, factor, threads).run();
}

}  // namespace perilink

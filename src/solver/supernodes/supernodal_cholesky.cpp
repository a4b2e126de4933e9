#include "solver/supernodes/supernodal_cholesky.hpp"

#include <omp.h>

#include <algorithm>
#include <memory>
#include <new>
#include <numeric>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "solver/dense/dense_kernels.hpp"
#include "solver/dense/lapack.hpp"
#include "solver/supernodes/supernodes.hpp"

namespace perilink {
namespace {

/// Rows and columns processed together: enough for fast BLAS, few enough to occupy all threads.
constexpr Index tile_rows = 512, panel_columns = 256;
/// Operations below which starting threads takes longer than it saves.
constexpr double least_shared = 1e7;

/// Contribution of a source supernode to a later one: rows [first, last) to its columns, all rows
/// from `first` on to its rows.
struct Pull {
  Index source, first, last;
};

/// Computes c = beta c + alpha a b', c of shape (m, n).
void multiply(int m, int n, int k, double alpha, const double* a, int lda, const double* b, int ldb,
              double beta, double* c, int ldc) {
  dgemm_("N", "T", &m, &n, &k, &alpha, a, &lda, b, &ldb, &beta, c, &ldc);
}
void multiply(int m, int n, int k, float alpha, const float* a, int lda, const float* b, int ldb,
              float beta, float* c, int ldc) {
  sgemm_("N", "T", &m, &n, &k, &alpha, a, &lda, b, &ldb, &beta, c, &ldc);
}

/// Computes the lower triangle of c -= a a', a of shape (n, k), with one leading dimension.
void subtract_square(int n, int k, const double* a, double* c, int rows) {
  const double minus_one = -1.0, one = 1.0;
  dsyrk_("L", "N", &n, &k, &minus_one, a, &rows, &one, c, &rows);
}
void subtract_square(int n, int k, const float* a, float* c, int rows) {
  const float minus_one = -1.0F, one = 1.0F;
  ssyrk_("L", "N", &n, &k, &minus_one, a, &rows, &one, c, &rows);
}

/// Factorises a diagonal block. \return its first failing column, from 1; 0: success
int factorize_dense(int n, double* a, int rows) {
  int info = 0;
  dpotrf_("L", &n, a, &rows, &info);
  return info;
}
int factorize_dense(int n, float* a, int rows) {
  int info = 0;
  spotrf_("L", &n, a, &rows, &info);
  return info;
}

/// Computes b = b a^-T; a is the factor of a diagonal block, b of shape (m, n) lies below it.
void divide(int m, int n, const double* a, double* b, int rows) {
  const double one = 1.0;
  dtrsm_("R", "L", "T", "N", &m, &n, &one, a, &rows, b, &rows);
}
void divide(int m, int n, const float* a, float* b, int rows) {
  const float one = 1.0F;
  strsm_("R", "L", "T", "N", &m, &n, &one, a, &rows, b, &rows);
}

template <class Number>
class Factorization {
 public:
  Factorization(const AddColumn& add, const cholmod_factor& factor, std::span<Number* const> values,
                int threads);
  Index run();

 private:
  using Node = Supernode<Number>;
  /// Memory of one thread.
  struct Workspace {
    std::vector<Index> place;           ///< per row of the matrix: number in the current supernode
    std::unique_ptr<Number[]> product;  ///< shape (tile_rows, widest supernode)
    std::vector<double> column;         ///< a column in double precision if the factor is in single
                                        ///< precision
  };
  Node supernode(Index s) const { return supernode_of(factor_, values_[s], s); }
  void find_pulls();
  double operations(Index s) const;
  Index compute(Index s, int thread, int threads);
  void place_matrix(const Node& node, Index column, std::span<const Index> place,
                    std::span<double> exact) const;
  void pull(const Node& node, const Pull& pull, Index begin, Index end,
            const std::vector<Index>& place, Number* product) const;
  Index factorize_columns(const Node& node, int threads) const;
  template <class Visit>
  static void share(Index count, int threads, Visit visit);

  const AddColumn& add_;
  const cholmod_factor& factor_;
  std::span<Number* const> values_;
  int threads_ = 1;
  Index count_, widest_ = 0, longest_ = 0;
  SupernodeTree tree_;
  SupernodeTree::Cut cut_;
  std::vector<Index> begin_;  ///< per supernode: its first pull
  std::vector<Pull> pulls_;
  std::vector<Workspace> workspaces_;  ///< per thread
};

template <class Number>
Factorization<Number>::Factorization(const AddColumn& add, const cholmod_factor& factor,
                                     std::span<Number* const> values, int threads)
    : add_(add),
      factor_(factor),
      values_(values),
      count_(static_cast<Index>(factor.nsuper)),
      tree_(factor) {
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
        std::make_unique_for_overwrite<Number[]>(static_cast<std::size_t>(widest_) * tile_rows);
    if (!std::is_same_v<Number, double>) own.column.resize(static_cast<std::size_t>(longest_));
  }
}

/// Finds the contributions to every supernode, in the order of their sources.
template <class Number>
void Factorization<Number>::find_pulls() {
  const auto for_each_target = [&](Index s, auto visit) {
    const Node node = supernode(s);
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
    longest_ = std::max(longest_, supernode(s).count);
  }
  for (Index s = 0; s < count_; ++s) begin_[s + 1] += begin_[s];
  pulls_.resize(static_cast<std::size_t>(begin_.back()));
  std::vector<Index> next(begin_.begin(), begin_.end() - 1);
  for (Index s = 0; s < count_; ++s) {
    for_each_target(s, [&](Index target, const Pull& pull) { pulls_[next[target]++] = pull; });
  }
}

/// Returns operations for a supernode's columns and the contributions to them.
template <class Number>
double Factorization<Number>::operations(Index s) const {
  const Node node = supernode(s);
  const auto product = [](double m, double n, double k) { return 2.0 * m * n * k; };
  double sum = product(node.count, node.columns, node.columns);
  for (Index k = begin_[s]; k < begin_[s + 1]; ++k) {
    const Node source = supernode(pulls_[k].source);
    sum +=
        product(source.count - pulls_[k].first, pulls_[k].last - pulls_[k].first, source.columns);
  }
  return sum;
}

template <class Number>
template <class Visit>
void Factorization<Number>::share(Index count, int threads, Visit visit) {
  if (threads == 1) {
    for (Index k = 0; k < count; ++k) visit(k);
    return;
  }
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (Index k = 0; k < count; ++k) visit(k);
}

template <class Number>
Index Factorization<Number>::run() {
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
  // After a failure only supernodes before the failed column are complete; they may fail too.
  for (auto s = cut_.top.rbegin(); s != cut_.top.rend(); ++s) {
    if (supernode(*s).first >= failed) break;
    failed = std::min(failed, compute(*s, 0, operations(*s) < least_shared ? 1 : threads_));
  }
  return failed;
}

/// \param thread   number of the calling thread
/// \param threads  threads that share the work, from the first one
/// \return column at which the matrix is not positive definite; n if it is
template <class Number>
Index Factorization<Number>::compute(Index s, int thread, int threads) {
  const Node node = supernode(s);
  std::vector<Index>& place = workspaces_[thread].place;
  for (Index r = 0; r < node.count; ++r) place[node.rows[r]] = r;
  const auto worker = [&] { return threads > 1 ? omp_get_thread_num() : thread; };
  share(node.columns, threads,
        [&](Index column) { place_matrix(node, column, place, workspaces_[worker()].column); });
  if (begin_[s] < begin_[s + 1]) {
    share((node.count + tile_rows - 1) / tile_rows, threads, [&](Index tile) {
      const Index begin = tile * tile_rows, end = std::min(begin + tile_rows, node.count);
      for (Index k = begin_[s]; k < begin_[s + 1]; ++k) {
        pull(node, pulls_[k], begin, end, place, workspaces_[worker()].product.get());
      }
    });
  }
  return factorize_columns(node, threads);
}

/// Stores a column of the matrix, with zeros between its numbers.
template <class Number>
void Factorization<Number>::place_matrix(const Node& node, Index column,
                                         std::span<const Index> place,
                                         std::span<double> exact) const {
  Number* values = node.column(column);
  const auto count = static_cast<std::size_t>(node.count);
  if constexpr (std::is_same_v<Number, double>) {
    std::fill_n(values, count, 0.0);
    add_(node.first + column, place, {values, count});
  } else {
    std::fill_n(exact.begin(), count, 0.0);
    add_(node.first + column, place, exact.first(count));
    std::ranges::transform(exact.first(count), values,
                           [](double x) { return static_cast<Number>(x); });
  }
}

/// Subtracts a source's contribution from rows [begin, end) of a supernode. Numbers above the
/// diagonal are never read.
template <class Number>
void Factorization<Number>::pull(const Node& node, const Pull& pull, Index begin, Index end,
                                 const std::vector<Index>& place, Number* product) const {
  const Node source = supernode(pull.source);
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
  const Number* rows = source.values + from;
  const Number* columns = source.values + pull.first;
  Number* target = node.column(place_of(pull.first)) + place_of(from);
  if (place_of(to - 1) - place_of(from) == m - 1 &&
      place_of(pull.first + n - 1) - place_of(pull.first) == n - 1) {
    multiply(m, n, source.columns, Number{-1}, rows, source.count, columns, source.count, Number{1},
             target, node.count);
    return;
  }
  multiply(m, n, source.columns, Number{1}, rows, source.count, columns, source.count, Number{0},
           product, m);
  for (Index c = 0; c < n; ++c, product += m) {
    Number* values = node.column(place_of(pull.first + c));
    for (Index r = std::max(from, pull.first + c); r < to; ++r) {
      values[place_of(r)] -= product[r - from];
    }
  }
}

/// Factorises the supernode as a dense matrix, one panel after another.
template <class Number>
Index Factorization<Number>::factorize_columns(const Node& node, int threads) const {
  for (Index begin = 0; begin < node.columns; begin += panel_columns) {
    const Index n = std::min(panel_columns, node.columns - begin), below = begin + n;
    Number* panel = node.column(begin);
    Number* diagonal = panel + begin;
    if (begin > 0) subtract_square(n, begin, node.values + begin, diagonal, node.count);
    const int failed = factorize_dense(n, diagonal, node.count);
    if (failed != 0) return node.first + begin + failed - 1;
    share((node.count - below + tile_rows - 1) / tile_rows, threads, [&](Index tile) {
      const Index row = below + tile * tile_rows, m = std::min(tile_rows, node.count - row);
      if (begin > 0) {
        multiply(m, n, begin, Number{-1}, node.values + row, node.count, node.values + begin,
                 node.count, Number{1}, panel + row, node.count);
      }
      divide(m, n, diagonal, panel + row, node.count);
    });
  }
  return static_cast<Index>(factor_.n);
}

}  // namespace

template <class Number>
Index factorize_supernodes(const AddColumn& add, const cholmod_factor& factor,
                           std::span<Number* const> values, int threads) {
  try {
    return Factorization<Number>(add, factor, values, threads).run();
  } catch (const std::bad_alloc&) {
    throw SolverError("out of memory while factorising a matrix of " + std::to_string(factor.n) +
                      " rows");
  }
}

template Index factorize_supernodes(const AddColumn&, const cholmod_factor&,
                                    std::span<double* const>, int);
template Index factorize_supernodes(const AddColumn&, const cholmod_factor&,
                                    std::span<float* const>, int);

}  // namespace perilink

#include "solver/in_place_factor.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/error.hpp"
#include "solver/supernodes/supernodal_kernels.hpp"

namespace perilink {
namespace {

/// Least numbers of L for which a parallel region saves time.
constexpr double smallest_parallel_factor = 2e6;

}  // namespace

InPlaceFactor::InPlaceFactor(int threads)
    : threads_(threads),
      solution_threads_(threads),
      column_threads_(threads),
      change_threads_(threads),
      factor_(nullptr, CholmodFactorDeleter{session_.get()}) {}

void InPlaceFactor::factorize(const SparseMatrix& matrix, std::span<const Index> groups) {
  size_ = static_cast<Index>(matrix.cols());
  factor_ = analyze_supernodal(session_, matrix, groups);
  flops_ = session_.get()->fl;
  adopt_pattern();
  refactorize(matrix);
}

void InPlaceFactor::refactorize(const SparseMatrix& matrix) {
  on_path_of_ = {};
  factorize_numerically(session_, matrix, factor_.get(), threads_);
  turn_into_ldl();
  ++factorizations_;
}

void InPlaceFactor::adopt_pattern() {
  const Index* order = static_cast<const Index*>(factor_->Perm);
  position_ = invert({order, static_cast<std::size_t>(size_)});
  tree_ = SupernodeTree(*factor_);
  longest_ = 0;
  std::vector<double> numbers;
  for (Index s = 0; s < num_supernodes(); ++s) {
    longest_ = std::max(longest_, block(s).count);
    numbers.push_back(static_cast<double>(block(s).count) * block(s).columns);
  }
  std::vector<double> to_root = numbers;
  for (std::size_t s = numbers.size(); s-- > 0;) {
    if (tree_.parent[s] != no_index) to_root[s] += to_root[tree_.parent[s]];
  }
  // Each supernode is computed in one way for any cut, so results do not depend on threads.
  const double total = std::accumulate(numbers.begin(), numbers.end(), 0.0);
  const bool parallel = threads_ > 1 && total > smallest_parallel_factor;
  cut_ = tree_.cut(std::move(numbers), parallel ? total / (4.0 * threads_) : 0.0);
  vector_.assign(size_, 0.0);
  p_.assign(size_, 0.0);
  beta_.assign(size_, 0.0);
  w_.assign(size_, 0.0);
  on_path_.assign(tree_.parent.size(), 0);
  path_.clear();  // remove the path of a former pattern
  wanted_.clear();
  local_.assign(static_cast<std::size_t>(longest_) * 2 * threads_, 0.0);
  together_.clear();
  at_supernode_.assign(tree_.parent.size(), 0);
  to_root_ = std::move(to_root);
}

/// Converts L L' to L D L': d_j = l_jj^2 on the diagonal; the column below is divided by l_jj.
void InPlaceFactor::turn_into_ldl() {
  const Index count = num_supernodes();
#pragma omp parallel for schedule(dynamic, 16) num_threads(threads_)
  for (Index s = 0; s < count; ++s) {
    const Supernode<double> b = block(s);
    for (Index j = 0; j < b.columns; ++j) {
      double* column = b.column(j);
      const double inverse = 1.0 / column[j];
      column[j] *= column[j];
#pragma omp simd
      for (Index r = j + 1; r < b.count; ++r) column[r] *= inverse;
    }
  }
}

void InPlaceFactor::forward_on(Index supernode, Index start, double* vector, double* local) const {
  const Supernode<double> b = block(supernode);
  std::copy_n(vector + b.first, b.columns, local);
  for (Index r = b.columns; r < b.count; ++r) local[r] = vector[b.rows[r]];
  supernodal::forward(b.values, b.count, b.columns, start, local);
  std::copy_n(local, b.columns, vector + b.first);
  for (Index r = b.columns; r < b.count; ++r) vector[b.rows[r]] = local[r];
}

void InPlaceFactor::backward_on(Index supernode, double* vector, double* local) const {
  const Supernode<double> b = block(supernode);
  std::copy_n(vector + b.first, b.columns, local);
  for (Index r = b.columns; r < b.count; ++r) local[r] = vector[b.rows[r]];
  supernodal::backward(b.values, b.count, b.columns, local);
  std::copy_n(local, b.columns, vector + b.first);
}

void InPlaceFactor::backward_and_change_on(Index supernode, double* vector, double* local) {
  const Supernode<double> b = block(supernode);
  double* w = local + longest_;
  std::copy_n(vector + b.first, b.columns, local);
  std::copy_n(w_.data() + b.first, b.columns, w);
  for (Index r = b.columns; r < b.count; ++r) {
    local[r] = vector[b.rows[r]];
    w[r] = w_[b.rows[r]];
  }
  supernodal::backward_and_change(b.values, b.count, b.columns, p_.data() + b.first,
                                  beta_.data() + b.first, local, w);
  std::copy_n(local, b.columns, vector + b.first);
  for (Index r = 0; r < b.count; ++r) w_[b.rows[r]] = w[r];
}

template <typename Function>
void InPlaceFactor::descend(ThreadChoice& choice, const Function& on_supernode) {
  for (const Index s : cut_.top) on_supernode(s, local_.data());
  const Index count = static_cast<Index>(cut_.subtrees.size());
  if (count == 0) return;
  choice.run([&](int threads) {
#pragma omp parallel num_threads(threads)
    {
      double* local = local_.data() + static_cast<std::size_t>(omp_get_thread_num()) * 2 * longest_;
#pragma omp for schedule(dynamic, 1)
      for (Index t = 0; t < count; ++t) {
        for (Index s = cut_.subtrees[t].second; s >= cut_.subtrees[t].first; --s)
          on_supernode(s, local);
      }
    }
  });
}

/// Marks the supernodes of the wanted unknowns and their ancestors, which they depend on.
void InPlaceFactor::keep_current(std::span<const std::uint8_t> wanted) {
  wanted_.assign(tree_.parent.size(), 0);
  for (Index k = 0; k < size_; ++k) {
    if (wanted[k]) wanted_[tree_.of_column[position_[k]]] = 1;
  }
  for (std::size_t s = 0; s < tree_.parent.size(); ++s) {
    if (wanted_[s] && tree_.parent[s] != no_index) wanted_[tree_.parent[s]] = 1;
  }
}

void InPlaceFactor::solve(std::span<const double> rhs, std::span<double> solution) {
  for (Index k = 0; k < size_; ++k) vector_[position_[k]] = rhs[k];
  const Index count = num_supernodes();
  for (Index s = 0; s < count; ++s) {
    forward_on(s, 0, vector_.data(), local_.data());
    const Supernode<double> b = block(s);
    for (Index j = 0; j < b.columns; ++j) vector_[b.first + j] /= b.diagonal(j);
  }
  descend(solution_threads_,
          [this](Index s, double* local) { backward_on(s, vector_.data(), local); });
  for (Index k = 0; k < size_; ++k) solution[k] = vector_[position_[k]];
}

/// Eliminates x along a path and stores p = L^-1 x in p_.
/// \param start  column where the path begins, at or before the first row of x; no_index: no path.
///     Not given: the path of x, where nothing is done if p_ already holds p.
void InPlaceFactor::forward_path(const SparseVector& permuted, std::optional<Index> start) {
  if (!start && permuted.size() > 0 && permuted == on_path_of_) return;
  Index from = start.value_or(permuted.size() == 0 ? no_index : permuted.rows[0]);
  clear_path();
  on_path_of_ = permuted;
  if (from == no_index) return;
  for (int k = 0; k < permuted.size(); ++k) p_[permuted.rows[k]] = permuted.values[k];
  for (Index s = tree_.of_column[from]; s != no_index; s = tree_.parent[s]) {
    path_.push_back(s);
    on_path_[s] = 1;
    const Index first = block(s).first;
    forward_on(s, std::max<Index>(from - first, 0), p_.data(), local_.data());
    from = 0;
  }
}

void InPlaceFactor::clear_path() {
  for (const Index s : path_) {
    const Supernode<double> b = block(s);
    std::fill_n(p_.begin() + b.first, b.columns, 0.0);
    on_path_[s] = 0;
  }
  path_.clear();
}

/// Computes D of K -+ x x' on the path by a recurrence of scalars, and the coefficients that change
/// the columns. Sets vector_ to the right-hand side D^-1 p (old D) of the backward pass.
void InPlaceFactor::start_change(double sign) {
  on_path_of_ = {};  // p_ belongs to the factor before the change
  std::fill(vector_.begin(), vector_.end(), 0.0);
  double sigma = sign;
  for (const Index s : path_) {
    const Supernode<double> b = block(s);
    for (Index j = 0; j < b.columns; ++j) {
      double& d = b.diagonal(j);
      const Index k = b.first + j;
      const double changed = d + sigma * p_[k] * p_[k];
      vector_[k] = p_[k] / d;
      beta_[k] = sigma * p_[k] / changed;
      w_[k] = p_[k];
      sigma *= d / changed;
      d = changed;
    }
  }
}

double InPlaceFactor::pivot(const SparseVector& x) {
  forward_path(permute(x, position_));
  double removed = 0.0;
  for (const Index s : path_) {
    const Supernode<double> b = block(s);
    for (Index j = 0; j < b.columns; ++j) {
      const double p = p_[b.first + j];
      removed += p * p / b.diagonal(j);
    }
  }
  return 1.0 - removed;
}

void InPlaceFactor::compliance(std::span<const SparseVector> x, std::span<double> result) {
  std::vector<SparseVector> permuted;
  Index start = no_index;
  for (const SparseVector& column : x) {
    permuted.push_back(permute(column, position_));
    if (column.size() == 0) continue;
    const Index first = permuted.back().rows[0];
    start = start == no_index ? first : std::min(start, first);
  }
  std::vector<std::vector<double>> scaled(x.size());  // D^-1/2 L^-1 x along the common path
  for (std::size_t a = 0; a < x.size(); ++a) {
    forward_path(permuted[a], start);
    for (const Index s : path_) {
      const Supernode<double> b = block(s);
      for (Index j = 0; j < b.columns; ++j) {
        scaled[a].push_back(p_[b.first + j] / std::sqrt(b.diagonal(j)));
      }
    }
    for (std::size_t b = 0; b <= a; ++b) {
      double sum = 0.0;
      for (std::size_t k = 0; k < scaled[a].size(); ++k) sum += scaled[a][k] * scaled[b][k];
      result[a * x.size() + b] = result[b * x.size() + a] = sum;
    }
  }
}

std::vector<double> InPlaceFactor::columns(std::span<const SparseVector> x) {
  std::vector<double> motions(x.size() * static_cast<std::size_t>(size_), 0.0);
  for (std::size_t c = 0; c < x.size(); ++c) {
    forward_path(permute(x[c], position_));
    for (const Index s : path_) {
      const Supernode<double> b = block(s);
      double* const motion = motions.data() + c * size_ + b.first;
      for (Index j = 0; j < b.columns; ++j) motion[j] = p_[b.first + j] / b.diagonal(j);
    }
  }
  descend(column_threads_, [&](Index s, double* local) {
    if (!is_wanted(s)) return;
    for (std::size_t c = 0; c < x.size(); ++c) backward_on(s, motions.data() + c * size_, local);
  });
  std::vector<double> result;
  result.reserve(motions.size());
  for (std::size_t c = 0; c < x.size(); ++c) {
    for (Index k = 0; k < size_; ++k) result.push_back(motions[c * size_ + position_[k]]);
  }
  return result;
}

/// Downdates by one vector; the backward pass for K^-1 x also changes the columns of the path.
void InPlaceFactor::downdate_one(const SparseVector& x, double load_change, double pivot,
                                 std::span<double> solution) {
  const SparseVector permuted = permute(x, position_);
  const Index* permutation = static_cast<const Index*>(factor_->Perm);
  double extension = load_change;
  for (int k = 0; k < x.size(); ++k) {
    extension += permuted.values[k] * solution[permutation[permuted.rows[k]]];
  }
  forward_path(permuted);
  start_change(-1.0);
  descend(change_threads_, [this](Index s, double* local) {
    if (on_path_[s]) {
      backward_and_change_on(s, vector_.data(), local);
    } else if (is_wanted(s)) {
      backward_on(s, vector_.data(), local);
    }
  });
  // Skipped supernodes have zeros, so the solution keeps its values there.
  const double scale = extension / pivot;
  for (Index k = 0; k < size_; ++k) solution[k] += scale * vector_[position_[k]];
}

/// For vectors that do not interact, the solution becomes u + sum (load_change + x'u) / pivot K^-1
/// x.
void InPlaceFactor::downdate(std::span<const SparseVector> x, std::span<const double> load_changes,
                             std::span<const double> pivots, std::span<double> solution) {
  if (!solution.empty()) {
    if (x.size() == 1) return downdate_one(x[0], load_changes[0], pivots[0], solution);
    std::vector<double> shares = extensions(x, load_changes, solution);
    for (std::size_t a = 0; a < x.size(); ++a) shares[a] /= pivots[a];
    const SparseVector sum = combine(x, shares);
    const std::vector<double> motion = columns({&sum, 1});
    for (Index k = 0; k < size_; ++k) solution[k] += motion[k];
  }
  for (const SparseVector& column : x) change_path(permute(column, position_), -1.0);
}

/// Changes the columns of the path of x for K -+ x x'.
void InPlaceFactor::change_path(const SparseVector& permuted, double sign) {
  forward_path(permuted);
  start_change(sign);
  for (auto s = path_.rbegin(); s != path_.rend(); ++s) {
    backward_and_change_on(*s, vector_.data(), local_.data());
  }
}

void InPlaceFactor::update(const SparseVector& x) { change_path(permute(x, position_), 1.0); }

FactorStatistics InPlaceFactor::statistics() const {
  FactorStatistics result;
  result.size = size_;
  if (factor_) {
    result.entries = static_cast<double>(factor_->xsize);
    result.bytes = 8.0 * result.entries + 4.0 * static_cast<double>(factor_->ssize);
  }
  result.flops = flops_;
  result.factorizations = factorizations_;
  return result;
}

}  // namespace perilink

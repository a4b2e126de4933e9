#include "solver/cholmod_support.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "base/huge_pages.hpp"
#include "solver/dense/dense_kernels.hpp"
#include "solver/not_positive_definite.hpp"
#include "solver/supernodes/supernodal_cholesky.hpp"
#include "solver/supernodes/supernodes.hpp"

namespace perilink {
namespace {

/// Disables parallel regions during its lifetime. Debian's CHOLMOD requests four OpenMP threads in
/// small copying loops on any machine; with fewer processors they wait longer than they work.
class SerialOpenMp {
 public:
  SerialOpenMp() : levels_(omp_get_max_active_levels()) { omp_set_max_active_levels(0); }
  ~SerialOpenMp() { omp_set_max_active_levels(levels_); }
  SerialOpenMp(const SerialOpenMp&) = delete;
  SerialOpenMp& operator=(const SerialOpenMp&) = delete;

 private:
  int levels_;
};

void check(cholmod_common* common, const char* phase, std::size_t rows) {
  const std::string where =
      std::string(" while ") + phase + " a matrix of " + std::to_string(rows) + " rows";
  switch (common->status) {
    case CHOLMOD_OK: return;
    case CHOLMOD_OUT_OF_MEMORY: throw SolverError("out of memory" + where);
    case CHOLMOD_TOO_LARGE:
      throw SolverError("the factor has more numbers than 32-bit indices can count" + where);
    case CHOLMOD_NOT_POSDEF:
    case CHOLMOD_DSMALL: return;  // the caller checks factor->minor
    default: throw SolverError("CHOLMOD status " + std::to_string(common->status) + where);
  }
}

/// Returns the lower triangle with rows and columns in the order of elimination.
SparseMatrix in_order_of(const cholmod_factor& factor, const SparseMatrix& lower) {
  const Index* order = static_cast<const Index*>(factor.Perm);
  const std::vector<Index> position = invert({order, factor.n});
  const Eigen::Map<const Eigen::VectorX<Index>> indices(position.data(), lower.cols());
  const Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, Index> permutation(indices);
  SparseMatrix result(lower.rows(), lower.cols());
  result.selfadjointView<Eigen::Lower>() =
      lower.selfadjointView<Eigen::Lower>().twistedBy(permutation);
  return result;
}

}  // namespace

CholmodSession::CholmodSession() {
  prepare_blas();
#if SUITESPARSE_MAIN_VERSION >= 7
  SuiteSparse_config_malloc_func_set(allocate_memory);
#else
  SuiteSparse_config.malloc_func = allocate_memory;
#endif
  cholmod_start(&common_);
  common_.print = 0;
  common_.supernodal = CHOLMOD_SUPERNODAL;
  common_.final_ll = true;
  common_.nmethods = 1;
}

CholmodSession::~CholmodSession() { cholmod_finish(&common_); }

cholmod_sparse view_lower(const SparseMatrix& lower) {
  cholmod_sparse view{};
  view.nrow = view.ncol = static_cast<std::size_t>(lower.cols());
  view.nzmax = static_cast<std::size_t>(lower.nonZeros());
  view.p = const_cast<Index*>(lower.outerIndexPtr());
  view.i = const_cast<Index*>(lower.innerIndexPtr());
  view.x = const_cast<double*>(lower.valuePtr());
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

cholmod_dense view_column(std::span<double> values) {
  cholmod_dense view{};
  view.nrow = view.d = view.nzmax = values.size();
  view.ncol = 1;
  view.x = values.data();
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  return view;
}

CholmodFactorPtr analyze_supernodal(CholmodSession& session, const SparseMatrix& lower,
                                    std::span<const Index> groups) {
  std::vector<Index> permutation = order_by_particles(lower, groups);
  session.get()->method[0].ordering = CHOLMOD_GIVEN;
  cholmod_sparse matrix = view_lower(lower);
  CholmodFactorPtr factor(cholmod_analyze_p(&matrix, permutation.data(), nullptr, 0, session.get()),
                          CholmodFactorDeleter{session.get()});
  check(session.get(), "analysing", matrix.nrow);
  return factor;
}

void factorize_numerically(CholmodSession& session, const SparseMatrix& lower,
                           cholmod_factor* factor, int threads) {
  if (factor->xtype == CHOLMOD_PATTERN) {
    cholmod_change_factor(CHOLMOD_REAL, true, true, true, true, factor, session.get());
    check(session.get(), "making room to factorise", factor->n);
  }
  std::vector<double*> values;
  for (std::size_t s = 0; s < factor->nsuper; ++s) {
    values.push_back(supernode_of(*factor, static_cast<Index>(s)).values);
  }
  const SparseMatrix ordered = in_order_of(*factor, lower);
  factor->minor = static_cast<std::size_t>(
      factorize_supernodes<double>(columns_of(ordered), *factor, values, threads));
  if (factor->minor < factor->n) {
    const Index unknown = static_cast<const Index*>(factor->Perm)[factor->minor];
    throw NotPositiveDefinite("the stiffness matrix is not positive definite (unknown " +
                                  std::to_string(unknown) + " of " + std::to_string(factor->n) +
                                  "): part of the body can move freely",
                              unknown);
  }
}

FactorStatistics measure_factor(const cholmod_factor& factor, double flops) {
  FactorStatistics result;
  result.size = static_cast<Index>(factor.n);
  result.entries = static_cast<double>(factor.is_super ? factor.xsize : factor.nzmax);
  result.bytes = factor.is_super ? 8.0 * result.entries + 4.0 * static_cast<double>(factor.ssize)
                                 : 12.0 * result.entries;
  result.flops = flops;
  return result;
}

CholmodFactorPtr CholmodRoute::analyze(const SparseMatrix& matrix, std::span<const Index> groups) {
  CholmodFactorPtr analysis = analyze_supernodal(session_, matrix, groups);
  flops_ = session_.get()->fl;
  return analysis;
}

void CholmodRoute::compute(const SparseMatrix& matrix) {
  factorize_numerically(session_, matrix, factor_.get(), threads_);
  ++factorizations_;
}

std::vector<double> CholmodRoute::solve_system(int system, std::vector<double> rhs) {
  cholmod_dense b = view_column(rhs);
  cholmod_dense* x = cholmod_solve(system, factor_.get(), &b, session_.get());
  if (x == nullptr) throw SolverError("out of memory while solving");
  std::copy_n(static_cast<const double*>(x->x), rhs.size(), rhs.begin());
  cholmod_free_dense(&x, session_.get());
  return rhs;
}

void CholmodRoute::solve(std::span<const double> rhs, std::span<double> solution) {
  std::ranges::copy(solve_system(CHOLMOD_A, {rhs.begin(), rhs.end()}), solution.begin());
}

void CholmodRoute::solve_all(std::span<double> columns) {
  const SerialOpenMp serial;
  cholmod_dense b = view_column(columns);
  b.nrow = b.d = factor_->n;
  b.ncol = columns.size() / factor_->n;
  cholmod_dense* x = cholmod_solve(CHOLMOD_A, factor_.get(), &b, session_.get());
  if (x == nullptr) throw SolverError("out of memory while solving");
  std::copy_n(static_cast<const double*>(x->x), columns.size(), columns.begin());
  cholmod_free_dense(&x, session_.get());
}

SingleFactor CholmodRoute::in_single(double unit) const {
  const double root = 1.0 / std::sqrt(unit);
  SingleFactor single;
  single.place = invert({static_cast<const Index*>(factor_->Perm), factor_->n});
  for (std::size_t s = 0; s < factor_->nsuper; ++s) {
    const Supernode<double> own = supernode_of(*factor_, static_cast<Index>(s));
    SingleFactor::Supernode& node = single.supernodes.emplace_back();
    node.first = own.first;
    node.columns = own.columns;
    node.rows.assign(own.rows + own.columns, own.rows + own.count);
    const Index count = own.count;
    const double* column = own.values;
    node.values.resize(static_cast<std::size_t>(count) * node.columns, 0.0F);
    for (Index k = 0; k < node.columns; ++k, column += count) {
      float* value = node.values.data() + k;
      value[static_cast<std::size_t>(k) * node.columns] =
          static_cast<float>(1.0 / (root * column[k]));
      for (Index r = k + 1; r < count; ++r) {
        value[static_cast<std::size_t>(r) * node.columns] = static_cast<float>(root * column[r]);
      }
    }
  }
  return single;
}

std::vector<double> CholmodRoute::columns(std::span<const SparseVector> x) {
  std::vector<double> result;
  for (const SparseVector& column : x) {
    std::vector<double> rhs(factor_->n, 0.0);
    for (int k = 0; k < column.size(); ++k) rhs[column.rows[k]] = column.values[k];
    std::ranges::copy(solve_system(CHOLMOD_A, std::move(rhs)), std::back_inserter(result));
  }
  return result;
}

void CholmodRoute::compliance(std::span<const SparseVector> x, std::span<double> result) {
  const std::vector<double> motions = columns(x);
  for (std::size_t a = 0; a < x.size(); ++a) {
    for (std::size_t b = 0; b < x.size(); ++b) {
      double sum = 0.0;
      for (int k = 0; k < x[a].size(); ++k) {
        sum += x[a].values[k] * motions[b * factor_->n + x[a].rows[k]];
      }
      result[a * x.size() + b] = sum;
    }
  }
}

void CholmodRoute::follow(std::span<const SparseVector> x, std::span<const double> load_changes,
                          std::span<double> solution) {
  if (solution.empty()) return;
  const SparseVector missing = combine(x, extensions(x, load_changes, solution));
  const std::vector<double> motion = columns({&missing, 1});
  for (std::size_t k = 0; k < motion.size(); ++k) solution[k] += motion[k];
}

FactorStatistics CholmodRoute::statistics() const {
  if (!factor_) return {};
  FactorStatistics result = measure_factor(*factor_, flops_);
  result.factorizations = factorizations_;
  return result;
}

PermutedColumn::PermutedColumn(const SparseVector& x, std::span<const Index> position, Index size)
    : sorted_(permute(x, position)), offsets_{0, static_cast<Index>(x.size())}, matrix_{} {
  matrix_.nrow = static_cast<std::size_t>(size);
  matrix_.ncol = 1;
  matrix_.nzmax = sorted_.rows.size();
  matrix_.p = offsets_;
  matrix_.i = sorted_.rows.data();
  matrix_.x = sorted_.values.data();
  matrix_.itype = CHOLMOD_INT;
  matrix_.xtype = CHOLMOD_REAL;
  matrix_.dtype = CHOLMOD_DOUBLE;
  matrix_.sorted = 1;
  matrix_.packed = 1;
}

SparseVector permute(const SparseVector& x, std::span<const Index> position) {
  std::vector<int> order(x.rows.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return position[x.rows[a]] < position[x.rows[b]]; });
  SparseVector sorted;
  for (const int k : order) {
    sorted.rows.push_back(position[x.rows[k]]);
    sorted.values.push_back(x.values[k]);
  }
  return sorted;
}

}  // namespace perilink

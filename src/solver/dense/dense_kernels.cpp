#include "solver/dense/dense_kernels.hpp"

#include <dlfcn.h>
#include <sys/mman.h>

#include <algorithm>
#include <mutex>
#include <new>
#include <random>
#include <vector>

#include <Eigen/Dense>

#include "base/error.hpp"
#include "solver/dense/blas_kernels.hpp"
#include "solver/dense/lapack.hpp"

extern "C" {
void dgeqrf_(const int* m, const int* n, double* a, const int* lda, double* tau, double* work,
             const int* work_size, int* info);
void dorgqr_(const int* m, const int* n, const int* k, double* a, const int* lda, const double* tau,
             double* work, const int* work_size, int* info);
void dsyevd_(const char* job, const char* part, const int* n, double* a, const int* lda,
             double* values, double* work, const int* work_size, int* numbers,
             const int* numbers_size, int* info);
}

namespace perilink {
namespace {

using Eigen::MatrixXd;

/// Addition to the diagonal over its mean, so that singular matrices have a factor.
constexpr double shift = 1e-6;
/// Leaves 3e-8 of the softest vectors' size to vectors twice as stiff as a limit of 0.003.
constexpr int inverse_iterations = 2;
/// If a larger part of the vectors is below the limit, there may be more such vectors.
constexpr double full = 0.9;

/// Sets OpenBLAS to one thread, because it splits sums by its number of threads and results would
/// depend on it. Other BLAS libraries lack the function; the reference BLAS has one thread.
void use_one_blas_thread() {
  using SetThreads = void (*)(int);
  if (auto* set = reinterpret_cast<SetThreads>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))) {
    set(1);
  }
}

/// Makes OpenBLAS allocate its buffers once; it keeps them. OpenBLAS allocates one for each thread
/// at first use and retries forever if memory is full.
/// \return number of threads with a buffer
int take_blas_buffers(int threads) {
  static int taken = 0;
  using Take = void* (*)(int);
  using Give = void (*)(void*);
  auto* take = reinterpret_cast<Take>(dlsym(RTLD_DEFAULT, "blas_memory_alloc"));
  auto* give = reinterpret_cast<Give>(dlsym(RTLD_DEFAULT, "blas_memory_free"));
  if (taken >= threads || take == nullptr || give == nullptr) return threads;
  constexpr std::size_t size = std::size_t{128} << 20;
  std::vector<void*> buffers;
  for (int k = 0; k < threads; ++k) {
    // Buffers allocated before come first.
    if (k >= taken) {
      void* room = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
      if (room == MAP_FAILED) break;
      munmap(room, size);
    }
    buffers.push_back(take(0));
  }
  for (void* buffer : buffers) give(buffer);
  taken = std::max(taken, static_cast<int>(buffers.size()));
  if (taken == 0) throw std::bad_alloc();
  return taken;
}

/// Returns random numbers from -1 to 1, equal on every machine.
MatrixXd numbers_at_random(int rows, int columns) {
  std::mt19937 random(1);
  return MatrixXd::NullaryExpr(rows, columns,
                               [&] { return static_cast<double>(random()) / 2147483648.0 - 1.0; });
}

void check(int info) {
  if (info != 0) throw SolverError("eigenvectors of a dense matrix were not found");
}

/// Replaces the columns by orthonormal columns with the same span.
void orthonormalize(MatrixXd& columns) {
  const int m = static_cast<int>(columns.rows()), n = static_cast<int>(columns.cols());
  const int work_size = 64 * n;
  std::vector<double> tau(static_cast<std::size_t>(n)), work(static_cast<std::size_t>(work_size));
  int info = 0;
  dgeqrf_(&m, &n, columns.data(), &m, tau.data(), work.data(), &work_size, &info);
  check(info);
  dorgqr_(&m, &n, &n, columns.data(), &m, tau.data(), work.data(), &work_size, &info);
  check(info);
}

/// Returns a b or a' b.
MatrixXd product(const MatrixXd& a, bool transposed, const MatrixXd& b) {
  const int m = static_cast<int>(transposed ? a.cols() : a.rows());
  const int n = static_cast<int>(b.cols()), k = static_cast<int>(b.rows());
  const int rows = static_cast<int>(a.rows());
  const double one = 1.0, zero = 0.0;
  MatrixXd result(m, n);
  dgemm_(transposed ? "T" : "N", "N", &m, &n, &k, &one, a.data(), &rows, b.data(), &k, &zero,
         result.data(), &m);
  return result;
}

/// Computes columns = (L L')^-1 columns.
void solve(const MatrixXd& lower, MatrixXd& columns) {
  const int n = static_cast<int>(lower.rows()), count = static_cast<int>(columns.cols());
  const double one = 1.0;
  for (const char* trans : {"N", "T"}) {
    dtrsm_("L", "L", trans, "N", &n, &count, &one, lower.data(), &n, columns.data(), &n);
  }
}

/// Replaces a symmetric matrix by its eigenvectors. \return eigenvalues, ascending
Eigen::VectorXd diagonalize(MatrixXd& matrix) {
  const int n = static_cast<int>(matrix.rows());
  const int work_size = 1 + 6 * n + 2 * n * n, numbers_size = 3 + 5 * n;
  std::vector<double> work(static_cast<std::size_t>(work_size));
  std::vector<int> numbers(static_cast<std::size_t>(numbers_size));
  Eigen::VectorXd values(n);
  int info = 0;
  dsyevd_("V", "L", &n, matrix.data(), &n, values.data(), work.data(), &work_size, numbers.data(),
          &numbers_size, &info);
  check(info);
  return values;
}

}  // namespace

int prepare_blas(int threads) {
  static std::mutex one_at_a_time;
  static bool chosen = false;
  const std::lock_guard lock(one_at_a_time);
  if (!chosen) use_fitting_kernels();
  chosen = true;
  use_one_blas_thread();
  return take_blas_buffers(threads);
}

void add_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, Eigen::MatrixXd& sum) {
  const int m = static_cast<int>(a.rows()), n = static_cast<int>(b.rows());
  const int k = static_cast<int>(a.cols());
  if (m == 0 || n == 0 || k == 0) return;
  const double one = 1.0;
  dgemm_("N", "T", &m, &n, &k, &one, a.data(), &m, b.data(), &n, &one, sum.data(), &m);
}

Eigen::MatrixXd eigenvectors_below(const Eigen::MatrixXd& matrix, double limit, int expected) {
  const int size = static_cast<int>(matrix.rows());
  if (size == 0) return matrix;
  if (!matrix.allFinite()) throw SolverError("a dense matrix holds numbers that are not finite");
  if (!(matrix.trace() > 0.0)) return MatrixXd::Identity(size, limit < 0.0 ? 0 : size);
  MatrixXd lower = matrix;
  lower.diagonal().array() += shift * matrix.trace() / size;
  int info = 0;
  dpotrf_("L", &size, lower.data(), &size, &info);
  check(info);
  for (int count = std::min(size, expected);; count = std::min(size, 2 * count)) {
    MatrixXd columns = numbers_at_random(size, count);
    for (int step = 0; step < inverse_iterations; ++step) {
      solve(lower, columns);
      orthonormalize(columns);
    }
    MatrixXd vectors = product(columns, true, product(matrix, false, columns));
    const auto found = (diagonalize(vectors).array() <= limit).count();
    if (static_cast<double>(found) > full * count && count != size) continue;
    return product(columns, false, vectors.leftCols(found));
  }
}

}  // namespace perilink

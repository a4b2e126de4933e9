#include "solver/dense_kernels.hpp"

#include <dlfcn.h>
#include <sys/mman.h>

#include <limits>
#include <new>
#include <vector>

#include "base/error.hpp"

extern "C" {
void dgemm_(const char* trans_a, const char* trans_b, const int* m, const int* n, const int* k,
            const double* alpha, const double* a, const int* lda, const double* b, const int* ldb,
            const double* beta, double* c, const int* ldc);
void dsyevr_(const char* job, const char* range, const char* part, const int* n, double* a,
             const int* lda, const double* lowest, const double* highest, const int* first,
             const int* last, const double* tolerance, int* found, double* values, double* vectors,
             const int* ldz, int* support, double* work, const int* work_size, int* integers,
             const int* integers_size, int* info);
}

namespace perilink {
namespace {

/// OpenBLAS splits sums by its number of threads, which would make results depend on it: one
/// thread. Other BLAS libraries lack the function; the reference BLAS has one thread anyway.
void use_one_blas_thread() {
  using SetThreads = void (*)(int);
  if (auto* set = reinterpret_cast<SetThreads>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))) {
    set(1);
  }
}

/// OpenBLAS takes its buffer when it is first used, and where there is no room it asks for ever:
/// taken here once, it is kept.
void take_blas_buffer() {
  static bool taken = false;
  if (taken) return;
  using Take = void* (*)(int);
  using Give = void (*)(void*);
  auto* take = reinterpret_cast<Take>(dlsym(RTLD_DEFAULT, "blas_memory_alloc"));
  auto* give = reinterpret_cast<Give>(dlsym(RTLD_DEFAULT, "blas_memory_free"));
  if (take == nullptr || give == nullptr) return;
  constexpr std::size_t size = std::size_t{128} << 20;
  void* room = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) throw std::bad_alloc();
  munmap(room, size);
  give(take(0));
  taken = true;
}

}  // namespace

void prepare_blas() {
  use_one_blas_thread();
  take_blas_buffer();
}

void add_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, Eigen::MatrixXd& sum) {
  const int m = static_cast<int>(a.rows()), n = static_cast<int>(b.rows());
  const int k = static_cast<int>(a.cols());
  if (m == 0 || n == 0 || k == 0) return;
  const double one = 1.0;
  dgemm_("N", "T", &m, &n, &k, &one, a.data(), &m, b.data(), &n, &one, sum.data(), &m);
}

Eigen::MatrixXd eigenvectors_below(Eigen::MatrixXd matrix, double limit) {
  const int size = static_cast<int>(matrix.rows());
  if (size == 0) return matrix;
  if (!matrix.allFinite()) throw SolverError("a dense matrix holds numbers that are not finite");
  // A positive semidefinite matrix has nothing below this but round-off.
  const double lowest = -1.0 - std::abs(limit), tolerance = 0.0;
  int found = 0, info = 0;
  const int unused = 0;
  Eigen::VectorXd values(size);
  Eigen::MatrixXd vectors(size, size);
  std::vector<int> support(2 * static_cast<std::size_t>(size)), integers(1);
  std::vector<double> work(1);
  int work_size = -1, integers_size = -1;
  const auto run = [&] {
    dsyevr_("V", "V", "L", &size, matrix.data(), &size, &lowest, &limit, &unused, &unused,
            &tolerance, &found, values.data(), vectors.data(), &size, support.data(), work.data(),
            &work_size, integers.data(), &integers_size, &info);
  };
  run();  // asks for the sizes of the work space
  work_size = static_cast<int>(work[0]);
  integers_size = integers[0];
  work.resize(static_cast<std::size_t>(work_size));
  integers.resize(static_cast<std::size_t>(integers_size));
  run();
  if (info != 0) throw SolverError("eigenvectors of a dense matrix were not found");
  return vectors.leftCols(found);
}

}  // namespace perilink

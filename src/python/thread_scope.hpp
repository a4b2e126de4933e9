#pragma once

#include <dlfcn.h>
#include <omp.h>
#include <pthread.h>

#include "perilink.hpp"

namespace perilink {

/// Restores the numbers of threads of the process at the end of a computation: of OpenMP and of
/// OpenBLAS, which numpy may share. A forked process has one thread if its parent has used several:
/// OpenMP of GCC would wait for threads that fork() does not copy.
class ThreadScope {
 public:
  ThreadScope()
      : get_(reinterpret_cast<Get>(dlsym(RTLD_DEFAULT, "openblas_get_num_threads"))),
        set_(reinterpret_cast<Set>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))),
        omp_before_(omp_get_max_threads()),
        blas_before_(get_ != nullptr ? get_() : 0) {}
  ~ThreadScope() {
    omp_set_num_threads(omp_before_);
    if (set_ != nullptr && blas_before_ > 1) set_(blas_before_);
  }
  ThreadScope(const ThreadScope&) = delete;
  ThreadScope& operator=(const ThreadScope&) = delete;

  /// Begins with a number of threads. \param wanted  0: the default \return the number
  static int begin(int wanted) {
    static const int registered = pthread_atfork(nullptr, nullptr, [] { forked_ = threaded_; });
    static_cast<void>(registered);
    const int threads = set_threads(forked_ ? 1 : wanted);
    threaded_ = threaded_ || threads > 1;
    return threads;
  }
  /// Goes on with a number of threads that begin() gave before. One is in OpenBLAS, whose sums
  /// depend on their number.
  void use(int threads) {
    omp_set_num_threads(threads);
    if (set_ != nullptr && blas_before_ > 1) set_(1);
  }

 private:
  static inline bool threaded_ = false, forked_ = false;

  using Get = int (*)();
  using Set = void (*)(int);
  Get get_;
  Set set_;
  int omp_before_, blas_before_;
};

}  // namespace perilink

#pragma once

#include <dlfcn.h>
#include <omp.h>

#include "perilink.hpp"

namespace perilink {

/// Sets the number of threads of a computation, and restores those of the process at the end: of
/// OpenMP and of OpenBLAS, which numpy may share.
class ThreadScope {
 public:
  explicit ThreadScope(int wanted)
      : get_(reinterpret_cast<Get>(dlsym(RTLD_DEFAULT, "openblas_get_num_threads"))),
        set_(reinterpret_cast<Set>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))),
        omp_before_(omp_get_max_threads()),
        blas_before_(get_ != nullptr ? get_() : 0),
        threads_(set_threads(wanted)) {}
  ~ThreadScope() {
    omp_set_num_threads(omp_before_);
    if (set_ != nullptr && blas_before_ > 0) set_(blas_before_);
  }
  ThreadScope(const ThreadScope&) = delete;
  ThreadScope& operator=(const ThreadScope&) = delete;
  int threads() const { return threads_; }

 private:
  using Get = int (*)();
  using Set = void (*)(int);
  Get get_;
  Set set_;
  int omp_before_, blas_before_, threads_;
};

}  // namespace perilink

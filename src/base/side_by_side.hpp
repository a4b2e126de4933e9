#pragma once

#include <exception>

#include "base/types.hpp"

namespace perilink {

/// Calls work(k) for k = 0 … count - 1 in parallel threads. \throws one of the errors of work()
template <class Work>
void for_each_side_by_side(Index count, int threads, const Work& work) {
  std::exception_ptr error;
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (Index k = 0; k < count; ++k) {
    try {
      work(k);
    } catch (...) {
#pragma omp critical
      error = std::current_exception();
    }
  }
  if (error) std::rethrow_exception(error);
}

}  // namespace perilink

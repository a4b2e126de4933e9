#include "app/process/threads.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <omp.h>
#include <pthread.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <latch>
#include <vector>

#include "app/process/console.hpp"
#include "base/memory.hpp"
#include "base/plain_text.hpp"
#include "base/types.hpp"
#include "solver/dense/blas_kernels.hpp"

namespace perilink {
namespace {

/// Largest fraction of the address space for thread stacks; the rest is for the model.
constexpr double most_for_stacks = 0.5;

/// Most threads; more are taken for a typing error, as in --threads.
constexpr int most_threads = 1024;

double stack_size() {
  pthread_attr_t attributes;
  std::size_t bytes = 0;
  if (pthread_attr_init(&attributes) != 0) return 0.0;
  pthread_attr_getstacksize(&attributes, &bytes);
  pthread_attr_destroy(&attributes);
  return static_cast<double>(bytes);
}

/// Waits without using the heap, because each thread would allocate a heap arena.
void* wait_for_end(void* end) {
  static_cast<std::latch*>(end)->wait();
  return nullptr;
}

/// Returns how many threads can exist at once, including this one. OpenMP ends the program if it
/// cannot start a thread, so the number must be known first.
int threads_that_start(int wanted) {
  std::vector<pthread_t> others(static_cast<std::size_t>(wanted - 1));
  std::latch end(1);
  std::size_t count = 0;
  while (count < others.size() &&
         pthread_create(&others[count], nullptr, wait_for_end, &end) == 0) {
    ++count;
  }
  end.count_down();
  for (std::size_t k = 0; k < count; ++k) pthread_join(others[k], nullptr);
  return static_cast<int>(count) + 1;
}

int threads_with_room(int wanted) {
  const double space = available_address_space();
  if (std::isinf(space)) return wanted;
  mallopt(M_ARENA_MAX, 1);  // an arena per thread would take 64 MB each
  const double stacks = most_for_stacks * space / std::max(stack_size(), 1.0);
  return static_cast<int>(std::min<double>(wanted, 1.0 + std::floor(stacks)));
}

}  // namespace

double granted_processors(const std::string& cgroups) {
  double quota = 0.0, period = 0.0;
  const bool limited = (std::ifstream(cgroups + "/cpu.max") >> quota >> period) ||
                       ((std::ifstream(cgroups + "/cpu/cpu.cfs_quota_us") >> quota) &&
                        (std::ifstream(cgroups + "/cpu/cpu.cfs_period_us") >> period));
  return limited && quota > 0.0 && period > 0.0 ? quota / period : infinity;
}

int default_threads() {
  const int threads = omp_get_max_threads();
  const char* const asked = std::getenv("OMP_NUM_THREADS");
  if (asked != nullptr && std::atoi(asked) == threads) return threads;  // set, and valid for OpenMP
  return static_cast<int>(std::min<double>(threads, std::ceil(granted_processors())));
}

int set_threads(int wanted) {
  if (wanted <= 0) wanted = default_threads();
  const int most = std::min(most_blas_threads(), most_threads);
  const int threads = threads_that_start(threads_with_room(std::min(wanted, most)));
  if (threads < wanted) {
    complain(fmt::format(
        "uses {} of {}: {}; the results do not depend on it", threads, counted(wanted, "thread"),
        threads < most ? "the limits on the process (ulimit -v, -d, -u) leave no room for more"
                       : "the program and its linear algebra library (OpenBLAS) support no more"));
  }
  omp_set_num_threads(threads);
#pragma omp parallel  // started early, while memory is free; they persist
  {}
  return threads;
}

}  // namespace perilink

#pragma once

#include <omp.h>

#include "base/timer.hpp"

namespace perilink {

/// Chooses between one thread and all threads for a short, repeated piece of work. On a shared
/// machine, threads can wait much longer than they work (docs/developers/profiling.md). The mean
/// time decides, and the slower number is tried again at intervals. Each kind of work needs its own
/// choice, because times of different kinds cannot be compared.
class ThreadChoice {
 public:
  explicit ThreadChoice(int most) : most_(most) {}

  /// Calls work(number of threads).
  template <class Work>
  void run(Work work) {
    if (most_ <= 1) return work(1);
    const Timer timer;
    work(threads());
    took(timer.seconds());
  }

  /// Calls work(); its parallel loops have the chosen number of threads.
  template <class Work>
  void run_within(Work work) {
    run([&](int threads) {
      const Scope scope(threads);
      work();
    });
  }

  /// Returns the number of threads for the next piece of work.
  int threads() const { return several_ ? most_ : 1; }
  /// Records the time of a piece of work.
  /// \param seconds  measured time
  void took(double seconds);

 private:
  struct Scope {
    explicit Scope(int threads) { omp_set_num_threads(threads); }
    ~Scope() { omp_set_num_threads(before); }
    int before = omp_get_max_threads();
  };

  int most_;
  bool several_ = false;
  bool on_trial_ = true;           ///< trial of the slower number or of an unmeasured one
  int count_ = 0;                  ///< pieces of work since the last change
  int patience_ = 0;               ///< pieces of work until the next trial
  double mean_[2] = {-1.0, -1.0};  ///< with one thread and with several; negative if unmeasured [s]
};

}  // namespace perilink

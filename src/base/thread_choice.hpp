#pragma once

#include <omp.h>

#include "base/timer.hpp"

namespace perilink {

/// Chooses between one thread and all for a short piece of work that is done again and again. Where
/// other programs use the machine, threads wait for one another many times longer than they work
/// (docs/developers/profiling.md). So the mean time decides, and the slower number is tried again
/// now and then. For each kind of work one choice: means of several kinds tell nothing.
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

  /// For the next piece of work.
  int threads() const { return several_ ? most_ : 1; }
  /// \param seconds  that it took
  void took(double seconds);

 private:
  struct Scope {
    explicit Scope(int threads) { omp_set_num_threads(threads); }
    ~Scope() { omp_set_num_threads(before); }
    int before = omp_get_max_threads();
  };

  int most_;
  bool several_ = false;
  bool on_trial_ = true;           ///< the slower number, or one that is not known yet
  int count_ = 0;                  ///< pieces of work since the last change
  int patience_ = 0;               ///< pieces of work until the next trial
  double mean_[2] = {-1.0, -1.0};  ///< with one thread and with several; negative: not known [s]
};

}  // namespace perilink

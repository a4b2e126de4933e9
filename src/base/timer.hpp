#pragma once

#include <chrono>

namespace perilink {

/// Wall-clock stopwatch that starts when it is created.
class Timer {
 public:
  /// Returns seconds since the start or the last restart.
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  void restart() { start_ = Clock::now(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace perilink

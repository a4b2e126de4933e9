#include "base/thread_choice.hpp"

#include <algorithm>

namespace perilink {
namespace {

/// Share of the last time in the mean.
constexpr double newest = 0.25;

/// Pieces of work in a trial, and from one to the next: twice as many after each that is lost.
constexpr int trial = 4, least_patience = 32, most_patience = 1024;

}  // namespace

void ThreadChoice::took(double seconds) {
  double& mean = mean_[several_ ? 1 : 0];
  const double other = mean_[several_ ? 0 : 1];
  mean = mean < 0.0 ? seconds : mean + newest * (seconds - mean);
  ++count_;
  const auto change = [&](bool on_trial) {
    several_ = !several_;
    if (on_trial) mean_[several_ ? 1 : 0] = -1.0;  // what it was tells nothing of the machine now
    on_trial_ = on_trial;
    count_ = 0;
  };
  if (on_trial_) {
    const bool hopeless = other >= 0.0 && mean > 2.0 * other;
    if (count_ < trial && !hopeless) return;
    if (other < 0.0) return change(true);
    if (mean > other) {
      patience_ = std::clamp(2 * patience_, least_patience, most_patience);
      return change(false);
    }
    patience_ = least_patience;
    on_trial_ = false;
    count_ = 0;
  } else if (mean > other) {
    patience_ = least_patience;
    change(false);
  } else if (count_ >= patience_) {
    change(true);
  }
}

}  // namespace perilink

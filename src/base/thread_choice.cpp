#include "base/thread_choice.hpp"

#include <algorithm>

namespace perilink {
namespace {

/// Share of the last time in the mean, and its largest size over the mean: what comes once is left
/// out as far as possible.
constexpr double newest = 0.25, largest = 4.0;

/// Times vary by as much on a quiet machine; beyond the second one piece of work is trial enough.
constexpr double clearly_slower = 1.1, hopelessly_slower = 1.5;

/// Pieces of work in a trial, and from one to the next: twice as many after each that is lost, and
/// so many that trials cost a tenth of all time at most.
constexpr int trial = 2, least_patience = 64, most_patience = 4096;
constexpr double most_for_trials = 0.1;

}  // namespace

void ThreadChoice::took(double seconds) {
  double& mean = mean_[several_ ? 1 : 0];
  const double other = mean_[several_ ? 0 : 1];
  mean = mean < 0.0 ? seconds : mean + newest * (std::min(seconds, largest * mean) - mean);
  ++count_;
  const auto change = [&](bool on_trial) {
    several_ = !several_;
    if (on_trial) mean_[several_ ? 1 : 0] = -1.0;  // what it was tells nothing of the machine now
    on_trial_ = on_trial;
    count_ = 0;
  };
  if (on_trial_) {
    const bool hopeless = other >= 0.0 && mean > hopelessly_slower * other;
    if (count_ < trial && !hopeless) return;
    if (other < 0.0) return change(true);
    if (mean > other) {
      const double spent = count_ * mean / other;
      const double needed = std::max(2.0 * patience_, spent / most_for_trials);
      patience_ = static_cast<int>(std::clamp<double>(needed, least_patience, most_patience));
      return change(false);
    }
    patience_ = least_patience;
    on_trial_ = false;
    count_ = 0;
  } else if (mean > clearly_slower * other) {
    patience_ = least_patience;
    change(false);
  } else if (count_ >= patience_) {
    change(true);
  }
}

}  // namespace perilink

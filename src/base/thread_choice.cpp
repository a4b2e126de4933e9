#include "base/thread_choice.hpp"

#include <algorithm>

namespace perilink {
namespace {

/// Weight of the newest time in the mean, and its upper bound over the mean. Both reduce the effect
/// of single outliers.
constexpr double newest = 0.25, largest = 4.0;

/// Ratios of mean times. Times vary by 10 % on a quiet machine; beyond the second ratio one piece
/// of work ends the trial.
constexpr double clearly_slower = 1.1, hopelessly_slower = 1.5;

/// Pieces of work in a trial and between trials. The interval doubles after each failed trial, so
/// that trials cost at most a tenth of all time.
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
    if (on_trial) mean_[several_ ? 1 : 0] = -1.0;  // the machine may have changed
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

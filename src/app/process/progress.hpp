#pragma once

#include <optional>
#include <string>

#include "base/timer.hpp"

namespace perilink {

/// Where a run stands, for people: a bar that is drawn over itself on a terminal, a plain line now
/// and then elsewhere, nothing when quiet. Goes to standard error.
class ProgressBar {
 public:
  explicit ProgressBar(bool quiet);

  /// Whether it is time to draw again.
  bool is_due();
  /// \param state  in words
  /// \param done   fraction of the run that is done, where it is known
  void draw(const std::string& state, std::optional<double> done);
  /// Ends the line of the bar.
  void finish();

 private:
  bool quiet_;
  bool terminal_;
  Timer since_start_;
  double next_update_ = 0.0;  ///< [s]
  bool drawn_ = false;
};

/// Where the calibration of bonds stands, for people at a terminal: a line drawn over itself on
/// standard error, and gone at the end; nothing elsewhere or when quiet.
class CalibrationProgress {
 public:
  explicit CalibrationProgress(bool quiet);
  ~CalibrationProgress();
  CalibrationProgress(const CalibrationProgress&) = delete;
  CalibrationProgress& operator=(const CalibrationProgress&) = delete;

  /// To be called before every search, see CalibrationObserver.
  void update(int search, double unbalanced);

 private:
  bool shown_;
  Timer since_start_;
  bool drawn_ = false;
};

/// "3 s", "2 min 10 s", "1 h 05 min".
std::string format_duration(double seconds);

}  // namespace perilink

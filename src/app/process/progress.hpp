#pragma once

#include <optional>
#include <string>

#include "base/timer.hpp"

namespace perilink {

/// Progress of a run on standard error: a bar redrawn on a terminal, occasional plain lines
/// elsewhere, no output when quiet.
class ProgressBar {
 public:
  explicit ProgressBar(bool quiet);

  /// Whether it is time to draw again.
  bool is_due();
  /// \param state  text of the current state
  /// \param done   completed fraction of the run, if known
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

/// Progress of the bond calibration on a terminal: a line redrawn on standard error and removed at
/// the end; no output elsewhere or when quiet.
class CalibrationProgress {
 public:
  explicit CalibrationProgress(bool quiet);
  ~CalibrationProgress();
  CalibrationProgress(const CalibrationProgress&) = delete;
  CalibrationProgress& operator=(const CalibrationProgress&) = delete;

  /// Draws the progress. Called before every solve, see CalibrationObserver.
  void update(int search, double unbalanced);

 private:
  bool shown_;
  Timer since_start_;
  bool drawn_ = false;
};

/// Formats a duration, "3 s", "2 min 10 s", "1 h 05 min".
std::string format_duration(double seconds);

}  // namespace perilink

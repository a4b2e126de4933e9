#pragma once

#include <functional>
#include <string>

#include "base/types.hpp"
#include "calibration/calibration_input.hpp"

namespace perilink {

/// Progress of a run, the same for all analysis types.
struct RowProgress {
  Index row = 0;      ///< number of rows of the history so far
  Index step = 0;     ///< column `step`
  double time = 0.0;  ///< of explicit runs [time]
  double load_factor = 0.0;
  double load = 0.0;          ///< [force]
  double displacement = 0.0;  ///< [length]
  Index broken_bonds = 0;     ///< cracked particles of state-based bodies
};

/// Functions that a run calls; each may be empty. All are called from the thread of the run.
struct RunCallbacks {
  RunCallbacks(bool is_quiet = false) : quiet(is_quiet) {}  // NOLINT: most callers give this alone

  bool quiet;  ///< no progress on standard error
  /// Returns whether to end the run now and keep its results. Called at every row and time step.
  std::function<bool()> stop_requested;
  std::function<void(const RowProgress&)> on_row;  ///< called after every row of the history
  CalibrationObserver on_calibration;        ///< called before every solve of the bond calibration
  CalibrationStore* calibrations = nullptr;  ///< see calibrate_once()
  std::function<void()> on_start;            ///< called before the first file is written
  std::function<void(const std::string&)> on_fault;  ///< receives errors when they happen
  std::function<void(const std::string&)> on_note;   ///< receives where a resumed run goes on

  bool asks_to_stop() const { return stop_requested && stop_requested(); }
};

}  // namespace perilink

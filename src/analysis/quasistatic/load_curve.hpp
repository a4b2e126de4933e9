#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "analysis/quasistatic/observer.hpp"

/// \file
/// Peaks of load–displacement curves, and the smooth curve through their saw-teeth.

namespace perilink {

/// A point of a load–displacement curve.
struct CurvePoint {
  double displacement = 0.0;
  double load = 0.0;
  /// Energy that a batch at a row dissipates beyond the line to the next point; not archived.
  double beyond = 0.0;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(displacement, load);
  }
};

/// Returns the rows of a history as a path of single events. Its area is the energy that the events
/// dissipate. The path leaves out a last row without resistance and the compliance that host
/// releases added. It is empty for load steps, rows in time, and forces combined with prescribed
/// displacements: the two axes do not hold their work.
std::vector<CurvePoint> event_path(std::span<const StepRecord> records);

/// Returns a smooth curve through the saw-teeth of an event path that dissipates the same energy.
/// It has one point for every `window` events or slightly more. The event from (u, P) to (u', P')
/// dissipates (P u' − P' u) / 2, a batch also CurvePoint::beyond. In a window that dissipates D,
/// u / P grows by dC and P / u falls by dK. Its point has load² = 2 D / dC and displacement² = 2 D
/// / dK, means of the window. Windows whose u / P grows by round-off only have no point.
std::vector<CurvePoint> smooth_envelope(std::span<const CurvePoint> path, std::size_t window);

/// Returns the number of events per window that gives about 120 points, at least 10.
std::size_t envelope_window(std::size_t events);

/// Returns the rows of one stage, with constant and growing loads, as a path of events. An event
/// that dissipates D between nonzero loads P and P' adds the compliance 2 D / (P P'), a batch with
/// the mean load of its elements for P'. Displacements are equivalent ones, for smooth_envelope().
std::vector<CurvePoint> stage_path(std::span<const StepRecord> records);

/// Returns the largest load of the envelope, with its sign [force]. It is absent for fewer than two
/// windows, and if a window without a point holds a larger load. The latter happens on weak
/// springs, whose round-off hides the compliance of the body.
std::optional<double> smoothed_peak(std::span<const CurvePoint> path);

/// Fraction by which a load exceeds the first peak if it is residual strength [-].
inline constexpr double residual_climb = 0.1;

/// Returns the number of rows before the residual strength of a failed body. They end at the lowest
/// row of a fall that lasts: until the load comes again, the displacement grows by a fifth. They
/// end no later than where the body gave way (PeakWatch) if the load climbed again after it.
/// Otherwise all rows count.
/// \param bars  reinforcing bars carry the load after the solid cracks: only a body that gave way
///              counts
std::size_t rows_before_residual(std::span<const CurvePoint> path, bool bars);

/// Fraction of an earlier peak load below which a body has given way [-].
inline constexpr double collapsed_part = 0.5;

/// Successive rows that must lie below collapsed_part in explicit runs, whose loads vibrate.
inline constexpr int vibrating_rows = 10;

/// Follows the peaks of a curve row by row, as in a test with growing displacement. Rows at smaller
/// displacements than the largest so far are skipped. The body has given way once the load falls
/// below collapsed_part of its peak so far.
class PeakWatch {
 public:
  PeakWatch() = default;
  /// \param rows  successive rows that must lie below collapsed_part; more than one if loads
  ///              vibrate
  explicit PeakWatch(int rows) : rows_(rows) {}

  /// \param intact  the body is undamaged: it has not given way, whatever the load
  void add(const CurvePoint& row, bool intact = false);

  /// Sets the first peak; later loads are residual strength.
  void end_with(const CurvePoint& first) {
    gave_way_ = true;
    first_ = first;
  }

  /// Returns the row with the largest |load|.
  const CurvePoint& highest() const { return highest_; }
  /// Returns the row with the largest |load| before the body gave way.
  const CurvePoint& first() const { return gave_way_ ? first_ : highest_; }
  bool gave_way() const { return gave_way_; }
  /// Returns whether the load exceeded its first peak after the body gave way.
  bool climbed_again() const { return std::abs(highest_.load) > std::abs(first().load); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(rows_, below_, gave_way_, reached_, last_, highest_, first_);
  }

 private:
  int rows_ = 1;
  int below_ = 0;
  bool gave_way_ = false;
  double reached_ = 0.0;  ///< largest |displacement| so far
  CurvePoint last_, highest_, first_;
};

}  // namespace perilink

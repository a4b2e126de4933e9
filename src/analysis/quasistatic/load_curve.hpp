#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "analysis/quasistatic/observer.hpp"

/// \file
/// What load–displacement curves tell: peaks, and the smooth curve through saw-teeth.

namespace perilink {

/// A point of a load–displacement curve.
struct CurvePoint {
  double displacement = 0.0;
  double load = 0.0;
};

/// The rows of a history as a path of single events whose area is the energy that it dissipates,
/// without a last row that resists nothing. What conversions of finite elements freed is no part of
/// it: displacements are those without. Empty where the rows are no such path: load steps, rows
/// in time, and events under forces beside driven displacements, whose work the two axes miss.
std::vector<CurvePoint> event_path(std::span<const StepRecord> records);

/// Smooth curve through the saw-teeth of an event path that dissipates as much energy: a point for
/// every `window` events or somewhat more. The event from (u, P) to (u', P') dissipates
/// (P u' − P' u) / 2. With the sum D of a window and dC the growth of u / P in it, the point has
/// load² = 2 D / dC and displacement² = 2 D / (fall of P / u): means of the loads and displacements
/// of the window, beyond none of them. Windows in which u / P grows by round-off only have none.
std::vector<CurvePoint> smooth_envelope(std::span<const CurvePoint> path, std::size_t window);

/// Number of events per window that leaves about 120 points, at least 10.
std::size_t envelope_window(std::size_t events);

/// The rows of one stage, whose growing loads have constant ones beside them, as a path of events:
/// each event that dissipates D between loads P and P', which are not zero, adds the compliance
/// 2 D / (P P'). Loads are those of the rows; displacements are equivalent ones, for
/// smooth_envelope() alone.
std::vector<CurvePoint> stage_path(std::span<const StepRecord> records);

/// Largest load of the envelope, with its sign [force]; none of fewer than two windows, and none
/// where a window without a point holds a larger load (on weak springs the body's own compliance is
/// round-off of theirs).
std::optional<double> smoothed_peak(std::span<const CurvePoint> path);

/// By which a load exceeds a first peak where it is residual strength [-].
inline constexpr double residual_climb = 0.1;

/// Number of rows before the residual strength of a body that has failed: up to the lowest point of
/// the envelope between its first peak and a larger one, or to the row with which the body gave way
/// (PeakWatch) where the load climbed again after it; all rows where neither is the case.
/// \param bars  reinforcing bars carry the load on where the solid cracks: falls of the envelope do
///              not count
std::size_t rows_before_residual(std::span<const CurvePoint> path, bool bars);

/// Below this part of an earlier peak a body has given way.
inline constexpr double collapsed_part = 0.5;

/// Rows of explicit runs, whose loads vibrate, that have to lie below it.
inline constexpr int vibrating_rows = 10;

/// Follows the peaks of a curve, row after row, as a test sees them whose displacement only grows:
/// what the path does at smaller displacements than it has reached is passed over. The body has
/// given way where the load falls below collapsed_part of its peak so far.
class PeakWatch {
 public:
  PeakWatch() = default;
  /// \param rows  successive ones that have to lie below; more than one where loads vibrate
  explicit PeakWatch(int rows) : rows_(rows) {}

  /// \param intact  nothing is damaged yet: whatever the load does the body has not given way
  void add(const CurvePoint& row, bool intact = false);

  /// Ends the search for the first peak: later loads are residual strength.
  void end_with(const CurvePoint& first) {
    gave_way_ = true;
    first_ = first;
  }

  /// Largest |load|, with its sign.
  const CurvePoint& highest() const { return highest_; }
  /// The largest before the body gave way.
  const CurvePoint& first() const { return gave_way_ ? first_ : highest_; }
  bool gave_way() const { return gave_way_; }
  /// The load exceeded its first peak after the body gave way.
  bool climbed_again() const { return std::abs(highest_.load) > std::abs(first().load); }

 private:
  int rows_ = 1;
  int below_ = 0;
  bool gave_way_ = false;
  double reached_ = 0.0;  ///< largest |displacement|
  CurvePoint last_, highest_, first_;
};

}  // namespace perilink

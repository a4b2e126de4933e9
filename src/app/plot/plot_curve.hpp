#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/quasistatic/load_curve.hpp"
#include "analysis/quasistatic/observer.hpp"
#include "app/plot/curve_frame.hpp"
#include "app/plot/plot_labels.hpp"
#include "app/plot/svg.hpp"

namespace perilink {

/// Number of events above which a path is drawn with its envelope.
inline constexpr std::size_t events_for_envelope = 200;

/// Returns the row of the largest absolute load; `records` must not be empty.
std::size_t peak_row(std::span<const StepRecord> records);

/// Returns loads over displacements of the rows, with their signs.
std::vector<CurvePoint> points_of(std::span<const StepRecord> records);

/// Returns event_path() of the rows of a run; empty where its summary shows a run without
/// bond-breaking events.
std::vector<CurvePoint> event_path_of(std::span<const StepRecord> records,
                                      const PlotLabels& labels);

/// Returns the number of rows before the tail of a curve, which a failed body leaves: loads below a
/// hundredth of the peak up to the end, at displacements beyond those before.
std::size_t rows_before_tail(std::span<const CurvePoint> curve);

/// Returns the number of rows up to the smallest load behind a peak, if a later load exceeds the
/// peak and later displacements are more than ten times larger; else that of all rows.
std::size_t rows_before_drift(std::span<const CurvePoint> curve, const CurvePoint& peak);

/// Returns the note that a picture leaves out rows of a tail; empty for none.
std::string note_of_tail(std::size_t rows);

/// Draws load over displacement with the peak marked; a path of more than 200 events has its
/// envelope.
/// \param first_peak  from the run's summary; marked where it is not the peak
/// \param rows        drawn; absent: rows_before_tail()
Svg draw_load_displacement(std::span<const StepRecord> records, const PlotLabels& labels,
                           const std::optional<CurvePoint>& first_peak = {},
                           std::optional<std::size_t> rows = {});

/// Two columns of a history.
struct ColumnCurve {
  std::string x_label, y_label;
  std::vector<CurvePoint> points;  ///< `displacement` is along x, `load` along y
  bool from_origin = false;        ///< both columns are zero in the undeformed state
  std::string note;                ///< below the axis
};

/// Draws a column of a history over another.
Svg draw_columns(const ColumnCurve& curve, const std::string& title);

}  // namespace perilink

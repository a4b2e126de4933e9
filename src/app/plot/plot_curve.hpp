#pragma once

#include <optional>
#include <span>
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

/// Draws load over displacement with the peak marked; a path of more than 200 events has its
/// envelope.
/// \param first_peak  from the run's summary; marked where it is not the peak
Svg draw_load_displacement(std::span<const StepRecord> records, const PlotLabels& labels,
                           const std::optional<CurvePoint>& first_peak = {});

}  // namespace perilink

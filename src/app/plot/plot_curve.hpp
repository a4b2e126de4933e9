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

/// Paths of more events are drawn with their envelope.
inline constexpr std::size_t events_for_envelope = 200;

/// Row of the largest absolute load; `records` must not be empty.
std::size_t peak_row(std::span<const StepRecord> records);

/// Loads over displacements of the rows, signs as they are.
std::vector<CurvePoint> points_of(std::span<const StepRecord> records);

/// event_path() of the rows of a run; empty where its summary says that it breaks no single bonds.
std::vector<CurvePoint> event_path_of(std::span<const StepRecord> records,
                                      const PlotLabels& labels);

/// Load over displacement with the peak marked; a path of more than 200 events with its envelope.
/// \param first_peak  from the run's summary; marked where the peak is another
Svg draw_load_displacement(std::span<const StepRecord> records, const PlotLabels& labels,
                           const std::optional<CurvePoint>& first_peak = {});

}  // namespace perilink

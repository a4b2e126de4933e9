#pragma once

#include <span>
#include <vector>

#include "analysis/observer.hpp"
#include "app/curve_frame.hpp"
#include "app/plot_labels.hpp"
#include "app/svg.hpp"

namespace perilink {

/// Curves of more rows are drawn with their envelope.
inline constexpr std::size_t events_for_envelope = 200;

/// Smooth curve through the saw-teeth of an event path that dissipates as much energy: in each
/// window of events with compliance growths dC, load factor^2 = sum(factor^2 dC) / sum(dC) at the
/// middle of the window's compliances. Windows without growth of the compliance (yielding reversed,
/// load steps) take the mean of their rows.
std::vector<CurvePoint> smooth_envelope(std::span<const StepRecord> records, std::size_t window);

/// Number of events per window that leaves about 120 points, at least 10.
std::size_t envelope_window(std::size_t events);

/// Row of the largest absolute load; `records` must not be empty.
std::size_t peak_row(std::span<const StepRecord> records);

/// What the rows of a history follow: one event after the other, or time.
enum class HistoryPath { events, time };

/// Load over displacement with the peak marked; beyond 200 events the envelope too.
Svg draw_load_displacement(std::span<const StepRecord> records, const PlotLabels& labels,
                           HistoryPath path = HistoryPath::events);

}  // namespace perilink

#include "analysis/quasistatic/load_curve.hpp"

#include <algorithm>

#include "analysis/quasistatic/path_energy.hpp"

namespace perilink {
namespace {

/// Relative round-off of loads and displacements: histories hold all digits, but solutions have a
/// residual [-].
constexpr double factor_round_off = 1e-9;

/// Fraction of the peak by which the load must fall [-]. Single events fall by more.
constexpr double fallen = 0.02;

/// Fraction by which the displacement must grow until the load comes again [-]. Behind events
/// at constant load within a growing crack it grows by up to an eighth, however deep the load fell.
constexpr double lasting = 0.2;

Index events_before(const StepRecord& record) { return record.broken_bonds + record.yield_events; }

/// Returns whether load times displacement is twice the stored energy, as under forces only or
/// prescribed displacements only.
bool axes_hold_all_energy(const StepRecord& record) {
  const double stored = 2.0 * record.strain_energy;
  return std::abs(record.load * record.displacement - stored) <=
         factor_round_off * std::abs(stored);
}

double compliance(const CurvePoint& point) { return point.displacement / point.load; }

/// Returns what a batch of a path dissipates beyond the line between its last two points.
double energy_beyond(std::span<const CurvePoint> path, const StepRecord& row,
                     const StepRecord& next) {
  const CurvePoint &from = path[path.size() - 2], &to = path.back();
  const double half = 0.5 * from.load * (compliance(to) - compliance(from));
  return energy_beyond_line(static_cast<double>(row.events), half * to.load,
                            next.released_energy - row.released_energy, half * from.load);
}

using Window = std::span<const CurvePoint>;  // successive rows; neighbours share one row

/// Splits a path into windows of about `events` events; none for a path without events.
std::vector<Window> windows_of(Window path, std::size_t events) {
  std::vector<Window> windows;
  if (path.size() < 2) return windows;
  const std::size_t all = path.size() - 1, count = std::max<std::size_t>(1, all / events);
  for (std::size_t w = 0; w < count; ++w) {
    const std::size_t begin = w * all / count, end = (w + 1) * all / count;
    windows.push_back(path.subspan(begin, end - begin + 1));
  }
  return windows;
}

/// Returns the envelope point of a window; none if the compliance grows by round-off only.
std::optional<CurvePoint> smooth_point(Window rows) {
  double growth = 0.0, squares = 0.0;
  for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
    const double softer = std::max(0.0, compliance(rows[k + 1]) - compliance(rows[k]));
    growth += softer;
    squares += rows[k].load * rows[k + 1].load * softer + 2.0 * rows[k].beyond;
  }
  const double before = compliance(rows.front()), after = compliance(rows.back());
  if (!(growth > factor_round_off * after)) return std::nullopt;
  const double load = std::copysign(std::sqrt(squares / growth), rows.front().load);
  return CurvePoint{load * std::sqrt(before * after), load};
}

/// Returns the rows up to the lowest one of the first fall that lasts, if a later load exceeds the
/// peak before it.
std::size_t rows_before_climb(Window path) {
  struct Fall {
    double peak = 0.0;  // |load|
    std::size_t rows = 0;
  } first;
  double peak = 0.0, reached = 0.0;  // |load| and |displacement| of rows that held the load
  std::size_t held = 0, lowest = 0;
  for (std::size_t k = 0; k < path.size(); ++k) {
    const double load = std::abs(path[k].load), at = std::abs(path[k].displacement);
    if (load < (1.0 - fallen) * peak) {
      if (load < std::abs(path[lowest].load)) lowest = k;
      continue;
    }
    const bool fell = k > held + 1 && at > (1.0 + lasting) * reached;
    if (fell && first.rows == 0) first = {peak, lowest + 1};
    if (first.rows > 0 && load > (1.0 + residual_climb) * first.peak) return first.rows;
    peak = std::max(peak, load);
    reached = std::max(reached, at);
    held = lowest = k;
  }
  return path.size();
}

}  // namespace

std::vector<CurvePoint> event_path(std::span<const StepRecord> records) {
  std::vector<CurvePoint> path;
  double highest = 0.0;
  double freed = 0.0;  // compliance that host releases added
  for (std::size_t k = 0; k < records.size(); ++k) {
    const StepRecord& record = records[k];
    highest = std::max(highest, std::abs(record.load));
    const bool resists = std::abs(record.load) > factor_round_off * highest;
    if (record.stage > 0) return {};
    if (k > 0 && events_before(record) != events_before(records[k - 1]) + records[k - 1].events)
      return {};
    if (!resists && k + 1 == records.size()) break;
    if (!(record.load * record.displacement > 0.0) || !axes_hold_all_energy(record)) return {};
    if (k > 0) {
      const double energy = record.constraint_energy - records[k - 1].constraint_energy;
      freed += 2.0 * energy / (records[k - 1].load * record.load);
    }
    path.push_back({record.displacement - freed * record.load, record.load});
    if (k > 0) path[k - 1].beyond = energy_beyond(path, records[k - 1], record);
  }
  return path;
}

std::vector<CurvePoint> smooth_envelope(std::span<const CurvePoint> path, std::size_t window) {
  std::vector<CurvePoint> curve;
  for (const Window rows : windows_of(path, window)) {
    if (const auto point = smooth_point(rows)) curve.push_back(*point);
  }
  return curve;
}

std::size_t envelope_window(std::size_t events) { return std::max<std::size_t>(10, events / 120); }

std::vector<CurvePoint> stage_path(std::span<const StepRecord> records) {
  std::vector<CurvePoint> path;
  double compliance = 0.0, dissipated = 0.0, at_row = 0.0;
  for (const StepRecord& record : records) {
    if (path.empty()) {
      compliance = std::abs(record.displacement / record.load);
    } else {
      CurvePoint& last = path.back();
      const double mean = record.load + at_row * (last.load - record.load);
      const double energy = std::max(0.0, record.dissipated_energy - dissipated);
      if (last.load * mean > 0.0) {
        const double softer = 2.0 * energy / (last.load * mean);
        compliance += softer;
        if (at_row > 0.0) last.beyond = energy - 0.5 * last.load * record.load * softer;
      }
    }
    dissipated = record.dissipated_energy;
    at_row = part_at_constant_load(static_cast<double>(record.events));
    path.push_back({compliance * record.load, record.load});
  }
  return path;
}

std::optional<double> smoothed_peak(std::span<const CurvePoint> path) {
  const std::size_t window = envelope_window(path.size());
  if (path.size() <= 2 * window) return std::nullopt;
  PeakWatch peaks;
  double hidden = 0.0;  // largest |load| of windows without a point
  for (const Window events : windows_of(path, window)) {
    if (const auto point = smooth_point(events)) {
      peaks.add(*point);
      continue;
    }
    for (const CurvePoint& row : events) hidden = std::max(hidden, std::abs(row.load));
  }
  const double highest = peaks.highest().load;
  return hidden > std::abs(highest) ? std::nullopt : std::optional(highest);
}

std::size_t rows_before_residual(std::span<const CurvePoint> path, bool bars) {
  PeakWatch watch;
  std::size_t held = 0;  // rows before the body gave way
  for (const CurvePoint& row : path) {
    watch.add(row);
    if (!watch.gave_way()) ++held;
  }
  const std::size_t whole = watch.climbed_again() ? held : path.size();
  return bars ? whole : std::min(whole, rows_before_climb(path));
}

void PeakWatch::add(const CurvePoint& row, bool intact) {
  const double at = std::abs(row.displacement), before = std::abs(last_.displacement);
  if (at > reached_) {
    double lowest = std::abs(row.load);
    if (rows_ == 1) {  // after a snap-back the path returns with a smaller load
      const double share = (reached_ - before) / (at - before);
      lowest = std::min(lowest, std::abs(last_.load + share * (row.load - last_.load)));
    }
    const bool below = !intact && lowest < collapsed_part * std::abs(highest_.load);
    below_ = below ? below_ + 1 : 0;
    if (!gave_way_ && below_ >= rows_) {
      gave_way_ = true;
      first_ = highest_;
    }
    reached_ = at;
  }
  last_ = row;
  if (std::abs(row.load) > std::abs(highest_.load)) highest_ = row;
}

}  // namespace perilink

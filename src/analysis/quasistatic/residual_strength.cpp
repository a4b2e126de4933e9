#include "analysis/quasistatic/residual_strength.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <vector>

namespace perilink {
namespace {

/// Returns the events in tension after which a bond carries less than half of its largest force.
int events_to_crack(const BondLaw& law) {
  const double half = 0.5 * law.segment(0).limit;
  int events = 1;
  for (Segment now = law.segment(1); now.secant > 0.0 && now.secant * now.limit > half; ++events) {
    now = law.segment(events + 1);
  }
  return events;
}

/// Sets of particles joined by cracked bonds, each with the bounding box of the bonds' midpoints.
class Cracks {
 public:
  explicit Cracks(const Network& network)
      : network_(network),
        dim_(static_cast<std::size_t>(network.dim())),
        lower_(network.particles.positions.size(), infinity),
        upper_(network.particles.positions.size(), -infinity),
        parent_(static_cast<std::size_t>(network.particles.size())) {
    std::iota(parent_.begin(), parent_.end(), 0);
    for (std::size_t a = 0; a < dim_; ++a) {
      double least = infinity, most = -infinity;
      for (Index i = 0; i < network.particles.size(); ++i) {
        if (network.particles.material[i] == no_index) continue;
        least = std::min(least, network.particles.position(i)[a]);
        most = std::max(most, network.particles.position(i)[a]);
      }
      extents_.push_back(most - least);
    }
  }

  /// Adds a cracked bond.
  /// \return whether its crack goes through the body
  bool add(Index bond) {
    constexpr double through = 0.8;
    const Index first = network_.bonds.first[bond], second = network_.bonds.second[bond];
    const std::size_t root = root_of(first), other = root_of(second);
    parent_[other] = static_cast<Index>(root);
    std::size_t spans = 0;
    for (std::size_t a = 0; a < dim_; ++a) {
      const double middle =
          0.5 * (network_.particles.position(first)[a] + network_.particles.position(second)[a]);
      double &lower = lower_[root * dim_ + a], &upper = upper_[root * dim_ + a];
      lower = std::min({lower, lower_[other * dim_ + a], middle});
      upper = std::max({upper, upper_[other * dim_ + a], middle});
      spans += upper - lower >= through * extents_[a] ? 1 : 0;
    }
    return spans + 1 >= dim_;
  }

 private:
  std::size_t root_of(Index particle) {
    while (parent_[particle] != particle) {
      particle = parent_[particle] = parent_[parent_[particle]];
    }
    return static_cast<std::size_t>(particle);
  }

  const Network& network_;
  std::size_t dim_;
  std::vector<double> lower_, upper_, extents_;
  std::vector<Index> parent_;
};

/// Returns the row with the largest |load| of the other sign than a peak load. It is absent if no
/// such load exceeds a twentieth of the peak: concrete carries a tenth of its compression in
/// tension, and stages near the capacity swing about zero by less.
std::optional<CurvePoint> largest_against(double peak, std::span<const StepRecord> rows) {
  constexpr double least = 0.05;
  std::optional<CurvePoint> largest;
  double most = least * std::abs(peak);
  for (const StepRecord& row : rows) {
    if (!(row.load * peak < 0.0) || !(std::abs(row.load) > most)) continue;
    most = std::abs(row.load);
    largest = CurvePoint{row.displacement, row.load};
  }
  return largest;
}

CurvePoint highest(std::span<const StepRecord> rows) {
  const auto row = std::max_element(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
    return std::abs(a.load) < std::abs(b.load);
  });
  return {row->displacement, row->load};
}

/// Returns the number of points before the body gave way, if a load beside them is larger.
std::size_t points_before(std::span<const CurvePoint> path, double other) {
  PeakWatch watch;
  std::size_t held = 0;
  for (const CurvePoint& point : path) {
    watch.add(point);
    if (!watch.gave_way()) ++held;
  }
  return other > std::abs(watch.first().load) ? held : path.size();
}

/// Returns the number of rows of a stage before residual strength. Loads of each sign have their
/// own falls. Rows at which no element fails are no part of them: stages that unload the body,
/// reload it or turn its load do not weaken it. A body that gave way may carry a larger load of the
/// other sign, as its cracks close.
std::size_t rows_of_stage_before_residual(std::span<const StepRecord> rows, bool goes_on) {
  std::size_t before = rows.size();
  for (const double sign : {1.0, -1.0}) {
    std::vector<std::size_t> ends;  // number of rows up to that of each point
    // The load of a stage is what the body carries beside permanent loads: near their capacity it
    // jumps about zero while the body has lost nothing. So its growing load case alone is judged at
    // the strain energy of each row. Beside small loads before, the loads of the stage over the
    // displacements that they alone would cause show a loss of strength with that of stiffness.
    std::vector<CurvePoint> equivalent, alone;
    double other = 0.0;  // largest |load| of the other sign
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const StepRecord& row = rows[k];
      const double load = sign * row.load, all = row.equivalent_load;
      other = std::max(other, -load);
      if (row.events == 0 || load < 0.0) continue;
      ends.push_back(k + 1);
      equivalent.push_back({all > 0.0 ? 2.0 * row.strain_energy / all : 0.0, all});
      alone.push_back({all > 0.0 ? 2.0 * row.strain_energy / (all * all) * load : 0.0, load});
    }
    const std::size_t held =
        std::min({rows_before_residual(equivalent, goes_on), rows_before_residual(alone, true),
                  points_before(alone, other)});
    if (held < ends.size()) before = std::min(before, ends[held - 1]);
  }
  return before;
}

}  // namespace

std::size_t rows_before_through_crack(const Network& network, std::span<const StepRecord> rows) {
  if (network.has_sections()) return rows.size();
  std::vector<int> events_of_law;
  for (const BondLaw& law : network.laws) {
    events_of_law.push_back(law.endless() || law.crushes() ? 0 : events_to_crack(law));
  }
  Cracks cracks(network);
  std::unordered_map<Index, int> events;
  const auto runs_through = [&](Index element) {
    if (element == no_index || element >= network.first_slip_spring) return false;
    const Index law = network.law_of.empty() ? 0 : network.law_of[element];
    return ++events[element] == events_of_law[law] && cracks.add(element);
  };
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k].side_change != 0) continue;
    if (runs_through(rows[k].element)) return k + 1;
    if (std::ranges::any_of(rows[k].others, runs_through)) return k + 1;
  }
  return rows.size();
}

void find_peaks(const Network& network, std::span<const StepRecord> rows, DamageResult& result) {
  const bool bars = network.first_slip_spring < network.num_elements();
  const bool stages = !rows.empty() && rows.front().stage > 0;
  const std::vector<CurvePoint> path = stages ? stage_path(rows) : event_path(rows);
  PeakWatch& peaks = result.peaks;
  if (stages) {
    peaks = {};
    for (const StepRecord& row : rows) peaks.add({row.displacement, row.load}, true);
  }
  // Bars carry the load after the solid cracks, and crushing bonds after others split. A beam of
  // brittle bonds may lose its outer bonds before its section fails.
  const bool goes_on =
      bars || network.has_crushing() || std::ranges::all_of(network.laws, &BondLaw::is_brittle);
  std::size_t before =
      stages ? rows_of_stage_before_residual(rows, goes_on) : rows_before_residual(path, goes_on);
  if (before == path.size()) before = rows.size();
  if (!goes_on && !rows.empty()) {
    const std::size_t through = rows_before_through_crack(network, rows);
    const double first = std::abs(highest(rows.first(through)).load);
    if (std::abs(peaks.highest().load) > (1.0 + residual_climb) * first) {
      before = std::min(before, through);
    }
  }
  result.smoothed_peak_load = smoothed_peak(std::span(path).first(std::min(before, path.size())));
  if (before < rows.size()) {
    const CurvePoint first = highest(rows.first(before));
    if (std::abs(first.load) < std::abs(peaks.first().load)) {
      peaks.end_with(first);
      result.broken_as_gave_way = rows[before - 1].broken_bonds;
    }
  }
  const CurvePoint peak = bars ? peaks.highest() : peaks.first();
  result.peak_load = peak.load;
  result.peak_displacement = peak.displacement;
  result.other_peak = largest_against(peak.load, rows.first(bars ? rows.size() : before));
  if (result.smoothed_peak_load.value_or(0.0) * peak.load < 0.0) result.smoothed_peak_load.reset();
}

}  // namespace perilink

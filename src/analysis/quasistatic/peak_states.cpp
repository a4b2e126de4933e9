#include "analysis/quasistatic/peak_states.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace perilink {
namespace {

/// Largest number of states. A first peak is behind one of the deepest falls.
constexpr std::size_t most_states = 8;

/// Returns the part of its load that remained before a larger one came [-].
double part_left(const PeakStates::State& state) { return state.lowest / std::abs(state.row.load); }

}  // namespace

void PeakStates::note_damaged(std::span<const Index> elements) {
  for (const Index e : elements) {
    if (e == no_index || is_damaged_[e] != 0) continue;
    is_damaged_[e] = 1;
    damaged_.push_back(e);
  }
}

void PeakStates::note_all_damaged(Secants secants) {
  for (Index e = 0; e < static_cast<Index>(secants.size()); ++e) {
    if (secants.least(e) < 1.0) note_damaged({&e, 1});
  }
}

void PeakStates::add(const StepRecord& record, StateSource& source, bool by_events) {
  const double load = std::abs(record.load);
  const bool is_higher = load > (states_.empty() ? 0.0 : std::abs(states_.back().row.load));
  const std::vector<Index> failed = std::exchange(failing_, record.others);
  failing_.push_back(record.element);
  if (!is_higher) {
    if (!is_damaged_.empty()) note_damaged(failed);
    if (!states_.empty()) states_.back().lowest = std::min(states_.back().lowest, load);
    return;
  }
  const StepState now = source.unsolved_state();
  if (is_damaged_.empty()) {
    is_damaged_.assign(now.secants.size(), 0);
    for (const Index e : damaged_) is_damaged_[e] = 1;
    note_all_damaged(now.secants);
  } else if (by_events) {
    note_damaged(failed);
  } else {
    note_all_damaged(now.secants);
  }
  const bool fell = !states_.empty() && states_.back().lowest < std::abs(states_.back().row.load);
  if (states_.empty() || fell) states_.emplace_back();
  if (states_.size() > most_states) {
    const auto by_part_left = [](const State& a, const State& b) {
      return part_left(a) < part_left(b);
    };
    states_.erase(std::max_element(states_.begin(), states_.end() - 1, by_part_left));
  }
  State& state = states_.back();
  state.row = record;
  state.displacement.assign(now.displacement.begin(), now.displacement.end());
  state.whole.assign(now.whole.begin(), now.whole.end());
  state.lowest = load;
  state.secants.clear();
  state.axial.clear();
  bool differs = false;
  for (const Index e : damaged_) {
    state.secants.push_back(now.secants[e]);
    state.axial.push_back(now.secants.axial(e));
    differs = differs || state.axial.back() != state.secants.back();
  }
  if (!differs) state.axial.clear();
}

const PeakStates::State* PeakStates::find(const CurvePoint& peak) const {
  const auto found = std::ranges::find_if(states_, [&](const State& state) {
    return std::abs(state.row.load) == std::abs(peak.load) &&
           state.row.displacement == peak.displacement;
  });
  return found == states_.end() ? nullptr : &*found;
}

PeakStates::Ratios PeakStates::ratios(const State& state, Index num_elements) const {
  Ratios ratios;
  const auto filled = [&](const std::vector<double>& of_damaged) {
    std::vector<double> all(static_cast<std::size_t>(num_elements), 1.0);
    for (std::size_t k = 0; k < of_damaged.size(); ++k) all[damaged_[k]] = of_damaged[k];
    return all;
  };
  ratios.secants = filled(state.secants);
  if (!state.axial.empty()) ratios.axial = filled(state.axial);
  return ratios;
}

}  // namespace perilink

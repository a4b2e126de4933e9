#pragma once

#include <cmath>
#include <map>
#include <vector>

#include "analysis/quasistatic/equilibrium/body/element_state.hpp"

/// \file
/// State of a damaged body and its loads, as plain data: what an event engine cannot rebuild.

namespace perilink {

/// Segments of the laws, and the size of batches.
struct EventProgress {
  std::vector<int> segments;  ///< present segment of the law of each element
  /// Largest size of the next batch; size and load factor of the last one.
  double most_at_once = 1.0, last_count = 1.0, last_factor = 0.0;
  double largest_ratio = 0.0;  ///< of all events: stretch over its limit at load factor 1 [-]

  template <class Archive>
  void serialize(Archive& archive) {
    archive(segments, most_at_once, last_count, last_factor, largest_ratio);
  }
};

/// Load factors and permanent motions of the load cases of stages.
struct LoadState {
  /// Displacements at which slots were clamped, shape (particles, width).
  std::vector<double> clamped_at;
  /// Motion of slots by plastic flow, shape (particles, width); empty: none.
  std::vector<double> flowed;
  std::map<Index, double> flow;      ///< per bar element: sum of the absolute plastic strains [-]
  std::vector<double> load_factors;  ///< per load case, while it does not grow
  std::size_t set = 0;               ///< load case that grows
  std::size_t newest = 0;            ///< last load case that has grown
  double load_factor = 0.0;          ///< of the load case that grows
  double direction = 0.0;        ///< sign of the load change towards the next contact state change
  double largest_factor = 0.0;   ///< largest |load factor| of this stage
  double changed_at = 0.0;       ///< load factor of the last contact state change
  double changed_towards = 0.0;  ///< direction of the last contact state change
  /// Successive contact state changes at changed_at; 0: an element has failed since.
  int changes_there = 0;

  /// Returns whether the last contact state change was at this load factor, without an event since.
  bool has_changed_at(double factor) const {
    constexpr double round_off = 1e-12;
    return changes_there > 0 && std::abs(factor - changed_at) <= round_off * largest_factor;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(clamped_at, flowed, flow, load_factors, set, newest, load_factor, direction,
            largest_factor, changed_at, changed_towards, changes_there);
  }
};

/// State of an event engine.
struct BodyState {
  ElementState elements;
  EventProgress progress;
  LoadState loads;  ///< of runs by stages

  template <class Archive>
  void serialize(Archive& archive) {
    archive(elements, progress, loads);
  }
};

}  // namespace perilink

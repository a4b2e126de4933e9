// Bonds that may fall to zero, are dropped, and come back: a part of CalibrationEquations.

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "calibration/calibration_equations.hpp"

namespace perilink {

bool CalibrationEquations::allow_zero(double limit) {
  const std::vector<double> rest = out_of_balance();
  const std::size_t rows = static_cast<std::size_t>(forces_.count());
  const auto unmet = [&](Index i) {
    if (point_of_[i] == no_index) return false;
    const auto forces = rest.begin() + static_cast<std::ptrdiff_t>(i * rows);
    return std::any_of(forces, forces + forces_.odd(), [&](double force) {
      return std::abs(force) * length_[i] > limit * modulus_[i];
    });
  };
  std::vector<std::uint8_t> loose(orbits_ ? orbits_->num_views : floor_.size(), 0);
  for (const Index b : free_bonds_) {
    if (unmet(input_.bonds.first[b]) || unmet(input_.bonds.second[b])) loose[class_of(b)] = 1;
  }
  bool any = false;
  for (const Index b : free_bonds_) {
    if (floor_[b] == Floor::none || !loose[class_of(b)]) continue;
    floor_[b] = Floor::none;
    any = true;
  }
  return any;
}

void CalibrationEquations::drop_vanishing() {
  std::vector<Index> stay;
  for (const Index b : kept_) {
    double& start = start_.stiffness.axial[b];
    if (floor_[b] != Floor::none || stiffness_.axial[b] >= vanishing * start) {
      if (floor_[b] == Floor::none) floor_[b] = Floor::small;
      stay.push_back(b);
      continue;
    }
    start = 0.0;
    if (carries_moments()) start_.stiffness.bending[b] = 0.0;
  }
  kept_ = std::move(stay);
}

auto CalibrationEquations::without_dropped(State state) const -> State {
  for (const Index b : free_bonds_) {
    if (start_.stiffness.axial[b] != 0.0) continue;
    state.stiffness.axial[b] = 0.0;
    if (carries_moments()) state.stiffness.bending[b] = 0.0;
  }
  return state;
}

bool CalibrationEquations::hollow() const {
  std::vector<Index> kept_minus_lost(static_cast<std::size_t>(input_.particles.size()), 0);
  for (Index b = 0; b < input_.bonds.size(); ++b) {
    const Index vote = stiffness_.axial[b] > 0.0 ? 1 : -1;
    for (const Index i : {input_.bonds.first[b], input_.bonds.second[b]})
      kept_minus_lost[i] += vote;
  }
  return std::any_of(particle_of_.begin(), particle_of_.end(),
                     [&](Index i) { return kept_minus_lost[i] < 0; });
}

void CalibrationEquations::take_all_back() {
  start_ = given_;
  kept_ = free_bonds_;
  std::fill(floor_.begin(), floor_.end(), Floor::least_weight);
  start_over();
}

}  // namespace perilink

// Dropping and restoring of bonds that may fall to zero: a part of CalibrationEquations.

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "calibration/bounded_least_squares/equations/variable_parts.hpp"
#include "calibration/calibration_equations.hpp"

namespace perilink {
namespace {

/// Scaled coefficients and right sides below this are zero.
constexpr double nothing = 1e-10;

/// Signs with which weights contribute to an equation; both: no weight is fixed at zero.
enum Signs : std::uint8_t { plus = 1, minus = 2, both = 3 };

std::vector<std::uint8_t> signs_of(const PointEquations& equations) {
  const std::size_t rows = static_cast<std::size_t>(equations.rows);
  std::vector<std::uint8_t> signs(equations.right.size(), 0);
  for (std::size_t k = 0; k < signs.size(); ++k) {
    if (std::abs(equations.right[k] * equations.scale[k]) > nothing) signs[k] = both;
  }
  for (Index v = 0; v < equations.num_variables(); ++v) {
    const bool positive = equations.lower[v] >= 0.0;
    for_each_part(equations, v, [&](Index p, int from, int to, double sign) {
      if (p == no_index) return;
      for (int r = from; r < to; ++r) {
        const double value = sign * equations.coefficients[v * rows + r];
        if (std::abs(value) * equations.scale[p * rows + r] <= nothing) continue;
        signs[p * rows + r] |= !positive ? both : value > 0.0 ? plus : minus;
      }
    });
  }
  return signs;
}

}  // namespace

bool CalibrationEquations::drop_fixed_at_zero() {
  const PointEquations equations = balance();
  const std::size_t rows = static_cast<std::size_t>(equations.rows);
  const std::vector<std::uint8_t> signs = signs_of(equations);
  std::vector<std::uint8_t> zero(orbits_ ? orbits_->num_views : floor_.size(), 0);
  bool any = false;
  for (std::size_t v = 0; v < kept_.size(); ++v) {
    for_each_part(equations, static_cast<Index>(v), [&](Index p, int from, int to, double) {
      if (p == no_index) return;
      for (int r = from; r < to; ++r) {
        const std::uint8_t sign = signs[p * rows + r];
        if (sign != plus && sign != minus) continue;
        const double value = equations.coefficients[v * rows + r] * equations.scale[p * rows + r];
        if (std::abs(value) <= nothing) continue;
        zero[class_of(kept_[v])] = 1;
        any = true;
      }
    });
  }
  if (any) drop([&](Index b) { return zero[class_of(b)] != 0; });
  return any;
}

/// Drops the bonds for which `gone` is true.
template <class Gone>
void CalibrationEquations::drop(Gone gone) {
  std::erase_if(kept_, [&](Index b) {
    if (!gone(b)) return false;
    start_.stiffness.axial[b] = 0.0;
    if (forces_.bending) start_.stiffness.bending[b] = 0.0;
    return true;
  });
}

bool CalibrationEquations::allow_zero(double limit) {
  const std::vector<double> rest = out_of_balance();
  const std::size_t rows = static_cast<std::size_t>(forces_.count());
  const auto unmet = [&](Index i) {
    if (point_of_[i] == no_index) return false;
    const auto forces = rest.begin() + static_cast<std::ptrdiff_t>(i * rows);
    return std::any_of(forces, forces + forces_.odd(), [&](double force) {
      return std::abs(force) * scales_.length[i] > limit * scales_.modulus[i];
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

double CalibrationEquations::drop_zero_weights() {
  drop([&](Index b) {
    if (floor_[b] != Floor::none) return false;
    if (stiffness_.axial[b] < vanishing * start_.stiffness.axial[b]) return true;
    floor_[b] = Floor::small;
    return false;
  });
  const auto free = static_cast<double>(free_bonds_.size());
  return static_cast<double>(num_dropped()) / std::max(free, 1.0);
}

auto CalibrationEquations::without_dropped(State state) const -> State {
  for (const Index b : free_bonds_) {
    if (start_.stiffness.axial[b] != 0.0) continue;
    state.stiffness.axial[b] = 0.0;
    if (forces_.bending) state.stiffness.bending[b] = 0.0;
  }
  return state;
}

bool CalibrationEquations::underconstrained() const {
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

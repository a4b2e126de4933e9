#include "analysis/dynamics/lattice/body/lattice_loads.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace perilink {
namespace {

bool is_driven(const ExplicitModel& model) {
  for (const auto& row : model.prescribed) {
    for (const PrescribedMotion& motion : row) {
      if (motion.amplitude != 0.0) return true;
    }
  }
  return false;
}

}  // namespace

void apply_forces(ExplicitModel& model, const std::vector<AppliedForce>& forces) {
  const auto& rows = model.lattice.rows;
  model.applied.resize(rows.size());
  std::array<double, 3> sum{};
  for (const AppliedForce& force : forces) {
    const auto after =
        std::upper_bound(rows.begin(), rows.end(), force.slot,
                         [](Index slot, const LatticeRow& row) { return slot < row.first; });
    model.applied[after - rows.begin() - 1].push_back(force);
    sum[force.component] += force.value;
  }
  if (is_driven(model)) return;
  const auto largest = std::max_element(
      sum.begin(), sum.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  model.load_component = static_cast<int>(largest - sum.begin());
}

void push(const ExplicitModel& model, Index row, int component, double time, double* speed) {
  const Index first = model.lattice.rows[row].first;
  for (const AppliedForce& force : model.applied[row]) {
    if (force.component != component) continue;
    speed[force.slot - first] += time * model.inverse_mass[force.slot] * force.value;
  }
}

double power(const ExplicitModel& model, Index row, int component, const double* before,
             const double* after) {
  const Index first = model.lattice.rows[row].first;
  double sum = 0.0;
  for (const AppliedForce& force : model.applied[row]) {
    const Index i = force.slot - first;
    if (force.component == component) sum += force.value * (before[i] + after[i]);
  }
  return sum;
}

double loaded_work(const ExplicitModel& model, const ExplicitState& state) {
  double sum = 0.0;
  for (const auto& row : model.applied) {
    for (const AppliedForce& force : row) {
      sum += force.value * state.displacement[model.lattice.at(force.component, force.slot)];
    }
  }
  return sum;
}

}  // namespace perilink

#include "analysis/quasistatic/equilibrium/displacement/field.hpp"

#include <cmath>

#include "assembly/stiffness.hpp"
#include "solver/conjugate_gradients.hpp"

namespace perilink {

void Field::add(double factor, std::span<const double> motion) {
  for (std::size_t k = 0; k < motion.size(); ++k) values[k] += factor * motion[k];
}

void Field::add_ground_spring(Index unknown, double stiffness) {
  ground_load.resize(values.size(), 0.0);
  ground_load[unknown] += stiffness * values[unknown];
}

std::vector<double> Field::forces(const Unknowns& unknowns, const Loads& loads) const {
  std::vector<double> forces = unknowns.restrict(loads.forces);
  for (std::size_t k = 0; k < ground_load.size(); ++k) forces[k] += ground_load[k];
  return forces;
}

std::vector<double> Field::load(const DamagedBody& body, const Unknowns& unknowns,
                                const Loads& loads, double* norm) const {
  constexpr double cancelled = 1e-8;
  double driven = 0.0;
  std::vector<double> load = right_hand_side(unknowns, loads, [&](std::span<const double> u) {
    InternalForce internal = internal_force(body.network(), body.secants(), u);
    driven = std::sqrt(scalar_product(internal.forces, internal.forces));
    return internal;
  });
  for (std::size_t k = 0; k < ground_load.size(); ++k) load[k] += ground_load[k];
  if (norm != nullptr) {
    *norm = std::sqrt(scalar_product(load, load));
    if (*norm <= cancelled * driven) *norm = driven;
  }
  return load;
}

Residual Field::residual(const DamagedBody& body, const Unknowns& unknowns, const Loads& loads,
                         InternalForce& internal) const {
  internal_force(body.network(), body.secants(), displacement, internal);
  std::vector<double> missing(internal.forces.size());
  for (std::size_t slot = 0; slot < missing.size(); ++slot) {
    missing[slot] = loads.forces[slot] - internal.forces[slot];
  }
  Residual result{unknowns.restrict(missing), 0.0, internal.energy};
  for (std::size_t k = 0; k < ground_load.size(); ++k) {
    result.forces[k] += ground_load[k] - body.ground_stiffness()[k] * values[k];
  }
  const double size = std::sqrt(scalar_product(result.forces, result.forces));
  result.size = load_norm == 0.0 ? 0.0 : size / load_norm;
  return result;
}

}  // namespace perilink

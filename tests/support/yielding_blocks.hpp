#pragma once

#include <utility>

#include "support/lattice_models.hpp"
#include "support/lattice_operator.hpp"

/// \file
/// Small lattice bodies that yield.

namespace perilink::testing_support {

inline LatticeMaterial yielding_concrete() {
  LatticeMaterial material = elastic_concrete();
  material.yields = true;
  material.yielding = {22.98e6, 27.58e6, 0.003, 0.0};
  material.crushing_energy = 1e5;
  return material;
}

inline ExplicitModel block(Problem problem, LatticeRules rules = LatticeRules::consistent) {
  if (problem != Problem::three_dimensional) {
    return plane_model(rectangle(0.05, 0.05, 0.01, 23.0), yielding_concrete(), rules, problem);
  }
  LatticeCut cut = rectangle(0.03, 0.03, 0.01, 23.0, 1.0);
  cut.lower[2] = -0.03;
  cut.upper[2] = 0.03;
  return make_explicit_model(problem, rules, face_centred_rows(cut), yielding_concrete(), 1.0);
}

inline void strain_body(const ExplicitModel& model, ExplicitState& state, double xx, double yy,
                        double xy) {
  const LatticeRows& lattice = model.lattice;
  for (const Index slot : lattice.particle_slot) {
    const double x = lattice.positions[slot], y = lattice.positions[lattice.at(1, slot)];
    state.displacement[slot] = xx * x + xy * y;
    state.displacement[lattice.at(1, slot)] = xy * x + yy * y;
  }
  evaluate(model, state);
}

}  // namespace perilink::testing_support

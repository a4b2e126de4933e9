#include "analysis/dynamics/lattice/rows/row_energy.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/lattice_models.hpp"
#include "support/lattice_operator.hpp"

namespace perilink {
namespace {

using namespace testing_support;

/// The energy is proportional to both stretches; without motion in a step they are equal.
class HalfSteps : public testing::TestWithParam<bool> {};

TEST_P(HalfSteps, LieBetweenTheTwoSteps) {
  LatticeMaterial material = elastic_concrete();
  material.breakable = true;
  const ExplicitModel model = plane_model(rectangle(0.05, 0.05, 0.01, 17.0), material);
  const LatticeRows& lattice = model.lattice;
  ExplicitState state(model);
  for (std::size_t r = 0; GetParam() && r < lattice.rows.size(); ++r) {
    if (r % 6 > 2) continue;          // whole rows between
    const bool damaged = r % 6 == 1;  // all bonds of its particles belong to weakened rows
    for (Index at = 0; at < 3 * lattice.rows[r].size; ++at) {
      const Index own = lattice.at(at % 3, lattice.rows[r].first + at / 3);
      state.in_tension[own] *= 0.5 + 0.5 * std::sin(0.7 * own);
      state.in_compression[own] *= 0.8 + 0.2 * std::cos(1.3 * own);
      state.share_tension[own] = 1.0 + 0.5 * std::sin(0.3 * own);
      state.share_compression[own] = 1.0 + 0.2 * std::cos(0.9 * own);
      const Index slot = lattice.rows[r].first + at / 3;
      if (!damaged) continue;
      state.root_tension[slot] = 0.6 + 0.4 * std::sin(1.1 * slot);
      state.root_compression[slot] = 0.8 + 0.2 * std::cos(1.7 * slot);
    }
    state.bond_changes[r] |= BondChanges::altered | BondChanges::weakened;
  }
  const double dt = 1e-7, size = 1e-9;  // so small that stretches are linear in displacements
  for (const Index slot : lattice.particle_slot) {
    for (int c = 0; c < 2; ++c) {
      const double u = size * std::sin(12.9898 * slot + 78.2 * c);
      state.displacement[lattice.at(c, slot)] = u;
      state.velocity[lattice.at(c, slot)] = 0.25 * u / dt;  // three quarters were there before
    }
  }
  const auto rows = static_cast<Index>(lattice.rows.size());
  for (Index r = 0; r < rows; ++r) measure_bonds(model, state, r, dt);
  for (Index r = 0; r < rows; ++r) sum_stretches(model, state, r);
  double stored = 0.0, half_step = 0.0;
  for (Index r = 0; r < rows; ++r) {
    half_step += half_step_energy(model, state, r, dt);
    stored += half_step_energy(model, state, r, 0.0);
  }
  EXPECT_GT(stored, 0.0);
  EXPECT_NEAR(half_step, 0.75 * stored, 1e-6 * stored);  // squares of stretches of 1e-7
}

INSTANTIATE_TEST_SUITE_P(All, HalfSteps, testing::Bool(),
                         [](const auto& half) { return half.param ? "Weakened" : "Whole"; });

}  // namespace
}  // namespace perilink

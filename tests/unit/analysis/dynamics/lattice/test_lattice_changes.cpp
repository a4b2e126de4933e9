#include "analysis/dynamics/lattice/lattice_changes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/lattice_models.hpp"
#include "support/lattice_operator.hpp"

namespace perilink {
namespace {

using namespace testing_support;

LatticeMaterial changing_concrete() {
  LatticeMaterial material = elastic_concrete();
  material.breakable = material.yields = true;
  material.yielding = {22.98e6, 27.58e6, 0.003, 0.0};
  material.crushing_energy = 1e5;
  return material;
}

// Cracks and flow at once: what is lost is counted, and what was brought up to date is what a fresh
// evaluation gives.
TEST(LatticeChanges, EnergyThatIsLostIsCounted) {
  const ExplicitModel model = plane_model(rectangle(0.08, 0.08, 0.01, 11.0), changing_concrete());
  const LatticeRows& lattice = model.lattice;
  const LatticeChanges changes(model);
  ExplicitState state(model);
  for (const Index slot : lattice.particle_slot) {  // pulled above, pushed below
    const double y = lattice.positions[lattice.at(1, slot)];
    state.displacement[lattice.at(1, slot)] = 1e-2 * y * y;
  }
  evaluate(model, state);
  const double before = stored_energy(state);
  change(model, changes, state);
  double fractured = 0.0, plastic = 0.0;
  for (const RowSums& row : state.sums) {
    fractured += row.fractured;
    plastic += row.plastic;
  }
  EXPECT_GT(fractured, 1e-3 * before);
  EXPECT_GT(plastic, 1e-3 * before);
  EXPECT_NEAR(fractured + plastic, before - stored_energy(state), 1e-12 * before);
  const double updated = stored_energy(state);
  evaluate(model, state);
  EXPECT_NEAR(stored_energy(state), updated, 1e-12 * before);
}

/// Flow takes its part with the factors that were there before, damage the rest; in rows where both
/// happen, too.
TEST(LatticeChanges, FlowAndDamageLoseTheirOwnParts) {
  const ExplicitModel model = plane_model(rectangle(0.08, 0.08, 0.01, 11.0), changing_concrete());
  const LatticeRows& lattice = model.lattice;
  const auto rows = static_cast<Index>(lattice.rows.size());
  const LatticeChanges changes(model);
  ExplicitState state(model);
  for (const Index slot : lattice.particle_slot) {  // pulled on the right, pushed on the left
    const double x = lattice.positions[slot], y = lattice.positions[lattice.at(1, slot)];
    state.displacement[lattice.at(1, slot)] = 2e-2 * x * y;
  }
  evaluate(model, state);
  const auto stored_now = [&] {
    double energy = 0.0;
    for (Index r = 0; r < rows; ++r) energy += half_step_energy(model, state, r, 0.0);
    return energy;
  };
  const double before = stored_now();
  for (Index r = 0; r < rows; ++r) changes.look(state, r);
  for (Index r = 0; r < rows; ++r) changes.commit(state, r, 0.0);
  for (Index r = 0; r < rows; ++r) changes.update_plastic_bonds(state, r);
  for (Index r = 0; r < rows; ++r) changes.update_plastic_sums(state, r, 0.0);
  for (Index r = 0; r < rows; ++r) sum_stretches(model, state, r);  // whatever was left stale
  const double flowed = stored_now();
  for (Index r = 0; r < rows; ++r) changes.update_factors(state, r);
  for (Index r = 0; r < rows; ++r) changes.update_sums(state, r, 0.0);
  const double cracked = stored_now();
  double plastic = 0.0, fractured = 0.0;
  int both = 0;
  for (Index r = 0; r < rows; ++r) {
    plastic += state.sums[r].plastic;
    fractured += state.sums[r].fractured;
    both += state.near_changes[r] == (RowChanges::flowed | RowChanges::damage_grew) ? 1 : 0;
  }
  EXPECT_GT(both, 5);
  EXPECT_GT(before - flowed, 1e-3 * before);
  EXPECT_GT(flowed - cracked, 1e-3 * before);
  EXPECT_NEAR(plastic, before - flowed, 1e-12 * before);
  EXPECT_NEAR(fractured, flowed - cracked, 1e-12 * before);
}

TEST(LatticeChanges, EnergyOfCracksInSpaceIsCounted) {
  LatticeCut cut = rectangle(0.03, 0.05, 0.01, 20.0, 1.0);
  cut.lower[2] = -0.03;
  cut.upper[2] = 0.03;
  for (const LatticeRules rules : {LatticeRules::consistent, LatticeRules::mean_2017}) {
    const ExplicitModel model = make_explicit_model(
        Problem::three_dimensional, rules, face_centred_rows(cut), changing_concrete(), 1.0);
    const LatticeRows& lattice = model.lattice;
    const LatticeChanges changes(model);
    ExplicitState state(model);
    for (const Index slot : lattice.particle_slot) {  // three times the strength at the upper end
      const double y = lattice.positions[lattice.at(1, slot)];
      state.displacement[lattice.at(1, slot)] = 3e-3 * (y + 0.05) * (y + 0.05);
    }
    evaluate(model, state);
    const double before = stored_energy(state);
    change(model, changes, state);
    double fractured = 0.0;
    for (const RowSums& row : state.sums) fractured += row.fractured + row.plastic;
    int lower = 0, upper = 0;
    for (const Index slot : lattice.particle_slot) {
      const bool cracked = state.damage[slot] > 0.0;
      (lattice.positions[lattice.at(1, slot)] < -0.042 ? lower : upper) += cracked ? 1 : 0;
    }
    EXPECT_EQ(lower, 0) << "half of the strain at which the stress reaches the strength";
    EXPECT_GT(upper, 50);
    const double updated = stored_energy(state);
    evaluate(model, state);
    EXPECT_NEAR(stored_energy(state), updated, 1e-12 * before);
    if (rules == LatticeRules::mean_2017) continue;  // what they store is no energy
    EXPECT_GT(fractured, 1e-3 * before);
    EXPECT_NEAR(fractured, before - updated, 1e-12 * before);
  }
}

// Along the jagged sides of a column under pressure, the own stresses of outer particles are
// tensile.
TEST(LatticeChanges, SidesOfAPressedColumnDoNotSplit) {
  const ExplicitModel model =
      plane_model(rectangle(0.0776, 0.1658, 0.01, 0.0), changing_concrete());
  const LatticeRows& lattice = model.lattice;
  const LatticeChanges changes(model);
  const LatticeParticles particles(model);
  ExplicitState state(model);
  const double strain = -15e6 / 25e9;  // six times the tensile strength
  double largest = 0.0;
  for (const Index slot : lattice.particle_slot) {
    const double x = lattice.positions[slot], y = lattice.positions[lattice.at(1, slot)];
    state.displacement[slot] = -0.2 * strain * x;
    state.displacement[lattice.at(1, slot)] = strain * y;
  }
  evaluate(model, state);
  for_each_particle(lattice, [&](Index row, Index slot) {
    const SymmetricTensor stress =
        particles.stress(state, particles.neighbourhood(state, row, slot));
    largest = std::max(largest, principal_values(stress, 2).first);
  });
  EXPECT_GT(largest, 2.62e6);
  change(model, changes, state);
  EXPECT_EQ(*std::max_element(state.damage.begin(), state.damage.end()), 0.0);
}

/// Factors follow from damage alone.
TEST(LatticeChanges, RebuildFactorsOfASavedState) {
  const ExplicitModel model = plane_model(rectangle(0.08, 0.08, 0.01, 11.0), changing_concrete());
  const LatticeRows& lattice = model.lattice;
  const LatticeChanges changes(model);
  ExplicitState state(model), restored(model);
  for (const Index slot : lattice.particle_slot) {
    const double y = lattice.positions[lattice.at(1, slot)];
    state.displacement[lattice.at(1, slot)] = 1e-2 * y * y;
  }
  evaluate(model, state);
  change(model, changes, state);
  static_cast<LatticeState&>(restored) = state;
  changes.rebuild(restored);
  EXPECT_GT(*std::max_element(state.damage.begin(), state.damage.end()), 0.0);
  EXPECT_EQ(restored.in_tension, state.in_tension);
  EXPECT_EQ(restored.in_compression, state.in_compression);
  EXPECT_EQ(restored.root_tension, state.root_tension);
  EXPECT_EQ(restored.root_compression, state.root_compression);
  EXPECT_EQ(restored.share_tension, state.share_tension);
  EXPECT_EQ(restored.share_compression, state.share_compression);
  EXPECT_EQ(restored.next_damage, state.next_damage);
}

}  // namespace
}  // namespace perilink

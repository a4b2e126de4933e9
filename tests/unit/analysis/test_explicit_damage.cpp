#include "analysis/explicit_damage.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "material/crack_opening.hpp"
#include "support/lattice_models.hpp"
#include "support/lattice_operator.hpp"

namespace perilink {
namespace {

using namespace testing_support;

/// Strains the whole body uniformly.
void strain_body(const ExplicitModel& model, ExplicitState& state, const PlaneTensor& strain) {
  const LatticeRows& lattice = model.lattice;
  for (const Index slot : lattice.particle_slot) {
    const double x = lattice.positions[slot], y = lattice.positions[lattice.at(1, slot)];
    state.displacement[slot] = strain.xx * x + strain.xy * y;
    state.displacement[lattice.at(1, slot)] = strain.xy * x + strain.yy * y;
  }
  evaluate(model, state);
}

Index row_of(const LatticeRows& lattice, Index slot) {
  Index row = 0;
  while (slot >= lattice.rows[row].first + lattice.rows[row].size) ++row;
  return row;
}

TEST(LatticeDamage, PrincipalValuesDiagonalise) {
  const PlaneTensor tensor{3.0, -1.0, 1.5};
  const PrincipalValues values = principal_values(tensor);
  EXPECT_NEAR(values.first + values.second, 2.0, 1e-14);
  EXPECT_NEAR(values.first * values.second, -3.0 - 2.25, 1e-13);
  const double nx = values.direction[0], ny = values.direction[1];
  EXPECT_NEAR(3.0 * nx + 1.5 * ny, values.first * nx, 1e-14);
  EXPECT_NEAR(1.5 * nx - 1.0 * ny, values.first * ny, 1e-14);
}

TEST(LatticeDamage, StressOfInteriorParticlesIsHookes) {
  const ExplicitModel model = plane_model(rectangle(0.05, 0.05, 0.01, 23.0), elastic_concrete());
  const LatticeDamage damage(model);
  ExplicitState state(model);
  const PlaneTensor strain{2e-6, -7e-7, 5e-7};
  strain_body(model, state, strain);
  const HookeConstants hooke = hooke_constants(Problem::plane_stress, 25e9, 0.2);
  const double trace = strain.xx + strain.yy;
  int interior = 0;
  for (const Index slot : model.lattice.particle_slot) {
    if (model.lattice.bond_count[slot] < 6) continue;
    ++interior;
    const PlaneTensor stress = damage.stress(state, row_of(model.lattice, slot), slot);
    // Linear up to squares of the strain.
    EXPECT_NEAR(stress.xx, hooke.lambda * trace + 2.0 * hooke.mu * strain.xx, 1.0);
    EXPECT_NEAR(stress.yy, hooke.lambda * trace + 2.0 * hooke.mu * strain.yy, 1.0);
    EXPECT_NEAR(stress.xy, 2.0 * hooke.mu * strain.xy, 1.0);
  }
  EXPECT_GT(interior, 20);
}

/// Uniaxial strain state of a stress in y, as a multiple of f_t / E.
PlaneTensor uniaxial(double multiple) {
  const double strain = multiple * 2.62e6 / 25e9;
  return {-0.2 * strain, strain, 0.0};
}

ExplicitModel breakable(LatticeRules rules) {
  LatticeMaterial material = paper_concrete();
  material.breakable = true;
  return plane_model(rectangle(0.05, 0.05, 0.01, 0.0), material, rules);
}

Index middle_slot(const LatticeRows& lattice) {
  for (const Index slot : lattice.particle_slot) {
    if (std::hypot(lattice.positions[slot], lattice.positions[lattice.at(1, slot)]) < 1e-9) {
      return slot;
    }
  }
  return no_index;
}

TEST(LatticeDamage, BeginsAtTheTensileStrength) {
  for (const LatticeRules rules : {LatticeRules::consistent, LatticeRules::least_2018}) {
    const ExplicitModel model = breakable(rules);
    const LatticeDamage damage(model);
    const Index middle = middle_slot(model.lattice);
    for (const double multiple : {0.99, 1.01}) {
      ExplicitState state(model);
      strain_body(model, state, uniaxial(multiple));
      damage.grow(state, 0.0);
      EXPECT_EQ(state.damage[middle] > 0.0, multiple > 1.0);
    }
  }
}

TEST(LatticeDamage, GrowsWithTheOpeningOfTheBand) {
  const ExplicitModel model = breakable(LatticeRules::consistent);
  const LatticeDamage damage(model);
  const Index middle = middle_slot(model.lattice);
  ExplicitState state(model);
  strain_body(model, state, uniaxial(3.0));
  damage.grow(state, 0.0);
  const double e = 25e9, strain = 3.0 * 2.62e6 / e;
  // The crack opens across a row: sqrt(3)/2 of a spacing; stretches are linear up to squares.
  EXPECT_NEAR(state.damage[middle],
              band_damage(model.material.softening, e, strain, 0.5 * std::sqrt(3.0) * 0.01), 1e-4);
}

TEST(LatticeDamage, JumpsAsPrintedByTheRulesOf2018) {
  const ExplicitModel model = breakable(LatticeRules::least_2018);
  const LatticeDamage damage(model);
  const Index middle = middle_slot(model.lattice);
  ExplicitState state(model);
  strain_body(model, state, uniaxial(1.01));
  damage.grow(state, 0.0);
  // Eq. 38 of a uniaxial stress: sqrt(1 + nu + nu^2) times the strain, times one spacing.
  const double crack = std::sqrt(1.24) * 1.01 * 2.62e6 / 25e9;
  const double expected = 1.0 - 2.62e6 * (2e-5 - 0.75 * 0.01 * crack) / (25e9 * 2e-5 * crack);
  EXPECT_NEAR(state.damage[middle], expected, 1e-4);
}

TEST(LatticeDamage, BeginsNowhereUnderLargeLateralCompression) {
  const ExplicitModel model = breakable(LatticeRules::least_2018);
  const LatticeDamage damage(model);
  const Index middle = middle_slot(model.lattice);
  const double strength_strain = 2.62e6 / 25e9;
  for (const double lateral : {-5.0, -7.0}) {  // stress over strength; the ratio is 6
    ExplicitState state(model);
    const double first = 1.05, second = lateral;
    strain_body(
        model, state,
        {(second - 0.2 * first) * strength_strain, (first - 0.2 * second) * strength_strain, 0.0});
    damage.grow(state, 0.0);
    EXPECT_EQ(state.damage[middle] > 0.0, lateral > -6.0) << lateral;
  }
}

TEST(LatticeDamage, StoredEnergyThatIsLostIsCountedAsFractured) {
  const ExplicitModel model = breakable(LatticeRules::consistent);
  const LatticeDamage damage(model);
  ExplicitState state(model);
  strain_body(model, state, uniaxial(2.0));
  const double before = stored_energy(state);
  damage.grow(state, 0.0);
  double fractured = 0.0;
  for (const RowSums& row : state.sums) fractured += row.fractured;
  EXPECT_GT(fractured, 0.01 * before);
  EXPECT_NEAR(fractured, before - stored_energy(state), 1e-12 * before);
  // What was brought up to date is what a fresh evaluation gives.
  const double updated = stored_energy(state);
  evaluate(model, state);
  EXPECT_NEAR(stored_energy(state), updated, 1e-12 * before);
}

}  // namespace
}  // namespace perilink

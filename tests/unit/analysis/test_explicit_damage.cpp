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
void strain_body(const ExplicitModel& model, ExplicitState& state, const SymmetricTensor& strain) {
  const LatticeRows& lattice = model.lattice;
  for (const Index slot : lattice.particle_slot) {
    const double x = lattice.positions[slot], y = lattice.positions[lattice.at(1, slot)];
    state.displacement[slot] = strain[0] * x + strain[3] * y;
    state.displacement[lattice.at(1, slot)] = strain[3] * x + strain[1] * y;
  }
  evaluate(model, state);
}

/// Uniaxial strain state of a stress in y, as a multiple of f_t / E.
SymmetricTensor uniaxial(double multiple) {
  const double strain = multiple * 2.62e6 / 25e9;
  return {-0.2 * strain, strain, 0.0, 0.0, 0.0, 0.0};
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
    const LatticeChanges changes(model);
    const Index middle = middle_slot(model.lattice);
    for (const double multiple : {0.99, 1.01}) {
      ExplicitState state(model);
      strain_body(model, state, uniaxial(multiple));
      change(model, changes, state);
      EXPECT_EQ(state.damage[middle] > 0.0, multiple > 1.0);
    }
  }
}

TEST(LatticeDamage, GrowsWithTheOpeningOfTheBand) {
  const ExplicitModel model = breakable(LatticeRules::consistent);
  const LatticeChanges changes(model);
  const Index middle = middle_slot(model.lattice);
  ExplicitState state(model);
  strain_body(model, state, uniaxial(3.0));
  change(model, changes, state);
  const double e = 25e9, strain = 3.0 * 2.62e6 / e;
  // The crack opens across a row: sqrt(3)/2 of a spacing; stretches are linear up to squares.
  EXPECT_NEAR(state.damage[middle],
              band_damage(model.material.softening, e, strain, 0.5 * std::sqrt(3.0) * 0.01), 1e-4);
}

TEST(LatticeDamage, JumpsAsPrintedByTheRulesOf2018) {
  const ExplicitModel model = breakable(LatticeRules::least_2018);
  const LatticeChanges changes(model);
  const Index middle = middle_slot(model.lattice);
  ExplicitState state(model);
  strain_body(model, state, uniaxial(1.01));
  change(model, changes, state);
  // Eq. 38 of a uniaxial stress: sqrt(1 + nu + nu^2) times the strain, times one spacing.
  const double crack = std::sqrt(1.24) * 1.01 * 2.62e6 / 25e9;
  const double expected = 1.0 - 2.62e6 * (2e-5 - 0.75 * 0.01 * crack) / (25e9 * 2e-5 * crack);
  EXPECT_NEAR(state.damage[middle], expected, 1e-4);
}

TEST(LatticeDamage, BeginsNowhereUnderLargeLateralCompression) {
  const ExplicitModel model = breakable(LatticeRules::least_2018);
  const LatticeChanges changes(model);
  const Index middle = middle_slot(model.lattice);
  const double strength_strain = 2.62e6 / 25e9;
  for (const double lateral : {-5.0, -7.0}) {  // stress over strength; the ratio is 6
    ExplicitState state(model);
    const double first = 1.05, second = lateral;
    strain_body(
        model, state,
        {(second - 0.2 * first) * strength_strain, (first - 0.2 * second) * strength_strain});
    change(model, changes, state);
    EXPECT_EQ(state.damage[middle] > 0.0, lateral > -6.0) << lateral;
  }
}

TEST(LatticeDamage, StoredEnergyThatIsLostIsCountedAsFractured) {
  const ExplicitModel model = breakable(LatticeRules::consistent);
  const LatticeChanges changes(model);
  ExplicitState state(model);
  strain_body(model, state, uniaxial(2.0));
  const double before = stored_energy(state);
  change(model, changes, state);
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

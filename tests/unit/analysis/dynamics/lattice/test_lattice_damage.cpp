#include "analysis/dynamics/lattice/lattice_damage.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "material/crack_opening.hpp"
#include "support/lattice_models.hpp"
#include "support/lattice_operator.hpp"

namespace perilink {
namespace {

using namespace testing_support;

/// Strains the whole body uniformly.
void strain_by(const ExplicitModel& model, ExplicitState& state, const SymmetricTensor& strain) {
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
      strain_by(model, state, uniaxial(multiple));
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
  strain_by(model, state, uniaxial(3.0));
  change(model, changes, state);
  const double e = 25e9, strain = 3.0 * 2.62e6 / e;
  // The crack opens across a row: sqrt(3)/2 of a spacing; stretches are linear up to squares.
  EXPECT_NEAR(state.damage[middle],
              band_damage(model.material.softening, e, strain, 0.5 * std::sqrt(3.0) * 0.01), 1e-4);
}

/// Damages of particles by hand.
void damage_body(const ExplicitModel& model, ExplicitState& state, const std::vector<double>& by) {
  const LatticeParticles particles(model);
  const LatticeDamage damage(model, particles);
  state.damage = by;
  const auto rows = static_cast<Index>(model.lattice.rows.size());
  for (Index r = 0; r < rows; ++r) damage.update_roots(state, r);
  for (Index r = 0; r < rows; ++r) damage.update_factors(state, r);
}

double first_stress(const ExplicitModel& model, const ExplicitState& state, Index slot) {
  const LatticeParticles particles(model);
  for (std::size_t r = 0; r < model.lattice.rows.size(); ++r) {
    const LatticeRow& row = model.lattice.rows[r];
    if (slot < row.first || slot >= row.first + row.size) continue;
    const auto neighbourhood = particles.neighbourhood(state, static_cast<Index>(r), slot);
    return principal_values(particles.stress(state, neighbourhood), model.lattice.dim).first;
  }
  return 0.0;
}

/// Every particle stores 1 - w of what it would store intact, and its stress is that part.
TEST(LatticeDamage, LeavesABodyThatIsDamagedEvenlyThatPartOfItsStressAndEnergy) {
  for (const double ratio : {0.0, 0.2, 0.45}) {
    LatticeMaterial material = paper_concrete();
    material.breakable = true;
    material.poissons_ratio = ratio;
    const ExplicitModel model = plane_model(rectangle(0.05, 0.05, 0.01, 17.0), material);
    const Index middle = middle_slot(model.lattice);
    ExplicitState state(model);
    strain_by(model, state, {1e-5, 3e-5, 0.0, 4e-6, 0.0, 0.0});  // all bonds stretch
    const double stress = first_stress(model, state, middle), energy = stored_energy(state);
    for (const double damage : {0.3, 0.99}) {
      damage_body(model, state, std::vector<double>(state.damage.size(), damage));
      evaluate(model, state);
      EXPECT_NEAR(first_stress(model, state, middle), (1.0 - damage) * stress, 1e-12 * stress);
      EXPECT_NEAR(stored_energy(state), (1.0 - damage) * energy, 1e-12 * energy);
    }
  }
}

/// Under compression it loses the energy of compressive damage: zero below the threshold.
TEST(LatticeDamage, LeavesAPressedBodyWhatDamageInCompressionLeaves) {
  const ExplicitModel model = breakable(LatticeRules::consistent);
  ExplicitState state(model);
  strain_by(model, state, {-1e-5, -3e-5, 0.0, 0.0, 0.0, 0.0});
  const double energy = stored_energy(state);
  for (const double damage : {0.3, 0.9}) {
    damage_body(model, state, std::vector<double>(state.damage.size(), damage));
    evaluate(model, state);
    const double left = 1.0 - compressive_damage(damage, model.material.compressive_threshold);
    EXPECT_EQ(left == 1.0, damage < 0.5);
    EXPECT_NEAR(stored_energy(state), left * energy, 1e-12 * energy);
  }
}

/// A row of damaged particles across which the body is pulled: with halves that stretch by
/// 1 / (1 - w) as much as the others, all bonds between rows carry the same force.
TEST(LatticeDamage, LeavesABandTheStressOfTheBodyAroundIt) {
  const ExplicitModel model = breakable(LatticeRules::consistent);
  const LatticeRows& lattice = model.lattice;
  const double height = 0.5 * std::sqrt(3.0) * lattice.spacing, strain = 1e-9;
  for (const double damage : {0.2, 0.9, 0.999}) {
    ExplicitState state(model);
    std::vector<double> damages(state.damage.size(), 0.0);
    for (const Index slot : lattice.particle_slot) {
      const double y = lattice.positions[lattice.at(1, slot)];
      // Extra opening of half of the row.
      const double more = 0.5 * height * damage / (1.0 - damage);
      const bool in_row = std::abs(y) < 1e-6;
      damages[slot] = in_row ? damage : 0.0;
      state.displacement[lattice.at(1, slot)] =
          strain * (in_row ? y : y + (y > 0.0 ? more : -more));
    }
    damage_body(model, state, damages);
    evaluate(model, state);
    const std::vector<double> force = resultants(model, state);
    const double bond = (model.moduli.own + 4.0 * model.moduli.sum) * 0.75 * strain;
    int inner = 0;
    for (const Index slot : lattice.particle_slot) {
      if (std::hypot(lattice.positions[slot], lattice.positions[lattice.at(1, slot)]) > 0.03) {
        continue;  // sums of particles at faces lack bonds
      }
      // The bar is relative to a bond under the strain in the band.
      EXPECT_NEAR(force[lattice.at(1, slot)], 0.0, 1e-5 * bond);
      EXPECT_NEAR(first_stress(model, state, slot),
                  first_stress(model, state, middle_slot(lattice)), 1e-5 * bond / height);
      ++inner;
    }
    EXPECT_GT(inner, 15);
  }
}

/// The stress across a crack is the law's stress for its opening, for any pressure along it and any
/// direction of rows.
TEST(LatticeDamage, FollowsTheStress) {
  LatticeMaterial material = paper_concrete();
  material.breakable = true;
  const double e = material.youngs_modulus, f = material.softening.strength;
  for (const double degrees : {0.0, 30.0}) {
    const ExplicitModel model = plane_model(rectangle(0.05, 0.05, 0.01, degrees), material);
    const LatticeChanges changes(model);
    const Index middle = middle_slot(model.lattice);
    for (const double lateral : {0.0, -3.0, -5.5}) {
      ExplicitState state(model);
      // Small steps, because damage never shrinks and its own growth changes the stress.
      const double increment = 4e-3;
      for (double pull = 0.99; pull < 2.2; pull += increment) {
        strain_by(model, state,
                  {(lateral - 0.2 * pull) * f / e, (pull - 0.2 * lateral) * f / e, 0.0});
        for (int n = 0; n < 6; ++n) change(model, changes, state);
        const double stress = first_stress(model, state, middle), damage = state.damage[middle];
        const double whole = stress / (1.0 - damage);
        const double law = band_damage(material.softening, e, whole / e, state.crack_band[middle]);
        EXPECT_GT(damage, law - 2.0 * increment) << degrees << ' ' << lateral << ' ' << pull;
        EXPECT_LT(stress, f * (1.0 + increment));
        if (pull > 1.1) continue;  // neighbours may take over later, and it unloads
        EXPECT_NEAR(damage, law, 2.0 * increment) << degrees << ' ' << lateral << ' ' << pull;
      }
      EXPECT_GT(state.damage[middle], 0.02);
    }
  }
}

TEST(LatticeDamage, JumpsAsPrintedByTheRulesOf2018) {
  const ExplicitModel model = breakable(LatticeRules::least_2018);
  const LatticeChanges changes(model);
  const Index middle = middle_slot(model.lattice);
  ExplicitState state(model);
  strain_by(model, state, uniaxial(1.01));
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
    strain_by(model, state,
              {(second - 0.2 * first) * strength_strain, (first - 0.2 * second) * strength_strain});
    change(model, changes, state);
    EXPECT_EQ(state.damage[middle] > 0.0, lateral > -6.0) << lateral;
  }
}

TEST(LatticeDamage, StoredEnergyThatIsLostIsCountedAsFractured) {
  const ExplicitModel model = breakable(LatticeRules::consistent);
  const LatticeChanges changes(model);
  ExplicitState state(model);
  strain_by(model, state, uniaxial(2.0));
  const double before = stored_energy(state);
  change(model, changes, state);
  double fractured = 0.0;
  for (const RowSums& row : state.sums) fractured += row.fractured;
  EXPECT_GT(fractured, 0.01 * before);
  EXPECT_NEAR(fractured, before - stored_energy(state), 1e-12 * before);
  // Updated values equal a fresh evaluation.
  const double updated = stored_energy(state);
  evaluate(model, state);
  EXPECT_NEAR(stored_energy(state), updated, 1e-12 * before);
}

}  // namespace
}  // namespace perilink

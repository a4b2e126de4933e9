#include "material/crack_opening.hpp"

#include <gtest/gtest.h>

namespace perilink {
namespace {

// Nikravesh & Gerstle 2018, Table 1 [N, m].
constexpr CrackOpeningLaw concrete{2.62e6, 0.25, 2e-5, 2e-4, 6.0};
constexpr double youngs_modulus = 25e9;

double band_stress(double strain, double width) {
  return (1.0 - band_damage(concrete, youngs_modulus, strain, width)) * youngs_modulus * strain;
}

TEST(CrackOpening, FractureEnergyIsTheAreaUnderTheLaw) {
  // f_t COD_1 (1 + gamma) / 2 + gamma f_t (COD_c - COD_1) / 2
  EXPECT_NEAR(fracture_energy(concrete), 2.62e6 * (2e-5 * 1.25 + 0.25 * 1.8e-4) / 2.0, 1e-9);
}

TEST(CrackOpening, BeginsAboveTheStrengthWhereNothingPressesTooMuch) {
  const double limit = -6.0 * 2.62e6;
  EXPECT_FALSE(begins_crack(concrete, 2.62e6, 0.0)) << "no more than the strength";
  EXPECT_TRUE(begins_crack(concrete, 2.63e6, limit)) << "not below the limit";
  EXPECT_FALSE(begins_crack(concrete, 2.63e6, 1.01 * limit));
}

TEST(CrackOpening, BandCarriesTheCohesiveStressOfItsOpening) {
  for (const double width : {0.002, 0.00866, 0.02}) {
    for (const double strain : {2e-4, 1e-3, 3e-3, 9e-3}) {
      if (width * strain >= concrete.critical_opening) continue;
      const double stress = band_stress(strain, width);
      const double opening = width * (strain - stress / youngs_modulus);
      const double cohesive = opening < 2e-5 ? 2.62e6 * (1.0 - 0.75 * opening / 2e-5)
                                             : 0.25 * 2.62e6 * (2e-4 - opening) / 1.8e-4;
      EXPECT_NEAR(stress, cohesive, 1e-9 * 2.62e6) << width << " " << strain;
    }
  }
}

TEST(CrackOpening, BandDissipatesTheFractureEnergyWhateverItsWidth) {
  for (const double width : {0.002, 0.01}) {
    const int steps = 200000;
    const double last = concrete.critical_opening / width;
    double work = 0.0;
    for (int k = 0; k < steps; ++k) {
      work += 0.5 * last / steps *
              (band_stress(last * k / steps, width) + band_stress(last * (k + 1) / steps, width));
    }
    // Trapezoids of a piecewise linear curve: wrong only in the intervals of the two kinks.
    EXPECT_NEAR(work * width, fracture_energy(concrete), 1e-6 * fracture_energy(concrete));
  }
}

TEST(CrackOpening, BandIsIntactUpToTheStrengthAndNeverHeals) {
  EXPECT_EQ(band_damage(concrete, youngs_modulus, 0.999 * 2.62e6 / youngs_modulus, 0.01), 0.0);
  EXPECT_EQ(band_damage(concrete, youngs_modulus, 0.02, 0.01), 1.0);
  double before = 0.0;
  for (double strain = 1e-5; strain < 0.03; strain *= 1.01) {
    const double damage = band_damage(concrete, youngs_modulus, strain, 0.01);
    EXPECT_GE(damage, before) << strain;
    before = damage;
  }
}

TEST(CrackOpening, WidestBandFallsVertically) {
  // E COD_1 / (f_t (1 - gamma)), the steeper branch of this law.
  EXPECT_NEAR(max_band_width(concrete, youngs_modulus), 25e9 * 2e-5 / (2.62e6 * 0.75), 1e-12);
}

TEST(CrackOpening, PrintedDamageJumpsAtTheStrengthAndIsContinuousAtTheKnee) {
  const double strain = 2.62e6 / youngs_modulus, width = 0.01;
  // (1 - gamma) COD_0 / COD_1 with COD_0 = L f_t / E
  EXPECT_NEAR(printed_damage(concrete, youngs_modulus, strain, width * strain),
              0.75 * width * strain / 2e-5, 1e-12);
  const double knee = 2e-5 / width;
  EXPECT_NEAR(printed_damage(concrete, youngs_modulus, knee * (1 - 1e-9), 2e-5 * (1 - 1e-9)),
              printed_damage(concrete, youngs_modulus, knee * (1 + 1e-9), 2e-5 * (1 + 1e-9)), 1e-8);
  EXPECT_EQ(printed_damage(concrete, youngs_modulus, 0.02, 2e-4), 1.0);
  EXPECT_EQ(printed_damage(concrete, youngs_modulus, 1e-6, 1e-8), 0.0);  // below the strength
}

TEST(CrackOpening, CompressiveDamageRunsFromTheThresholdToOne) {
  EXPECT_EQ(compressive_damage(0.8, 0.8), 0.0);
  EXPECT_EQ(compressive_damage(1.0, 0.8), 1.0);
  EXPECT_NEAR(compressive_damage(0.81, 0.25), (0.9 - 0.5) / 0.5, 1e-15);
}

TEST(CrackOpening, HalvesOfABondCarryTheSameForceAndShareTheStretch) {
  for (const double w_i : {0.0, 0.3, 0.9}) {
    for (const double w_j : {0.0, 0.5, 1.0}) {
      const double factor = two_spring_factor(w_i, w_j);
      EXPECT_NEAR((1.0 - w_i) * half_bond_share(w_i, w_j), factor, 1e-15);
      EXPECT_NEAR(half_bond_share(w_i, w_j) + half_bond_share(w_j, w_i), 2.0, 1e-15);
    }
  }
  for (const double w : {0.0, 0.3, 0.9, 1.0}) {
    // Evenly damaged, all that a particle stores is weakened by 1 - w, its sum by the root of that.
    EXPECT_NEAR(half_bond_weight(w, w) * half_bond_weight(w, w), 1.0 - w, 1e-15);
    // The weight of an intact half is its share of the stretch, as for any other.
    EXPECT_EQ(half_bond_weight(0.0, w), half_bond_share(0.0, w));
  }
  EXPECT_EQ(two_spring_factor(0.0, 0.0), 1.0);
  EXPECT_EQ(two_spring_factor(1.0, 1.0), 0.0);
  EXPECT_EQ(half_bond_share(1.0, 1.0), 1.0);
}

}  // namespace
}  // namespace perilink

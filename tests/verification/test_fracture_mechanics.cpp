// Closed forms of fracture mechanics against their published values, and the smallest runs of the
// study: a crack under mode I and under mixed mode, and what a long one dissipates.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "measures.hpp"
#include "problems/handbook.hpp"
#include "rows.hpp"

namespace perilink::verification {
namespace {

/// The meshes that a test writes.
class FractureMechanics : public testing::Test {
 protected:
  ~FractureMechanics() override { std::filesystem::remove_all(temporary_folder()); }
};

TEST_F(FractureMechanics, HandbookFactorsAreThePublishedOnes) {
  // Collocation: edge crack 2.11 at 0.4 and 2.83 at 0.5 of the width (Gross & Srawley 1964); centre
  // crack 1.1867 at 0.5 and 1.3033 at 0.6 (Isida 1973). The forms are said to be right to 0.5 %.
  EXPECT_NEAR(edge_crack_factor(0.4), 2.11, 0.005 * 2.11);
  EXPECT_NEAR(edge_crack_factor(0.5), 2.83, 0.005 * 2.83);
  EXPECT_NEAR(centre_crack_factor(0.5), 1.1867, 0.001 * 1.1867);
  EXPECT_NEAR(centre_crack_factor(0.6), 1.3033, 0.001 * 1.3033);
}

TEST_F(FractureMechanics, SlenderCantileversAreThoseOfBeamTheory) {
  // G = 12 P^2 a^2 / (E B^2 H^3) without the rotation at the root of the arms; 3.46 is the root of
  // 12 in the form.
  const double a = 1e4;
  EXPECT_NEAR(double_cantilever_load(7.0, 3.0, 1.0, 1.0, a), std::sqrt(7.0 * 3.0 / 12.0) / a,
              0.002 / a);
}

TEST_F(FractureMechanics, HoopStressTurnsACrackByThePublishedAngles) {
  EXPECT_EQ(hoop_stress_kink(0.0), 0.0);
  EXPECT_NEAR(hoop_stress_kink(45.0 * degree), -53.13 * degree, 1e-4);
  EXPECT_NEAR(hoop_stress_kink(90.0 * degree), -70.53 * degree, 1e-4);  // Erdogan & Sih: 70.5
}

TEST_F(FractureMechanics, EnergyReleaseTurnsACrackFartherThanHoopStress) {
  // Under mode II a kink of 77.3 degrees has no mode II (Amestoy & Leblond 1992).
  EXPECT_NEAR(kinked_factors(90.0 * degree, -77.3 * degree)[1], 0.0, 2e-3);
  EXPECT_NEAR(kinked_factors(0.0, 0.0)[0], 1.0, 1e-12);
  EXPECT_NEAR(energy_release_kink(0.0), 0.0, 1e-4);
  // Small kinks (Cotterell & Rice 1980): K_I' = cos^3(a/2) K_I, K_II' = sin(a/2) cos^2(a/2) K_I.
  const double a = 10.0 * degree;
  EXPECT_NEAR(kinked_factors(0.0, a)[0], std::pow(std::cos(0.5 * a), 3), 1e-3);
  EXPECT_NEAR(kinked_factors(0.0, a)[1], std::sin(0.5 * a) * std::pow(std::cos(0.5 * a), 2), 2e-3);
  // The expansions, derived and evaluated independently a second time.
  EXPECT_NEAR(energy_release_kink(30.0 * degree), -45.4 * degree, 0.1 * degree);
  EXPECT_NEAR(energy_release_kink(60.0 * degree), -64.3 * degree, 0.1 * degree);
  EXPECT_LT(energy_release_kink(90.0 * degree), hoop_stress_kink(90.0 * degree) - 5.0 * degree);
}

/// Five degrees are the bar of the study.
TEST_F(FractureMechanics, CracksTurnTowardsTheLargestHoopStress) {
  Make make;
  make.micropolar = true;
  const Specimen specimen = crack_tip_field(make, 45.0 * degree);
  const Direction direction = direction_of(run_specimen(specimen), specimen.tip);
  EXPECT_NEAR(direction.angle, hoop_stress_kink(45.0 * degree) / degree, 5.0);
}

/// Across the axes of a square lattice with three spacings, and with so many bonds that all
/// directions are nearly equivalent.
TEST_F(FractureMechanics, RowsLeadCracksAstrayLessTheLongerTheHorizon) {
  EXPECT_NEAR(Rows(false, 3.0).energy(0.0), 0.960, 0.001);
  const Rows many(true, 20.0);
  EXPECT_NEAR(many.energy(0.0), 1.0, 0.002);
  for (const double turned : {0.0, 7.0 * degree, 15.0 * degree}) {
    EXPECT_NEAR(many.direction(0.0, turned) / degree, 0.0, 2.0);
    EXPECT_NEAR(many.direction(45.0 * degree, turned), hoop_stress_kink(45.0 * degree),
                2.0 * degree);
  }
  EXPECT_NEAR(Rows(false, 3.0).direction(0.0, 12.0 * degree) / degree, 12.0, 0.2) << "the row";
}

/// The bar of the study, 3 %.
TEST_F(FractureMechanics, LongCracksThatSoftenDissipateTheFractureEnergy) {
  Make make;
  make.softens = true;
  EXPECT_NEAR(energy_of_strip(make).dissipated, 1.0, 0.03);
}

TEST_F(FractureMechanics, TurnedLatticesHaveTheirParticlesInTheRectangle) {
  Make make{{Arrangement::Kind::turned, true, 15.0}};
  const Specimen specimen = crack_tip_field(make, 0.0);
  const Crack crack = run_specimen(specimen);
  const double side = 2.0 * make.radius * make.horizon();
  ASSERT_FALSE(crack.broken.empty());
  for (const Place& place : crack.broken) {
    EXPECT_GT(place[0], 0.0);
    EXPECT_LT(place[0], side);
  }
  EXPECT_NEAR(crack.horizon, make.horizon(), 0.01 * make.horizon());
}

}  // namespace
}  // namespace perilink::verification

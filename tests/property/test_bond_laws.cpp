#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "material/bond_law.hpp"

namespace perilink {
namespace {

/// A law as the tests see it.
struct LawCase {
  std::string name;
  std::function<Tooth(int)> tooth;
  int teeth;       ///< looked at
  bool symmetric;  ///< events in compression too
};

std::vector<LawCase> laws() {
  std::vector<LawCase> all;
  all.push_back({"brittle", [](int k) { return BrittleLaw{2e-4}.tooth(k); }, 2, false});
  all.push_back({"unbreakable", [](int k) { return BrittleLaw{}.tooth(k); }, 1, false});
  for (const double ratio : {1.01, 1.05, 1.5}) {
    const PlateauLaw law{1.7e-3, ratio};
    all.push_back({"plateau", [law](int k) { return law.tooth(k); }, 40, true});
  }
  all.push_back({"elastic_bar", [](int k) { return PlateauLaw{}.tooth(k); }, 1, true});
  return all;
}

/// Stretches about every threshold of a tooth: slack, both signs, just below and above the limit.
std::vector<double> stretches(const Tooth& tooth) {
  const double limit = std::isinf(tooth.limit) ? 1e-3 : tooth.limit;
  return {0.0,
          0.3 * limit,
          -0.3 * limit,
          limit * (1.0 - 1e-9),
          limit * (1.0 + 1e-9),
          -limit * (1.0 - 1e-9),
          -limit * (1.0 + 1e-9)};
}

TEST(BondLaws, ForceIsTheDerivativeOfTheEnergyAndTangentThatOfTheForce) {
  for (const LawCase& law : laws()) {
    for (int k = 0; k < law.teeth; ++k) {
      const Tooth tooth = law.tooth(k);
      for (const double s : stretches(tooth)) {
        // Quadratic energy and linear force on a tooth: central differences are exact but for the
        // cancellation of numbers of the size of the largest stretch.
        const double step = 1e-4;
        const double size = std::abs(s) + step;
        const double force =
            (bond_energy(tooth, s + step) - bond_energy(tooth, s - step)) / (2.0 * step);
        EXPECT_NEAR(force, bond_force(tooth, s), 1e-15 * size * size / step) << law.name << k;
        const double tangent =
            (bond_force(tooth, s + step) - bond_force(tooth, s - step)) / (2.0 * step);
        EXPECT_NEAR(tangent, bond_tangent(tooth, s), 1e-15 * size / step) << law.name << k;
      }
    }
  }
}

TEST(BondLaws, EvaluatingChangesNothing) {
  for (const LawCase& law : laws()) {
    const Tooth before = law.tooth(0);
    static_cast<void>(law.tooth(5));
    const Tooth after = law.tooth(0);
    EXPECT_EQ(before.secant, after.secant);
    EXPECT_EQ(before.limit, after.limit);
  }
}

TEST(BondLaws, SecantsFallAndLimitsRise) {
  for (const LawCase& law : laws()) {
    EXPECT_EQ(law.tooth(0).secant, 1.0);
    for (int k = 1; k < law.teeth; ++k) {
      EXPECT_LT(law.tooth(k).secant, law.tooth(k - 1).secant) << law.name;
      EXPECT_GT(law.tooth(k).limit, law.tooth(k - 1).limit) << law.name;
      EXPECT_GE(law.tooth(k).secant, 0.0);
    }
  }
}

TEST(BrittleLaw, DissipatesItsStoredEnergyAndStaysBroken) {
  const BrittleLaw law{3e-4};
  const Tooth intact = law.tooth(0);
  const Tooth broken = law.tooth(1);
  const double dissipated = 0.5 * (intact.secant - broken.secant) * intact.limit * intact.limit;
  EXPECT_DOUBLE_EQ(dissipated, 0.5 * 3e-4 * 3e-4);
  EXPECT_DOUBLE_EQ(dissipated, bond_energy(intact, 3e-4));
  EXPECT_EQ(bond_force(broken, 1.0), 0.0);
  EXPECT_TRUE(std::isinf(broken.limit));
  EXPECT_EQ(law.tooth(7).secant, 0.0);
}

TEST(PlateauLaw, DissipatesThePlateauToothByTooth) {
  for (const double ratio : {1.01, 1.05, 1.5}) {
    const PlateauLaw law{1.7e-3, ratio};
    double dissipated = 0.0;
    for (int k = 0; k < 60; ++k) {
      const Tooth tooth = law.tooth(k);
      const Tooth next = law.tooth(k + 1);
      dissipated += 0.5 * (tooth.secant - next.secant) * tooth.limit * tooth.limit;
      // The plateau from S_0 = s_y to S_(k+1) = s_y r^(k+1), unloaded along the secant from there:
      // work s_y^2 / 2 + s_y (S - s_y) less the stored s_y S / 2.
      const double end = law.yield_strain * std::pow(ratio, k + 1);
      const double plateau = 0.5 * law.yield_strain * (end - law.yield_strain);
      EXPECT_NEAR(dissipated, plateau, 1e-13 * plateau);  // round-off of 60 terms
    }
  }
}

TEST(PlateauLaw, ForceStaysWithinTheRippleOfTheYieldForce) {
  const PlateauLaw law{1.7e-3, 1.05};
  for (int k = 0; k < 100; ++k) {
    const double peak = bond_force(law.tooth(k), law.tooth(k).limit);
    const double trough = bond_force(law.tooth(k + 1), law.tooth(k).limit);
    EXPECT_NEAR(peak / law.yield_strain, std::sqrt(1.05), 1e-12);
    EXPECT_NEAR(trough / law.yield_strain, 1.0 / std::sqrt(1.05), 1e-12);
  }
}

}  // namespace
}  // namespace perilink

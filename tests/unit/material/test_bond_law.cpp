#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "material/bond_law.hpp"

namespace perilink {
namespace {

struct LawCase {
  std::string name;
  BondLaw law;
  int segments;  ///< looked at
};

std::vector<LawCase> laws() {
  return {{"brittle", BondLaw::brittle(), 2},
          {"three teeth", BondLaw::saw_tooth({{1.0, 1.0}, {0.6, 1.4}, {0.2, 3.0}}), 4},
          {"plateau, fine", BondLaw::plateau(1.01), 40},
          {"plateau", BondLaw::plateau(), 40},
          {"plateau, coarse", BondLaw::plateau(1.5), 40},
          {"both ways", BondLaw::both_ways({{1.0, 1.0}, {0.6, 1.4}, {0.2, 3.0}}, 0.0), 4},
          {"both ways, then a plateau", BondLaw::both_ways({{1.0, 1.0}, {0.6, 1.4}}, 1.1), 40}};
}

TEST(BondLaws, SecantsFallAndLimitsRise) {
  for (const LawCase& of : laws()) {
    EXPECT_EQ(of.law.segment(0).secant, 1.0);
    for (int k = 1; k < of.segments; ++k) {
      EXPECT_LT(of.law.segment(k).secant, of.law.segment(k - 1).secant) << of.name;
      EXPECT_GT(of.law.segment(k).limit, of.law.segment(k - 1).limit) << of.name;
      EXPECT_GE(of.law.segment(k).secant, 0.0);
    }
  }
}

/// Once broken, for good.
TEST(BondLaws, EndWithoutStiffnessOrNever) {
  for (const LawCase& of : laws()) {
    const Segment last = of.law.segment(of.segments + 3);
    EXPECT_EQ(last.secant == 0.0, !of.law.endless()) << of.name;
    EXPECT_EQ(std::isinf(last.limit), !of.law.endless()) << of.name;
  }
  EXPECT_TRUE(BondLaw::brittle().is_brittle());
  EXPECT_FALSE(BondLaw::saw_tooth({{1.0, 1.0}, {0.5, 2.0}}).is_brittle());
  EXPECT_TRUE(BondLaw::saw_tooth({{1.0, 1.5}}).is_brittle());
  EXPECT_FALSE(BondLaw::plateau().is_brittle());
}

TEST(BondLaws, SensesAreTensionButForPlateaus) {
  for (const LawCase& of : laws()) {
    const bool both = of.law.endless() || of.name == "both ways";
    EXPECT_EQ(of.law.sense() == Sense::both, both) << of.name;
  }
}

TEST(BondLaws, CrushByTeethOfTheirOwn) {
  const BondLaw law = BondLaw::saw_tooth({{1.0, 1.1}, {0.5, 2.0}});
  const BondLaw both = law.crushing({{1.0, 1.2}, {0.4, 3.0}}, 10.0, true);
  EXPECT_EQ(both.sense(), Sense::each);
  EXPECT_TRUE(both.crushes() && both.keeps_shear());
  EXPECT_FALSE(law.crushes() || law.keeps_shear());
  EXPECT_FALSE(BondLaw::brittle().crushing({{1.0, 1.0}}, 10.0, false).is_brittle());
  for (int k = 0; k < 4; ++k) EXPECT_EQ(both.segment(k).secant, law.segment(k).secant);
  EXPECT_EQ(both.first_in_compression().limit, 12.0);
  EXPECT_EQ(both.segment(-1).secant, 0.4);
  EXPECT_EQ(both.segment(-1).limit, 30.0);
  EXPECT_EQ(both.segment(-2).secant, 0.0);
  EXPECT_EQ(law.segment(-1).secant, 0.0);
}

TEST(BondLaws, StayOnTheBranchOfTheirFirstEvent) {
  EXPECT_EQ(BondLaw::after(0, false), 1);
  EXPECT_EQ(BondLaw::after(0, true), -1);
  EXPECT_EQ(BondLaw::after(-1, true), -2);
  EXPECT_EQ(BondLaw::after(2, false), 3);
}

TEST(BondLaws, DoNotCrushWhereTheyYieldOrClose) {
  const std::vector<Segment> segments = {{1.0, 1.2}};
  EXPECT_THROW(BondLaw::plateau().crushing(segments, 1.0, true), std::invalid_argument);
  EXPECT_THROW(BondLaw::brittle().closing().crushing(segments, 1.0, true), std::invalid_argument);
  EXPECT_THROW(BondLaw::brittle().crushing(segments, 0.0, true), std::invalid_argument);
  EXPECT_THROW(BondLaw::brittle().crushing({}, 1.0, true), std::invalid_argument);
}

TEST(BondLaws, RefuseTeethThatRise) {
  EXPECT_THROW(BondLaw::saw_tooth({}), std::invalid_argument);
  EXPECT_THROW(BondLaw::saw_tooth({{0.9, 1.0}}), std::invalid_argument);
  EXPECT_THROW(BondLaw::saw_tooth({{1.0, 1.0}, {1.0, 2.0}}), std::invalid_argument);
  EXPECT_THROW(BondLaw::saw_tooth({{1.0, 1.0}, {0.5, 1.0}}), std::invalid_argument);
  EXPECT_THROW(BondLaw::saw_tooth({{1.0, 1.0}, {0.0, 2.0}}), std::invalid_argument);
  EXPECT_THROW(BondLaw::saw_tooth({{1.0, NAN}}), std::invalid_argument);
  EXPECT_THROW(BondLaw::plateau(1.0), std::invalid_argument);
}

TEST(PlateauLaw, DissipatesThePlateauToothByTooth) {
  for (const double ratio : {1.01, 1.05, 1.5}) {
    const BondLaw law = BondLaw::plateau(ratio);
    double dissipated = 0.0;
    for (int k = 0; k < 60; ++k) {
      const Segment segment = law.segment(k);
      const Segment next = law.segment(k + 1);
      dissipated += 0.5 * (segment.secant - next.secant) * segment.limit * segment.limit;
      // The plateau from S_0 = 1 to S_(k+1) = r^(k+1), unloaded along the secant from there: work
      // 1 / 2 + (S - 1) less the stored S / 2.
      const double plateau = 0.5 * (std::pow(ratio, k + 1) - 1.0);
      EXPECT_NEAR(dissipated, plateau, 1e-13 * plateau);  // round-off of 60 terms
    }
  }
}

TEST(PlateauLaw, ForceStaysWithinTheRippleOfTheYieldForce) {
  const BondLaw law = BondLaw::plateau(1.05);
  for (int k = 0; k < 100; ++k) {
    const double limit = law.segment(k).limit;
    EXPECT_NEAR(law.segment(k).secant * limit, std::sqrt(1.05), 1e-12);
    EXPECT_NEAR(law.segment(k + 1).secant * limit, 1.0 / std::sqrt(1.05), 1e-12);
  }
}

}  // namespace
}  // namespace perilink

#include "material/force_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace perilink {
namespace {

/// Returns the energy dissipated by an element of unit stiffness after its first `count` events.
double dissipated(const BondLaw& law, int count) {
  double sum = 0.0;
  for (int k = 0; k < count; ++k) {
    const double fall = law.segment(k).secant - law.segment(k + 1).secant;
    sum += 0.5 * fall * std::pow(law.segment(k).limit, 2);
  }
  return sum;
}

int count_segments(const BondLaw& law) {
  int count = 0;
  while (law.segment(count).secant > 0.0) ++count;
  return count;
}

const ForceCurve hardens{{{1.0, 1.0}, {11.0, 2.0}}, false};
const ForceCurve softens{{{0.5, 2.0}, {2.0, 4.0}, {3.0, 4.0}, {8.0, 0.0}}, false};
const ForceCurve stays{{{0.1, 1.0}, {1.0, 3.0}, {4.0, 1.5}}, true};

TEST(ForceCurve, TeethOfOneThatEndsDissipateItsArea) {
  for (const ForceCurve& curve : {hardens, softens}) {
    for (const double ratio : {1.02, 1.1, 1.5}) {
      const BondLaw law = law_of(curve, ratio);
      const double unit = curve.points[0][0] * curve.points[0][1];
      const double end = curve.points.back()[0];
      EXPECT_NEAR(dissipated(law, count_segments(law)) * unit, curve.area(end),
                  1e-12 * curve.area(end));
      EXPECT_FALSE(law.endless());
      EXPECT_EQ(law.sense(), Sense::both);
    }
  }
}

/// A table whose last force is zero ends there, whoever made it.
TEST(ForceCurve, NothingStaysBehindAForceOfZero) {
  ForceCurve table = softens;
  table.endless = true;
  const BondLaw law = law_of(table, 1.1), expected = law_of(softens, 1.1);
  EXPECT_FALSE(law.endless());
  ASSERT_EQ(count_segments(law), count_segments(expected));
  for (int k = 0; k < count_segments(law); ++k) {
    EXPECT_EQ(law.segment(k).secant, expected.segment(k).secant);
    EXPECT_EQ(law.segment(k).limit, expected.segment(k).limit);
  }
}

/// Where a secant leaves the curve an element has dissipated the area less what it stores.
TEST(ForceCurve, TeethFollowItWithTheirRipple) {
  for (const ForceCurve& curve : {hardens, softens, stays}) {
    const double ratio = 1.05;
    const BondLaw law = law_of(curve, ratio);
    const double x0 = curve.points[0][0], f0 = curve.points[0][1];
    const double most = curve.endless ? 8.0 : 0.8 * curve.points.back()[0];
    for (int k = 0; law.segment(k).secant > 0.0 && law.segment(k).limit * x0 < most; ++k) {
      const double x = law.segment(k).limit * x0;
      const double top = law.segment(k).secant * law.segment(k).limit * f0;
      const double bottom = law.segment(k + 1).secant * law.segment(k).limit * f0;
      EXPECT_LE(curve.force(x), top * 1.0001);
      EXPECT_GE(curve.force(x), bottom * 0.9999);
      EXPECT_LE(top / bottom, ratio * 1.0001);
    }
  }
}

TEST(ForceCurve, OneThatStaysGoesOnAsAPlateau) {
  const double ratio = 1.1;
  const BondLaw law = law_of(stays, ratio);
  ASSERT_TRUE(law.endless());
  for (int k = 80; k < 90; ++k) {
    const Segment now = law.segment(k), next = law.segment(k + 1);
    EXPECT_NEAR(now.secant / next.secant, ratio, 1e-12);
    // The geometric mean of the force above and below is that of the plateau.
    EXPECT_NEAR(now.limit * std::sqrt(now.secant * next.secant), 1.5, 1e-12);
  }
  EXPECT_FALSE(law.is_exhausted(law.segment(40).secant));
  EXPECT_TRUE(law.is_exhausted(law.segment(200).secant));
}

TEST(ForceCurve, APlateauIsThatOfBars) {
  const BondLaw law = law_of({{{2.0, 5.0}}, true}, 1.05);
  for (int k = 0; k < 20; ++k) {
    EXPECT_NEAR(law.segment(k).secant, BondLaw::plateau(1.05).segment(k).secant, 1e-14);
    EXPECT_NEAR(law.segment(k).limit, BondLaw::plateau(1.05).segment(k).limit, 1e-12);
  }
}

TEST(ForceCurve, BreaksAtOnceWhereItEndsWithItsFirstLine) {
  const BondLaw law = law_of({{{2.0, 5.0}}, false}, 1.05);
  EXPECT_EQ(law.segment(0).limit, 1.0);
  EXPECT_EQ(law.segment(1).secant, 0.0);
  EXPECT_FALSE(law.is_brittle()) << "it breaks in compression too";
}

/// Slope 0.1 after the first point (1, 1): force 1 + 0.1 (x - 1). Flow 1.8 comes from x = 3, f =
/// 1.2; the rest begins there.
TEST(ForceCurve, BehindFlowTheRestIsLeft) {
  const ForceCurve rest = curve_behind(hardens, 1.8);
  ASSERT_EQ(rest.points.size(), 2u);
  EXPECT_NEAR(rest.points[0][0], 1.2, 1e-14);
  EXPECT_NEAR(rest.points[0][1], 1.2, 1e-14);
  EXPECT_NEAR(rest.points[1][0], 11.0 - 1.8, 1e-14);
  EXPECT_EQ(rest.points[1][1], 2.0);
  EXPECT_FALSE(rest.endless);
  const ForceCurve flat = curve_behind({{{1.0, 1.0}}, true}, 5.0);
  EXPECT_EQ(flat.points[0][0], 1.0);
  EXPECT_TRUE(flat.endless);
}

TEST(ForceCurve, RefusesWhatIsNone) {
  EXPECT_THROW(check_curve({{}, true}), std::invalid_argument);
  EXPECT_THROW(check_curve({{{1.0, 0.0}}, true}), std::invalid_argument);
  EXPECT_THROW(check_curve({{{1.0, 1.0}, {1.0, 2.0}}, true}), std::invalid_argument);
  EXPECT_THROW(check_curve({{{1.0, 1.0}, {2.0, 3.0}}, true}), std::invalid_argument);
  EXPECT_THROW(check_curve({{{1.0, 1.0}, {2.0, -1.0}}, true}), std::invalid_argument);
  EXPECT_THROW(check_curve({{{1.0, 1.0}, {2.0, 0.0}, {3.0, 0.0}}, true}), std::invalid_argument);
  EXPECT_THROW(law_of(hardens, 1.0), std::invalid_argument);
  EXPECT_NO_THROW(check_curve(softens));
}

}  // namespace
}  // namespace perilink

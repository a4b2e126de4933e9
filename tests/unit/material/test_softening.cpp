#include "material/softening.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace perilink {
namespace {

struct CurveCase {
  const char* name;
  SofteningShape shape;
  double energy;
};

std::ostream& operator<<(std::ostream& out, const CurveCase& curve) {
  return out << curve.name << ", energy " << curve.energy;
}

SofteningShape with_points(std::vector<std::array<double, 2>> points) {
  SofteningShape shape{Softening::points};
  shape.points = std::move(points);
  return shape;
}

std::vector<CurveCase> curves() {
  std::vector<CurveCase> result;
  for (const double energy : {1.02, 1.5, 3.0, 12.0, 80.0}) {
    result.push_back({"linear", {Softening::linear}, energy});
    result.push_back({"bilinear", {Softening::bilinear}, energy});
    result.push_back({"bilinear, knee above the line", {Softening::bilinear, 0.8, 0.5}, energy});
    result.push_back({"exponential", {Softening::exponential}, energy});
    result.push_back({"points", with_points({{0.05, 0.7}, {0.2, 0.3}, {0.6, 0.05}}), energy});
    result.push_back({"points, hollow and round", with_points({{0.3, 0.95}, {0.7, 0.3}}), energy});
  }
  return result;
}

constexpr double overshoots[] = {0.005, 0.05, 0.3, 100.0};

/// Area under a curve by the rule of the midpoint; error of the square of the step and of the
/// step times the jump at the end of exponential curves.
double midpoint_area(const SofteningCurve& curve, double x) {
  constexpr int steps = 200000;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) sum += curve.force((i + 0.5) * x / steps);
  return sum * x / steps;
}

/// Where a secant meets the falling part of a curve: force over stretch falls there. The curve's
/// end where it lies above the curve.
double meeting_point(const SofteningCurve& curve, double secant) {
  double low = 1.0, high = curve.end();
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (curve.force(middle) > secant * middle ? low : high) = middle;
  }
  return low;
}

std::vector<Segment> segments_of(const BondLaw& law) {
  std::vector<Segment> segments;
  for (int k = 0; law.segment(k).secant > 0.0; ++k) segments.push_back(law.segment(k));
  return segments;
}

double dissipated_by_segment(const BondLaw& law, int segment) {
  const Segment now = law.segment(segment);
  return 0.5 * now.limit * now.limit * (now.secant - law.segment(segment + 1).secant);
}

TEST(SofteningCurves, RiseToOneAndFallToZero) {
  for (const CurveCase& each : curves()) {
    const SofteningCurve curve(each.shape, each.energy);
    EXPECT_EQ(curve.force(0.25), 0.25) << each;
    EXPECT_EQ(curve.force(1.0), 1.0) << each;
    EXPECT_EQ(curve.force(curve.end()), 0.0) << each;
    double before = 1.0;
    for (int i = 1; i < 100; ++i) {
      const double force = curve.force(1.0 + 0.01 * i * (curve.end() - 1.0));
      EXPECT_LT(force, before) << each;
      before = force;
    }
  }
}

TEST(SofteningCurves, AreaIsTheIntegralOfTheForce) {
  for (const CurveCase& each : curves()) {
    const SofteningCurve curve(each.shape, each.energy);
    for (const double share : {0.3, 0.7, 0.95}) {
      for (const double x : {share, 1.0 + share * (curve.end() - 1.0)}) {
        EXPECT_NEAR(curve.area(x), midpoint_area(curve, x), 1e-8 * each.energy) << each << x;
      }
    }
    // Twice the area, as the area of the elastic part is one half.
    EXPECT_NEAR(2.0 * curve.area(curve.end()), each.energy, 1e-14 * each.energy) << each;
    EXPECT_EQ(curve.area(2.0 * curve.end()), curve.area(curve.end())) << each;
  }
}

TEST(SofteningCurves, KneesLieWhereTheyWereAskedFor) {
  const SofteningCurve curve({Softening::bilinear, 0.25, 0.15}, 20.0);
  EXPECT_NEAR(curve.force(1.0 + 0.15 * (curve.end() - 1.0)), 0.25, 1e-14);
  EXPECT_NEAR(curve.force(1.0 + 0.575 * (curve.end() - 1.0)), 0.125, 1e-14) << "half way on";
}

TEST(SofteningCurves, GoThroughTheirPoints) {
  const SofteningCurve curve(with_points({{0.05, 0.7}, {0.2, 0.3}, {0.6, 0.3}}), 20.0);
  const auto at = [&](double share) { return curve.force(1.0 + share * (curve.end() - 1.0)); };
  EXPECT_NEAR(at(0.025), 0.85, 1e-14);
  EXPECT_NEAR(at(0.05), 0.7, 1e-14);
  EXPECT_NEAR(at(0.125), 0.5, 1e-14);
  EXPECT_NEAR(at(0.4), 0.3, 1e-14) << "a plateau";
  EXPECT_NEAR(at(0.8), 0.15, 1e-14);
}

TEST(SofteningCurves, OnePointIsAKnee) {
  const SofteningCurve points(with_points({{0.15, 0.25}}), 7.0);
  const SofteningCurve bilinear({Softening::bilinear, 0.25, 0.15}, 7.0);
  for (const double x : {1.2, 1.6, 3.0, 11.0, 20.0}) {
    EXPECT_EQ(points.force(x), bilinear.force(x));
    EXPECT_EQ(points.area(x), bilinear.area(x));
  }
}

TEST(SofteningCurves, ExponentialOnesFallInProportionToThemselves) {
  const SofteningCurve curve({Softening::exponential}, 9.0);
  // 2 G_s / s_0^2 = 1 + 2 w for a decay over w, here 4.
  for (const double x : {1.0, 3.0, 11.0}) {
    EXPECT_NEAR(curve.force(x + 4.0), curve.force(x) / std::exp(1.0), 1e-15);
  }
}

TEST(SofteningCurves, EnergyFollowsFromTheEnd) {
  for (const SofteningShape& shape :
       {SofteningShape{Softening::linear}, SofteningShape{Softening::bilinear},
        SofteningShape{Softening::bilinear, 0.8, 0.5}, with_points({{0.1, 0.4}, {0.5, 0.1}})}) {
    for (const double end : {1.001, 2.0, 70.0}) {
      const double energy = softening_energy(shape, end);
      EXPECT_NEAR(SofteningCurve(shape, energy).end(), end, 1e-12 * end);
    }
  }
}

TEST(SofteningCurves, RefuseToReleaseMoreThanTheyTake) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  for (const double energy : {1.0, 0.5, -2.0, nothing}) {
    EXPECT_THROW(SofteningCurve({Softening::linear}, energy), std::invalid_argument);
  }
  EXPECT_THROW(SofteningCurve({Softening::brittle}, 2.0), std::invalid_argument);
  const SofteningCurve curve({Softening::linear}, 2.0);
  for (const double overshoot : {0.0, -0.1, nothing}) {
    EXPECT_THROW(saw_tooth_of(curve, overshoot), std::invalid_argument);
  }
}

TEST(Segments, DissipateTheEnergyOfTheCurveInSum) {
  for (const CurveCase& each : curves()) {
    const SofteningCurve curve(each.shape, each.energy);
    for (const double overshoot : overshoots) {
      const BondLaw law = saw_tooth_of(curve, overshoot);
      double sum = 0.0;
      for (std::size_t k = 0; k < segments_of(law).size(); ++k) {
        sum += dissipated_by_segment(law, static_cast<int>(k));
      }
      // Round-off of a few hundred terms.
      EXPECT_NEAR(2.0 * sum, each.energy, 1e-12 * each.energy)
          << each << ", overshoot " << overshoot;
    }
  }
}

/// Unloaded from the curve to zero, it has dissipated what lies above the secant.
TEST(Segments, DissipateTheEnergyOfTheCurveOneByOne) {
  for (const CurveCase& each : curves()) {
    const SofteningCurve curve(each.shape, each.energy);
    for (const double overshoot : overshoots) {
      const BondLaw law = saw_tooth_of(curve, overshoot);
      const std::vector<Segment> segments = segments_of(law);
      double sum = 0.0;
      for (std::size_t k = 1; k < segments.size(); ++k) {
        sum += dissipated_by_segment(law, static_cast<int>(k) - 1);
        const double x = meeting_point(curve, segments[k].secant);
        EXPECT_NEAR(sum, curve.area(x) - 0.5 * segments[k].secant * x * x, 1e-11 * each.energy)
            << each << ", overshoot " << overshoot << ", segment " << k;
      }
    }
  }
}

TEST(Segments, AllButTheLastRiseByTheRipple) {
  for (const CurveCase& each : curves()) {
    const SofteningCurve curve(each.shape, each.energy);
    for (const double overshoot : overshoots) {
      const std::vector<Segment> segments = segments_of(saw_tooth_of(curve, overshoot));
      for (std::size_t k = 0; k < segments.size(); ++k) {
        const double rise = segments[k].secant * segments[k].limit - curve.force(segments[k].limit);
        // The ends of segments are halved down to 1e-12 of themselves.
        EXPECT_LT(rise, overshoot * (1.0 + 1e-8)) << each << ", segment " << k;
        if (k + 1 < segments.size()) {
          EXPECT_NEAR(rise, overshoot, 1e-8 * overshoot) << each << ", segment " << k;
        }
      }
    }
  }
}

/// Both of its points lie on one straight piece.
TEST(Segments, EndAtTheGeometricMeanOfTheirPoints) {
  const SofteningCurve curve({Softening::linear}, 15.0);
  const std::vector<Segment> segments = segments_of(saw_tooth_of(curve, 0.05));
  ASSERT_GT(segments.size(), 4U);
  for (std::size_t k = 0; k + 1 < segments.size(); ++k) {
    const double begin = meeting_point(curve, segments[k].secant);
    const double end = meeting_point(curve, segments[k + 1].secant);
    EXPECT_NEAR(segments[k].limit, std::sqrt(begin * end), 1e-11 * end);
  }
}

TEST(Segments, OneAloneBreaksAsABrittleBondOfItsEnergy) {
  for (const CurveCase& each : curves()) {
    const BondLaw law = saw_tooth_of(SofteningCurve(each.shape, each.energy), 100.0);
    EXPECT_TRUE(law.is_brittle()) << each;
    EXPECT_NEAR(law.segment(0).limit, std::sqrt(each.energy), 1e-14 * each.energy) << each;
  }
}

TEST(Segments, AreMoreWhereTheyMayRiseLess) {
  const SofteningCurve curve({Softening::bilinear}, 12.0);
  std::size_t before = 0;
  for (const double overshoot : {1.0, 0.3, 0.1, 0.03, 0.01}) {
    const std::size_t count = segments_of(saw_tooth_of(curve, overshoot)).size();
    EXPECT_GT(count, before);
    before = count;
  }
}

/// The force is constant up to the end; every segment but the last takes what lies between its
/// unloading lines, sqrt(S_k S_(k+1)) its limit, and all together take the area.
/// Up to 1e10 times the elastic energy all curves have secants; where round-off hides their fall
/// the search for these ends by a refusal.
TEST(Segments, EndForLongCurvesToo) {
  for (const Softening kind : {Softening::linear, Softening::bilinear, Softening::exponential}) {
    SofteningShape shape;
    shape.kind = kind;
    const double energy = 1e10;
    double sum = 0.0, last = 1.0;
    for (const Segment& segment :
         segments_of(saw_tooth_of(SofteningCurve(shape, energy), 0.00224))) {
      sum += segment.secant * segment.limit * segment.limit - segment.secant * last * last;
      last = segment.limit;
    }
    EXPECT_NEAR((sum + 1.0) / energy, 1.0, 1e-5);
  }
  SofteningShape shape;
  shape.kind = Softening::exponential;
  EXPECT_THROW(saw_tooth_of(SofteningCurve(shape, 1e22), 0.02), std::invalid_argument);
}

TEST(SofteningCurves, OfConcreteArePlateaus) {
  for (const double end : {1.2, 2.0, 3.0, 20.0}) {
    const SofteningShape shape{Softening::concrete};
    const double energy = softening_energy(shape, end);
    EXPECT_DOUBLE_EQ(energy, 2.0 * end - 1.0);
    const SofteningCurve curve(shape, energy);
    EXPECT_DOUBLE_EQ(curve.end(), end);
    for (const double x : {1.0, 1.1, 0.999 * end}) {
      EXPECT_EQ(curve.force(x), 1.0);
      EXPECT_NEAR(curve.area(x), x - 0.5, 1e-14 * end);
    }
    EXPECT_EQ(curve.force(1.001 * end), 0.0);
    EXPECT_NEAR(curve.area(2.0 * end), end - 0.5, 1e-14 * end);
    for (const double overshoot : overshoots) {
      const BondLaw law = saw_tooth_of(curve, overshoot);
      double sum = 0.0;
      for (int k = 0; law.segment(k).secant > 0.0; ++k) {
        sum += dissipated_by_segment(law, k);
        const Segment now = law.segment(k), next = law.segment(k + 1);
        EXPECT_LE(now.limit, end * (1.0 + 1e-12));
        EXPECT_LT(now.secant * now.limit, 1.0 + overshoot * (1.0 + 1e-6));
        if (next.secant > 0.0) {
          EXPECT_NEAR(now.limit, std::sqrt(1.0 / (now.secant * next.secant)), 1e-12 * end);
        }
      }
      EXPECT_NEAR(sum, end - 0.5, 1e-10 * end) << "end " << end << ", overshoot " << overshoot;
    }
  }
}

}  // namespace
}  // namespace perilink

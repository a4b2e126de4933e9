#include "model/loaded_places.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace perilink {
namespace {

LoadRegion pushed(const std::string& name, const Vector3& force) {
  return {name, force, {}, std::hypot(force[0], force[1], force[2])};
}

double load_of(const std::vector<LoadRegion>& places) { return total_load(places); }

TEST(TotalLoad, IsThatOfOnePlaceAndOfPlacesSideBySideTheirSum) {
  EXPECT_DOUBLE_EQ(load_of({pushed("a", {3.0, 4.0, 0.0})}), 5.0);
  EXPECT_DOUBLE_EQ(load_of({pushed("a", {0.0, -7.0, 0.0}), pushed("b", {0.0, -7.0, 0.0})}), 14.0);
}

TEST(TotalLoad, OfPlatensAgainstOneAnotherIsTheForceOfEach) {
  EXPECT_DOUBLE_EQ(load_of({pushed("a", {0.0, -7.0, 0.0}), pushed("b", {0.0, 7.0, 0.0})}), 7.0);
}

/// 7 from above against 4 from below: supports carry 3, and 7 pass through the body.
TEST(TotalLoad, CountsWhatIsLeftToSupports) {
  EXPECT_DOUBLE_EQ(load_of({pushed("a", {0.0, -7.0, 0.0}), pushed("b", {0.0, 4.0, 0.0})}), 7.0);
}

/// Four faces pressed one by one carry as much as the same pressure in one entry.
TEST(TotalLoad, OfAPlaceInBalanceCountsTheSizesOfItsForces) {
  const double apart = load_of({pushed("a", {7.0, 0.0, 0.0}), pushed("b", {-7.0, 0.0, 0.0}),
                                pushed("c", {0.0, 7.0, 0.0}), pushed("d", {0.0, -7.0, 0.0})});
  EXPECT_DOUBLE_EQ(apart, 14.0);
  EXPECT_DOUBLE_EQ(load_of({{"rim", {1e-12, 0.0, 0.0}, {}, 28.0}}), apart);
}

/// The less a place is out of balance the nearer its load comes to that of one in balance.
TEST(TotalLoad, DoesNotJumpWhereAPlaceComesOutOfBalance) {
  for (const double out : {0.0, 1e-12, 1e-8, 1e-4, 0.1, 14.0}) {
    EXPECT_DOUBLE_EQ(load_of({{"rim", {0.0, out, 0.0}, {}, 28.0}}), 14.0) << out;
    EXPECT_NEAR(load_of({{"rim", {out, 0.0, 0.0}, {}, 28.0}, pushed("top", {0.0, 5.0, 0.0})}), 19.0,
                out);
  }
  EXPECT_DOUBLE_EQ(load_of({{"rim", {0.0, 20.0, 0.0}, {}, 28.0}}), 20.0);
}

TEST(TotalLoad, IsAMomentWhereNothingPushes) {
  EXPECT_DOUBLE_EQ(load_of({{"a", {}, {0.0, 0.0, 6.0}, 0.0}, {"b", {}, {0.0, 0.0, -6.0}, 0.0}}),
                   6.0);
  EXPECT_EQ(load_of({}), 0.0);
}

/// Drives component c from low to high.
PrescribedRegion moved(int c, double low, double high) {
  PrescribedRegion place;
  place.drives[c] = true;
  place.low[c] = low;
  place.high[c] = high;
  return place;
}

constexpr std::array<bool, 6> nothing{};
constexpr std::array<bool, 6> y_held = {false, true};

double motion_of(const std::vector<PrescribedRegion>& places, const std::array<bool, 6>& held) {
  return relative_motion(places, held, 2);
}

TEST(RelativeMotion, OfOnePlaceIsItsDisplacement) {
  EXPECT_DOUBLE_EQ(motion_of({moved(1, -0.2, -0.2)}, y_held), 0.2);
  EXPECT_DOUBLE_EQ(motion_of({moved(1, -0.2, -0.2)}, nothing), 0.2) << "springs or inertia resist";
  PrescribedRegion oblique = moved(0, 3.0, 3.0);
  oblique.drives[1] = true;
  oblique.low[1] = oblique.high[1] = -4.0;
  EXPECT_DOUBLE_EQ(motion_of({oblique}, y_held), 5.0);
}

TEST(RelativeMotion, OfPlatensIsTheirApproach) {
  EXPECT_DOUBLE_EQ(motion_of({moved(1, -0.2, -0.2), moved(1, 0.2, 0.2)}, nothing), 0.4);
  EXPECT_DOUBLE_EQ(motion_of({moved(1, -0.2, -0.2), moved(1, 0.2, 0.2)}, y_held), 0.4);
  EXPECT_DOUBLE_EQ(motion_of({moved(1, -0.2, -0.2), moved(1, 0.0, 0.0)}, nothing), 0.2);
  EXPECT_DOUBLE_EQ(motion_of({moved(1, 1.0, 1.0), moved(1, 3.0, 3.0)}, nothing), 2.0);
}

TEST(RelativeMotion, OfPlacesSideBySideIsThatAgainstWhatIsHeld) {
  EXPECT_DOUBLE_EQ(motion_of({moved(1, -0.2, -0.2), moved(1, -0.2, -0.2)}, y_held), 0.2);
  EXPECT_DOUBLE_EQ(motion_of({moved(1, 0.2, 0.2), moved(1, 0.2, 0.2)}, nothing), 0.2)
      << "a free body that is dragged";
}

TEST(RelativeMotion, AcrossAnotherAxisIsNone) {
  EXPECT_DOUBLE_EQ(motion_of({moved(0, 0.3, 0.3), moved(1, 0.2, 0.2)}, nothing), 0.3);
}

TEST(RelativeMotion, IsARotationWhereNothingIsMoved) {
  EXPECT_DOUBLE_EQ(motion_of({moved(2, 0.1, 0.1)}, nothing), 0.1);
  EXPECT_DOUBLE_EQ(motion_of({moved(2, 0.1, 0.1), moved(1, 0.02, 0.02)}, nothing), 0.02);
  EXPECT_EQ(motion_of({}, nothing), 0.0);
}

TEST(PlaceNamed, IsMadeOnce) {
  std::vector<LoadRegion> places;
  place_named(places, "top").sizes = 1.0;
  place_named(places, "bottom").sizes = 2.0;
  EXPECT_EQ(place_named(places, "top").sizes, 1.0);
  EXPECT_EQ(places.size(), 2u);
}

}  // namespace
}  // namespace perilink

#include "analysis/quasistatic/strain_watch.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// Four particles in a square, every pair bonded, whose right half moves to the left.
struct Pressed {
  Network network = make_square().network;
  std::vector<double> motion = std::vector<double>(8, 0.0);
  double side = 0.0;

  Pressed() {
    const Particles& particles = network.particles;
    for (Index i = 0; i < particles.size(); ++i) {
      side = std::max(side, particles.position(i)[0] - particles.position(0)[0]);
    }
    for (Index i = 0; i < particles.size(); ++i) {
      motion[2 * i] = -(particles.position(i)[0] - particles.position(0)[0]) / side;
    }
  }
};

TEST(StrainWatch, LooksWhereTheMotionHasDoubled) {
  const Pressed body;
  StrainWatch watch;
  EXPECT_TRUE(watch.is_due(3.0)) << "the first one";
  EXPECT_FALSE(watch.is_due(-5.9));
  EXPECT_TRUE(watch.is_due(-6.0));
  EXPECT_FALSE(watch.is_due(6.0));
  watch.restart();
  EXPECT_TRUE(watch.is_due(0.1)) << "other loads";
}

/// A body that softens may move far while its load falls.
TEST(StrainWatch, LooksAtEveryHundredthEvent) {
  const Pressed body;
  StrainWatch watch;
  int looks = 0;
  for (int k = 0; k <= 300; ++k) looks += watch.is_due(1.0);
  EXPECT_EQ(looks, 4);
}

/// Near the limit no event may leap over it.
TEST(StrainWatch, LooksBeforeTheShortestBondIsAtItsLimit) {
  Pressed body;
  for (double& stretch : body.network.critical_stretch) stretch = 1e-3;
  StrainWatch watch;
  const std::vector<double> secants = intact(body.network);
  EXPECT_TRUE(watch.is_due(8.0));
  EXPECT_FALSE(watch.is_beyond(body.network, body.motion, 0.08 * body.side, secants));
  EXPECT_FALSE(watch.is_due(9.9));
  EXPECT_TRUE(watch.is_due(10.1));
  EXPECT_TRUE(watch.is_beyond(body.network, body.motion, 0.101 * body.side, secants));
}

/// Ties of bars slip: that is no strain of the solid.
TEST(StrainWatch, LooksAtBondsOfTheSolidAlone) {
  Pressed body;
  for (double& stretch : body.network.critical_stretch) stretch = 1e-3;
  body.network.first_slip_spring = 0;
  EXPECT_FALSE(StrainWatch().is_beyond(body.network, body.motion, body.side, intact(body.network)));
}

/// Bonds that fail under compression carry no load without limit.
TEST(StrainWatch, LooksAtNoBondThatIsCrushedByItself) {
  Pressed body;
  for (double& stretch : body.network.critical_stretch) stretch = 1e-3;
  body.network.laws.front() = BondLaw::brittle().crushing({{1.0, 1.0}}, 10.0, false);
  ASSERT_TRUE(body.network.law(0).crushes());
  EXPECT_FALSE(StrainWatch().is_beyond(body.network, body.motion, body.side, intact(body.network)));
}

/// One tough material does not lift the limit of the others.
TEST(StrainWatch, EachBondHasItsOwnLimit) {
  Pressed body;
  for (double& stretch : body.network.critical_stretch) stretch = 1e-3;
  body.network.critical_stretch.back() = 0.5;
  const std::vector<double> secants = intact(body.network);
  EXPECT_TRUE(StrainWatch().is_beyond(body.network, body.motion, 0.101 * body.side, secants));
}

TEST(StrainWatch, TellsBondsThatAreShorterByMoreThanATenth) {
  Pressed body;
  for (double& stretch : body.network.critical_stretch) stretch = 1e-3;
  StrainWatch watch;
  const std::vector<double> secants = intact(body.network);
  EXPECT_FALSE(watch.is_beyond(body.network, body.motion, 0.099 * body.side, secants));
  EXPECT_TRUE(watch.is_beyond(body.network, body.motion, 0.101 * body.side, secants));
  EXPECT_FALSE(watch.is_beyond(body.network, body.motion, -0.101 * body.side, secants))
      << "it is pulled";
}

TEST(StrainWatch, LeavesBodiesAloneWhoseBondsBearAsMuch) {
  Pressed body;
  for (double& stretch : body.network.critical_stretch) stretch = 0.02;
  const std::vector<double> secants = intact(body.network);
  EXPECT_FALSE(StrainWatch().is_beyond(body.network, body.motion, 0.199 * body.side, secants));
  EXPECT_TRUE(StrainWatch().is_beyond(body.network, body.motion, 0.201 * body.side, secants));
}

TEST(StrainWatch, LooksAtNoBondThatIsBrokenOrCannotBreak) {
  Pressed body;
  for (double& stretch : body.network.critical_stretch) stretch = 1e-3;
  const std::vector<double> broken(intact(body.network).size(), 0.0);
  EXPECT_FALSE(StrainWatch().is_beyond(body.network, body.motion, body.side, broken));
  EXPECT_TRUE(
      StrainWatch().is_beyond(body.network, body.motion, body.side, {broken, intact(body.network)}))
      << "they are closed";
  for (double& stretch : body.network.critical_stretch) {
    stretch = std::numeric_limits<double>::infinity();
  }
  EXPECT_FALSE(StrainWatch().is_beyond(body.network, body.motion, body.side, intact(body.network)));
}

}  // namespace
}  // namespace perilink

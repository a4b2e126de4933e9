#include "assembly/results/crack_list.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "discretization/bonds.hpp"
#include "support/small_networks.hpp"

namespace perilink {
namespace {

/// A lattice of 25 by 25 particles 0.2 apart, with cracks that cut all bonds across them.
class CrackListTest : public testing::Test {
 protected:
  CrackListTest()
      : network(test::make_network(test::rectangular, 24)),
        neighbourhoods(bonds_of_particles(network.bonds, network.particles.size())),
        secants(static_cast<std::size_t>(network.num_elements()), 1.0),
        motion(static_cast<std::size_t>(network.particles.size()) * 2, 0.0) {}

  /// Breaks the bonds between the two sides of a line x = `at` and moves the particles beyond it.
  /// \param opening  at a height [length]
  void open(double at, const std::function<double(double)>& opening) {
    const auto beyond = [&](Index i) { return network.particles.position(i)[0] > at; };
    for (Index e = 0; e < network.num_elements(); ++e) {
      const double height = 0.5 * (network.particles.position(network.bonds.first[e])[1] +
                                   network.particles.position(network.bonds.second[e])[1]);
      if (beyond(network.bonds.first[e]) != beyond(network.bonds.second[e]) &&
          opening(height) > 0.0) {
        secants[e] = 0.0;
      }
    }
    for (Index i = 0; i < network.particles.size(); ++i) {
      if (beyond(i)) motion[2 * i] += opening(network.particles.position(i)[1]);
    }
  }
  std::vector<GrownCrack> list() const {
    return list_cracks(network, neighbourhoods,
                       crack_openings(network, neighbourhoods, secants, motion), 0.2);
  }

  Network network;
  Csr neighbourhoods;
  std::vector<double> secants, motion;
};

TEST_F(CrackListTest, AnIntactBodyHasNone) { EXPECT_TRUE(list().empty()); }

TEST_F(CrackListTest, CracksAreListedWithPlaceLengthDirectionAndOpeningTheWidestFirst) {
  open(1.3, [](double) { return 0.02; });
  open(3.5, [](double) { return 0.05; });
  const std::vector<GrownCrack> cracks = list();
  ASSERT_EQ(cracks.size(), 2u);
  for (const auto& [number, at, opening] : {std::tuple{0, 3.5, 0.05}, std::tuple{1, 1.3, 0.02}}) {
    const GrownCrack& crack = cracks[static_cast<std::size_t>(number)];
    EXPECT_NEAR(crack.middle[0], at, 1e-9);
    EXPECT_NEAR(crack.middle[1], 2.4, 1e-9);
    EXPECT_NEAR(crack.length, 4.8, 1e-9);
    EXPECT_NEAR(std::abs(crack.normal[0]), 1.0, 1e-9);
    EXPECT_NEAR(crack.largest_opening, opening, 1e-2 * opening);
    EXPECT_NEAR(crack.mean_opening, opening, 1e-2 * opening);
    EXPECT_NEAR(crack.widest_at[0], at, 0.25);
    ASSERT_TRUE(crack.face_opening);
    // At a face the bonds of a particle lie on one side, and their axes turn by a few degrees.
    EXPECT_NEAR(*crack.face_opening, opening, 2e-2 * opening);
    EXPECT_FALSE(crack.bar);
  }
  EXPECT_EQ(cracks[0].bonds, cracks[1].bonds);
}

/// A crack that turns about its tip at mid-height is as wide at the upper face as the face opens.
TEST_F(CrackListTest, ACrackIsWidestAtItsMouth) {
  open(2.5, [](double y) { return std::max(0.0, 0.01 * (y - 2.45)); });
  const std::vector<GrownCrack> cracks = list();
  ASSERT_FALSE(cracks.empty());
  const double mouth = 0.01 * (4.8 - 2.45);
  EXPECT_NEAR(cracks[0].largest_opening, mouth, 0.05 * mouth);
  EXPECT_NEAR(*cracks[0].face_opening, mouth, 0.05 * mouth);
  EXPECT_GT(cracks[0].widest_at[1], 4.5);
  EXPECT_NEAR(cracks[0].length, 4.8 - 2.45, 0.15 * 2.35);
}

TEST_F(CrackListTest, TwoMouthsOfALineThatIsNearlyClosedBetweenThemAreTwoCracks) {
  const auto waist = [](double least) {
    return [least](double y) { return std::max(least, 0.01 * std::abs(y - 2.4)); };
  };
  open(2.5, waist(0.002));
  EXPECT_EQ(list().size(), 2u);
  std::fill(motion.begin(), motion.end(), 0.0);
  open(2.5, waist(0.014));
  EXPECT_EQ(list().size(), 1u);
}

TEST_F(CrackListTest, ACrackInsideHasNoFace) {
  open(2.5, [](double y) { return y > 1.5 && y < 3.3 ? 0.02 : 0.0; });
  const std::vector<GrownCrack> cracks = list();
  ASSERT_FALSE(cracks.empty());
  EXPECT_FALSE(cracks[0].face_opening);
  EXPECT_NEAR(cracks[0].largest_opening, 0.02, 0.002);
}

TEST_F(CrackListTest, PressedFacesAreNoCrack) {
  open(2.5, [](double) { return 0.02; });
  for (double& u : motion) u = -u;
  EXPECT_TRUE(list().empty());
}

}  // namespace
}  // namespace perilink

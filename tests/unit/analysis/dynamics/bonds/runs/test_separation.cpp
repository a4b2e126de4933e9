#include "analysis/dynamics/bonds/runs/separation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// Two rows of six springs in series.
struct Chains {
  explicit Chains(bool driven) : body(make_chains(6, 2, driven, 10.0, INFINITY)) {
    secants = intact(body.network);
  }
  /// Breaks the bonds along x that end right of the given place.
  void cut(double x) {
    const Bonds& bonds = body.network.bonds;
    for (Index e = 0; e < bonds.size(); ++e) {
      const double first = body.network.particles.position(bonds.first[e])[0];
      const double second = body.network.particles.position(bonds.second[e])[0];
      if ((first < x) != (second < x)) secants[e] = 0.0;
    }
  }

  /// Adds a contact spring in the place of the first bond that was cut.
  /// \param secant  1: closed, 0: open
  void touch(double secant) {
    Network& network = body.network;
    const auto across = std::ranges::find(secants, 0.0) - secants.begin();
    const Bonds bonds = network.bonds;
    const auto e = static_cast<Index>(across);
    network.bonds.append(bonds.first[e], bonds.second[e], bonds.length(e), bonds.direction(e));
    network.stiffness.push_back(1.0);
    network.num_contacts = 1;
    network.first_slip_spring = network.first_embedded_slip_spring = network.first_bar_element =
        network.num_elements();
    secants.resize(static_cast<std::size_t>(network.num_elements()));
    secants.back() = secant;
  }

  AnalysisBody body;
  std::vector<double> secants;
};

TEST(Separation, IsDueWhenBondsHaveBroken) {
  const Chains chains(true);
  Separation separation(chains.body);
  EXPECT_TRUE(separation.is_due(0.0)) << "cracks may cut the body from the beginning";
  separation.examine(chains.secants, 0.0, true);
  EXPECT_FALSE(separation.is_due(0.0));
  EXPECT_TRUE(separation.is_due(0.5));
  separation.examine(chains.secants, 0.5, true);
  EXPECT_FALSE(separation.is_due(0.5));
  EXPECT_FALSE(separation.is_due(NAN)) << "of a motion that grows without bound";
}

TEST(Separation, LoadsPullAwayTheEndOfAChain) {
  Chains chains(false);
  Separation separation(chains.body);
  EXPECT_EQ(separation.examine(chains.secants, 0.0, true), "");
  chains.cut(3.5);
  EXPECT_THAT(separation.examine(chains.secants, 1.0, true),
              testing::HasSubstr("pull away the piece of 6 particles at (4, 0)"));
  EXPECT_EQ(separation.examine(chains.secants, 1.0, false), "") << "at a load factor of zero";
  EXPECT_FALSE(separation.is_unstrained());
  chains.body.network.support_stiffness.assign(chains.body.unknowns.number.size(), 1e-3);
  Separation sprung(chains.body);
  EXPECT_EQ(sprung.examine(chains.secants, 1.0, true), "") << "springs hold it";
}

TEST(Separation, DrivenPiecesResistNothing) {
  Chains chains(true);
  Separation separation(chains.body);
  separation.examine(chains.secants, 0.0, true);
  EXPECT_FALSE(separation.is_unstrained());
  chains.cut(3.5);
  EXPECT_EQ(separation.examine(chains.secants, 1.0, true), "");
  EXPECT_TRUE(separation.is_unstrained());
  // Weak springs, which hold the pieces, are not the body.
  chains.body.network.support_stiffness.assign(chains.body.unknowns.number.size(), 1e-9);
  Separation sprung(chains.body);
  sprung.examine(chains.secants, 1.0, true);
  EXPECT_TRUE(sprung.is_unstrained());
}

TEST(Separation, PressedFacesHoldAPiece) {
  Chains chains(false);
  chains.cut(3.5);
  chains.touch(0.0);
  Separation pulled(chains.body);
  EXPECT_TRUE(pulled.follows_contact());
  EXPECT_THAT(pulled.examine(chains.secants, 1.0, true), testing::HasSubstr("pull away the piece"));
  for (double& force : chains.body.loads.forces) force = -force;
  Separation pressed(chains.body);
  EXPECT_EQ(pressed.examine(chains.secants, 1.0, true), "") << "the gap has not closed yet";
}

TEST(Separation, ClosedFacesStrainPieces) {
  Chains chains(true);
  chains.cut(3.5);
  chains.touch(1.0);
  Separation separation(chains.body);
  EXPECT_EQ(separation.examine(chains.secants, 1.0, true), "");
  EXPECT_FALSE(separation.is_unstrained());
  chains.secants.back() = 0.0;
  separation.examine(chains.secants, 1.0, true);
  EXPECT_TRUE(separation.is_unstrained());
}

TEST(Separation, GoesOnAfterTheLastExamination) {
  Chains chains(true);
  Separation separation(chains.body);
  separation.restore(0.5, true);
  EXPECT_EQ(separation.examined(), 0.5);
  EXPECT_FALSE(separation.is_due(0.5));
  EXPECT_TRUE(separation.is_unstrained());
}

}  // namespace
}  // namespace perilink

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "discretization/bonds.hpp"
#include "discretization/lattices/lattice.hpp"
#include "discretization/lattices/make_body.hpp"

namespace perilink {
namespace {

Body square(Surface surface) {
  LatticeInput input;
  input.pattern = Pattern::rectangular;
  input.surface = surface;
  input.spacing = 0.1;
  input.horizon = 0.3;
  input.solid = {{{0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}}};
  input.material = {0};
  return make_body(input);
}

TEST(Bonds, AreSortedUniqueAndWithinTheHorizon) {
  const Body body = square(Surface::ghost);
  const Bonds bonds = make_bonds(body.particles, 0.3);
  ASSERT_GT(bonds.size(), 0);
  for (Index b = 0; b < bonds.size(); ++b) {
    EXPECT_LT(bonds.first[b], bonds.second[b]);
    if (b > 0) {
      EXPECT_LT(std::pair(bonds.first[b - 1], bonds.second[b - 1]),
                std::pair(bonds.first[b], bonds.second[b]));
    }
    EXPECT_LE(bonds.lengths[b], 0.3 * (1.0 + horizon_tolerance));
    EXPECT_EQ(body.particles.kind[bonds.first[b]], ParticleKind::solid);
    const auto from = body.particles.position(bonds.first[b]);
    const auto to = body.particles.position(bonds.second[b]);
    const auto n = bonds.direction(b);
    EXPECT_NEAR(n[0] * n[0] + n[1] * n[1], 1.0, 1e-15);  // round-off
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_NEAR(from[axis] + n[axis] * bonds.lengths[b], to[axis], 1e-15);
    }
  }
}

TEST(Bonds, KeepNeighboursOnTheHorizonInSpiteOfRoundOff) {
  const Body body = square(Surface::none);
  const Bonds bonds = make_bonds(body.particles, 0.3);
  const Csr neighbourhoods = bonds_of_particles(bonds, body.particles.size());
  const auto neighbourhood = interior_neighbourhood(body.lattice, 0.3);
  EXPECT_EQ(neighbourhood.offsets.size(), 28U);
  EXPECT_EQ(neighbourhoods.row(5 * 11 + 5).size(), 28U);
  EXPECT_EQ(neighbourhoods.row(0).size(), 10U);  // a quarter of the disc with its two edges
}

TEST(Bonds, FamiliesListEveryBondAtBothEnds) {
  const Body body = square(Surface::none);
  const Bonds bonds = make_bonds(body.particles, 0.2);
  const Csr neighbourhoods = bonds_of_particles(bonds, body.particles.size());
  EXPECT_EQ(neighbourhoods.values.size(), 2U * bonds.size());
  for (Index i = 0; i < neighbourhoods.rows(); ++i) {
    for (const Index b : neighbourhoods.row(i)) {
      EXPECT_TRUE(bonds.first[b] == i || bonds.second[b] == i);
    }
  }
}

/// Particles at (0, 0), (1, 0), (2, 0) and (0, 1): the third one hangs on a line.
Particles corner() {
  Particles particles;
  particles.positions = {0.0, 0.0, 1.0, 0.0, 2.0, 0.0, 0.0, 1.0};
  particles.volumes = {1.0, 2.0, 3.0, 4.0};
  particles.material = {0, 1, 2, 3};
  particles.kind.assign(4, ParticleKind::solid);
  return particles;
}

TEST(Bonds, TellWhichParticlesTheyHoldLoosely) {
  const Bonds bonds = make_bonds(corner(), 1.5);
  ASSERT_EQ(bonds.size(), 4);  // 0-1, 0-3, 1-2, 1-3
  EXPECT_EQ(loosely_held(bonds, 4), (std::vector<std::uint8_t>{0, 0, 1, 0}));
  EXPECT_EQ(loosely_held(bonds, 4, std::vector<double>{1.0, 1.0, 1.0, 0.0}),
            (std::vector<std::uint8_t>{0, 1, 1, 1}));
}

TEST(Bonds, FollowTheParticlesThatAreKept) {
  Particles particles = corner();
  Bonds bonds = make_bonds(particles, 1.5);
  keep_particles(particles, bonds, std::vector<std::uint8_t>{0, 1, 1, 1});
  EXPECT_EQ(particles.positions, (std::vector<double>{1.0, 0.0, 2.0, 0.0, 0.0, 1.0}));
  EXPECT_EQ(particles.volumes, (std::vector<double>{2.0, 3.0, 4.0}));
  EXPECT_EQ(particles.material, (std::vector<Index>{1, 2, 3}));
  EXPECT_EQ(bonds.first, (std::vector<Index>{0, 0}));
  EXPECT_EQ(bonds.second, (std::vector<Index>{1, 2}));
  EXPECT_EQ(bonds.other_end(1, 0), 2);
  EXPECT_EQ(bonds.other_end(1, 2), 0);
  EXPECT_EQ(keep_bonds(bonds, std::vector<std::uint8_t>{0, 1}), 1);
  EXPECT_EQ(bonds.second, (std::vector<Index>{2}));
}

TEST(Bonds, LeaveOutTheNodesOfBars) {
  Body body = square(Surface::none);
  const Bonds before = make_bonds(body.particles, 0.3);
  body.particles.positions.insert(body.particles.positions.end(), {0.55, 0.55});
  body.particles.volumes.push_back(0.01);
  body.particles.material.push_back(no_index);
  body.particles.kind.push_back(ParticleKind::rebar);
  EXPECT_EQ(make_bonds(body.particles, 0.3).first, before.first);
}

TEST(ConnectedParts, AreNumberedByTheirFirstParticles) {
  Particles particles;
  particles.dim = 2;
  particles.positions = {0, 0, 10, 0, 1, 0, 11, 0, 20, 0, 2, 0};
  Bonds bonds;
  bonds.dim = 2;
  bonds.append(particles, 2, 5);
  bonds.append(particles, 1, 3);
  bonds.append(particles, 0, 2);
  EXPECT_EQ(connected_parts(bonds, 6), (std::vector<Index>{0, 1, 0, 1, 2, 0}));
}

/// Differences of positions of one unit leave some 1e-15 of a length of 0.1.
constexpr double of_round_off = 1e-14;

void expect_alike(const Bonds& shared, const Bonds& single) {
  ASSERT_EQ(shared.first, single.first);
  ASSERT_EQ(shared.second, single.second);
  for (Index b = 0; b < single.size(); ++b) {
    ASSERT_NEAR(shared.length(b), single.length(b), of_round_off);
    for (int a = 0; a < single.dim; ++a) {
      ASSERT_NEAR(shared.direction(b)[a], single.direction(b)[a], of_round_off);
    }
  }
}

TEST(SharedDirections, AreThoseOfAFamily) {
  const Body body = square(Surface::none);
  const Bonds single = make_bonds(body.particles, 0.3);
  Bonds shared = single;
  share_directions(shared);
  EXPECT_EQ(shared.lengths.size(), 14u) << "half of the 28 neighbours";
  EXPECT_EQ(shared.directions.size(), 28u);
  expect_alike(shared, single);
}

TEST(SharedDirections, GoWithTheirBonds) {
  const Body body = square(Surface::none);
  Bonds single = make_bonds(body.particles, 0.3), shared = single;
  share_directions(shared);
  std::vector<std::uint8_t> keep(single.first.size(), 1);
  for (std::size_t b = 0; b < keep.size(); b += 3) keep[b] = 0;
  EXPECT_EQ(keep_bonds(shared, keep), keep_bonds(single, keep));
  const std::vector<double> along = {0.6, 0.8};
  for (Bonds* bonds : {&shared, &single}) bonds->append(3, 5, 0.25, along);
  expect_alike(shared, single);
  const std::size_t kinds = shared.lengths.size();
  share_directions(shared);
  EXPECT_EQ(shared.lengths.size(), kinds) << "once is enough";
}

TEST(SharedDirections, AreNoneWhereBondsDiffer) {
  Bonds bonds;
  for (Index b = 0; b < 3000; ++b) {
    const double angle = 1e-3 * b;
    const std::vector<double> towards = {std::cos(angle), std::sin(angle)};
    bonds.append(b, b + 1, 1.0 + 1e-6 * b, towards);
  }
  const std::vector<double> lengths = bonds.lengths;
  share_directions(bonds);
  EXPECT_TRUE(bonds.kind.empty());
  EXPECT_EQ(bonds.lengths, lengths);
}

TEST(SharedDirections, TellApartWhatIsNearlyTheSame) {
  Bonds bonds;
  const std::vector<double> along = {1.0, 0.0}, beside = {1.0, 1e-11};
  for (Index b = 0; b < 40; ++b) bonds.append(b, b + 1, b % 2 ? 1.0 : 1.0 + 1e-10, along);
  bonds.append(0, 2, 1.0, beside);
  const Bonds single = bonds;
  share_directions(bonds);
  ASSERT_FALSE(bonds.kind.empty());
  for (Index b = 0; b < single.size(); ++b) {
    EXPECT_NEAR(bonds.length(b), single.length(b), 1e-12) << b;
    EXPECT_NEAR(bonds.direction(b)[1], single.direction(b)[1], 1e-12) << b;
  }
}

TEST(SharedDirections, MoreMayComeWhereAllAreGone) {
  const Body body = square(Surface::none);
  Bonds bonds = make_bonds(body.particles, 0.3);
  share_directions(bonds);
  keep_bonds(bonds, std::vector<std::uint8_t>(bonds.first.size(), 0));
  const std::vector<double> along = {0.6, 0.8};
  bonds.append(0, 1, 0.25, along);
  EXPECT_EQ(bonds.length(0), 0.25);
  EXPECT_EQ(bonds.direction(0)[1], 0.8);
}

}  // namespace
}  // namespace perilink

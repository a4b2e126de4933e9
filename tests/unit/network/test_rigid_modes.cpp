#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <numeric>

#include "assembly/stiffness.hpp"
#include "network/rigid_modes.hpp"
#include "support/micropolar_networks.hpp"

namespace perilink {
namespace {

using namespace test;

/// Particles at the given places, solid, with no element yet.
Network particles_at(int dim, std::vector<double> positions) {
  Network network;
  const std::size_t count = positions.size() / static_cast<std::size_t>(dim);
  network.particles.dim = dim;
  network.particles.positions = std::move(positions);
  network.particles.volumes.assign(count, 1.0);
  network.particles.material.assign(count, 0);
  network.particles.kind.assign(count, ParticleKind::solid);
  network.bonds.dim = dim;
  return network;
}

void join(Network& network, Index i, Index j) {
  network.bonds.append(network.particles, i, j);
  network.stiffness.push_back(1.0);
  network.critical_stretch.push_back(1e-3);
}

std::vector<std::uint8_t> nothing_held(const Network& network) {
  return std::vector<std::uint8_t>(network.particles.positions.size(), 0);
}

TEST(Fragments, AreThePartsThatElementsConnect) {
  Network network = particles_at(2, {0, 0, 1, 0, 0, 1, 5, 5, 6, 5, 9, 9});
  join(network, 0, 2);
  join(network, 1, 2);
  join(network, 3, 4);
  join(network, 4, 5);
  network.stiffness.back() = 0.0;  // does not connect
  const auto fragments = find_fragments(network, nothing_held(network));
  ASSERT_EQ(fragments.size(), 3U);
  EXPECT_EQ(fragments[0].particles, (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(fragments[1].particles, (std::vector<Index>{3, 4}));
  EXPECT_EQ(fragments[2].particles, (std::vector<Index>{5}));
  EXPECT_EQ(fragments[0].free_modes, 3);
  EXPECT_EQ(fragments[1].free_modes, 3);
  EXPECT_EQ(fragments[2].free_modes, 2);  // one particle does not rotate
}

/// A body whose lower edge is held along y slides and does not turn.
TEST(Fragments, MoveFreelyAsTheirSupportsLetThem) {
  const Network network = make_network({"", Pattern::rectangular, Surface::none}, 4);
  auto held = nothing_held(network);
  const auto motions = [&] {
    return free_motions(network, find_fragments(network, held).front(), held);
  };
  EXPECT_EQ(motions().size(), 3U);
  for (std::size_t slot = 1; slot < held.size(); slot += 2) {
    held[slot] = network.particles.positions[slot] < 0.01;
  }
  const auto sliding = motions();
  ASSERT_EQ(sliding.size(), 1U);
  const double size = sliding[0][0];
  EXPECT_GT(std::abs(size), 0.1);
  for (std::size_t slot = 0; slot < held.size(); ++slot) {
    EXPECT_NEAR(sliding[0][slot], slot % 2 == 0 ? size : 0.0, 1e-12);
  }
  held[0] = 1;
  EXPECT_TRUE(motions().empty());
}

/// Three displacements along y leave a motion along x open.
TEST(RigidMotion, IsKnownFromPrescribedValues) {
  const Network network = make_network({"", Pattern::rectangular, Surface::none}, 4);
  auto held = nothing_held(network);
  std::vector<double> values(held.size());
  const auto& at = network.particles.positions;
  const auto prescribe = [&](double x, double y, double turn) {
    for (std::size_t slot = 0; slot < held.size(); slot += 2) {
      values[slot] = x - turn * at[slot + 1];
      values[slot + 1] = y + turn * at[slot];
    }
  };
  for (const std::size_t i : {std::size_t{0}, held.size() / 4, held.size() / 2 - 1}) {
    held[2 * i + 1] = 1;
  }
  prescribe(0.2, -0.1, 0.3);
  EXPECT_TRUE(is_rigid_motion(network, held, values));
  held.assign(held.size(), 1);
  EXPECT_TRUE(is_rigid_motion(network, held, values));
  values[held.size() - 1] += 1e-7;
  EXPECT_FALSE(is_rigid_motion(network, held, values));
}

TEST(Fragments, CountTheModesThatSupportsLeaveFree) {
  Network network = make_network({"", Pattern::rectangular, Surface::none}, 4);
  auto held = nothing_held(network);
  const auto free_modes = [&] { return find_fragments(network, held).front().free_modes; };
  EXPECT_EQ(free_modes(), 3);
  held[0] = 1;  // x of the corner
  EXPECT_EQ(free_modes(), 2);
  held[2 * 4] = 1;  // x of the other corner of the same row: the same mode
  EXPECT_EQ(free_modes(), 2);
  held[2 * 20] = 1;  // x of a corner of the top row stops the rotation
  EXPECT_EQ(free_modes(), 1);
  held[1] = 1;
  EXPECT_EQ(free_modes(), 0);
}

TEST(Fragments, TwoNeighboursHoldALongBody) {
  // The lever is a thousandth of the body.
  std::vector<double> positions;
  for (int n = 0; n <= 1000; ++n) positions.insert(positions.end(), {double(n), 0.1 * (n % 2)});
  Network network = particles_at(2, positions);
  for (Index n = 0; n < 1000; ++n) join(network, n, n + 1);
  auto held = nothing_held(network);
  held[0] = held[1] = held[3] = 1;
  EXPECT_EQ(find_fragments(network, held).front().free_modes, 0);
}

TEST(Fragments, InThreeDimensions) {
  Network network = make_network({"", Pattern::cubic, Surface::none}, 3);
  auto held = nothing_held(network);
  EXPECT_EQ(find_fragments(network, held).front().free_modes, 6);
  held[0] = held[1] = held[2] = 1;
  EXPECT_EQ(find_fragments(network, held).front().free_modes, 3);
  Network rod = particles_at(3, {0, 0, 0, 1, 1, 1, 2, 2, 2});
  join(rod, 0, 1);
  join(rod, 1, 2);
  // A straight rod does not rotate about itself.
  EXPECT_EQ(find_fragments(rod, nothing_held(rod)).front().free_modes, 5);
}

class Pinning : public testing::TestWithParam<LatticeCase> {};

TEST_P(Pinning, LeavesAPositiveDefiniteStiffnessWithTheFewestUnknownsHeld) {
  const Network network = make_network(GetParam(), 3);
  auto held = nothing_held(network);
  pin_rigid_modes(network, find_fragments(network, held).front(), held);
  EXPECT_EQ(std::accumulate(held.begin(), held.end(), 0), network.dim() == 2 ? 3 : 6);
  EXPECT_EQ(find_fragments(network, held).front().free_modes, 0);
  const std::vector<double> secants(static_cast<std::size_t>(network.num_elements()), 1.0);
  const Unknowns unknowns =
      number_unknowns(network.dim(), held, std::vector<double>(held.size(), 0.0));
  const Eigen::MatrixXd lower(assemble_stiffness(network, secants, unknowns));
  const Eigen::VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(lower).eigenvalues();
  EXPECT_GT(eigenvalues[0], 1e-6 * eigenvalues[eigenvalues.size() - 1]);
}

INSTANTIATE_TEST_SUITE_P(
    Lattices, Pinning,
    testing::Values(LatticeCase{"hexagonal", Pattern::hexagonal, Surface::none},
                    LatticeCase{"cubic", Pattern::cubic, Surface::none},
                    LatticeCase{"face_centred", Pattern::face_centred, Surface::none}),
    [](const auto& tested) { return tested.param.name; });

TEST(Pinning, CompletesSupportsAndPrefersUnbreakableParticles) {
  Network network = make_network({"", Pattern::rectangular, Surface::none}, 6);
  // The two top rows cannot break.
  const double top = network.particles.positions.back();
  for (Index b = 0; b < network.num_elements(); ++b) {
    for (const Index end : {network.bonds.first[b], network.bonds.second[b]}) {
      if (network.particles.position(end)[1] > top - 0.3) {
        network.critical_stretch[b] = std::numeric_limits<double>::infinity();
      }
    }
  }
  auto held = nothing_held(network);
  held[0] = 1;
  pin_rigid_modes(network, find_fragments(network, held).front(), held);
  EXPECT_EQ(std::accumulate(held.begin(), held.end(), 0), 3);
  for (std::size_t slot = 1; slot < held.size(); ++slot) {
    if (held[slot]) {
      EXPECT_GT(network.particles.position(static_cast<Index>(slot / 2))[1], top - 0.3);
    }
  }
}

TEST(LoadResultant, SumsForcesAndMoments) {
  const Network plane = particles_at(2, {0, 0, 2, 0});
  const LoadResultant couple = load_resultant(plane, {{0, 3, 0, -3}});
  EXPECT_EQ(couple.force, (std::vector<double>{0, 0}));
  EXPECT_EQ(couple.moment, (std::vector<double>{-6}));
  EXPECT_EQ(couple.scale, 6.0);
  const Network space = particles_at(3, {0, 0, 0, 0, 2, 0});
  const LoadResultant pull = load_resultant(space, {{0, 0, 0, 0, 0, 5}});
  EXPECT_EQ(pull.force, (std::vector<double>{0, 0, 5}));
  EXPECT_EQ(pull.moment, (std::vector<double>{5, 0, 0}));  // arm 1 from the centroid
}

/// Micropolar bonds along a line in space: displacements do not see the rotation about it.
TEST(Pinning, OfALineOfFramesTakesOneRotation) {
  Network rod = particles_at(3, {0, 0, 0, 1, 1, 1, 2, 2, 2});
  join(rod, 0, 1);
  join(rod, 1, 2);
  rod.bending = {1.0, 1.0};
  std::vector<std::uint8_t> held(18, 0);
  const auto fragments = find_fragments(rod, held);
  EXPECT_EQ(fragments.front().free_modes, 6);
  pin_rigid_modes(rod, fragments.front(), held);
  int rotations = 0;
  for (std::size_t slot = 0; slot < held.size(); ++slot) rotations += slot % 6 >= 3 && held[slot];
  EXPECT_EQ(std::accumulate(held.begin(), held.end(), 0), 6);
  EXPECT_EQ(rotations, 1);
  EXPECT_EQ(find_fragments(rod, held).front().free_modes, 0);
}

TEST(Fragments, AHeldRotationOfAFrameHoldsTheBodyAndThatOfAnIdleParticleDoesNot) {
  Network network = particles_at(2, {0, 0, 1, 0, 1, 1});
  join(network, 0, 1);
  join(network, 1, 2);
  join(network, 0, 2);
  network.bending = {1.0, 0.0, 0.0};  // a frame and two trusses: particle 2 does not rotate
  std::vector<std::uint8_t> held(9, 0);
  held[0] = held[1] = held[8] = 1;
  EXPECT_EQ(find_fragments(network, held).front().free_modes, 1);
  held[5] = 1;
  EXPECT_EQ(find_fragments(network, held).front().free_modes, 0);
}

TEST(Fragments, ElasticSupportsHoldModes) {
  Network network = make_network({"", Pattern::rectangular, Surface::none}, 3);
  const std::size_t slots = network.particles.positions.size();
  const std::vector<std::uint8_t> held(slots, 0);
  network.support_stiffness.assign(slots, 0.0);
  EXPECT_EQ(find_fragments(network, held)[0].free_modes, 3);
  network.support_stiffness[1] = 1e-3;
  EXPECT_EQ(find_fragments(network, held)[0].free_modes, 2);
  network.support_stiffness[0] = network.support_stiffness[slots - 1] = 5.0;
  EXPECT_EQ(find_fragments(network, held)[0].free_modes, 0);
}

}  // namespace
}  // namespace perilink

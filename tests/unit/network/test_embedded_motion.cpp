#include "network/embedded_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace perilink {
namespace {

/// Nine by five particles one apart, in two bilinear elements of four; the left column is held
/// along x.
struct TwoElements {
  explicit TwoElements(int held_rows = 5, double driven = 0.0, int rows = 5) {
    particles.dim = 2;
    std::vector<std::uint8_t> held;
    std::vector<double> prescribed;
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < 9; ++x) {
        particles.positions.insert(particles.positions.end(), {1.0 * x, 1.0 * y});
        particles.volumes.push_back(1.0);
        particles.kind.push_back(ParticleKind::solid);
        held.insert(held.end(), {x == 0 && y < held_rows, 0});
        prescribed.insert(prescribed.end(), {x == 0 && y < held_rows ? driven : 0.0, 0.0});
      }
    }
    body.hosts = hosts_on_grid(particles, {}, {{{0, 4, 8}, {0, 4}, {}}}, 1, 1e-6);
    body.free = number_unknowns(2, held, prescribed);
    body.whole = fit_supports(body.hosts, body.free);
  }

  Particles particles;
  EmbeddedBody body;
};

TEST(EmbeddedMotion, NodesMoveParticlesAndSupportsHoldNodes) {
  const TwoElements two;
  EXPECT_EQ(two.body.whole, (std::vector<std::uint8_t>{1, 1}));
  const Unknowns motion = embedded_motion(two.body.hosts, two.body.free, two.body.whole);
  EXPECT_EQ(motion.count, 2 * 6 - 2) << "two nodes are held along x";
  EXPECT_TRUE(motion.carries());
  EXPECT_EQ(motion.at(0, 0), no_index);
  const std::vector<Index> owners = motion.owners();
  EXPECT_TRUE(std::is_sorted(owners.begin(), owners.end()));
  EXPECT_GE(owners.front(), two.particles.size()) << "no particle has unknowns of its own";

  // u = (0.1 x, 0.2 x - 0.3 y): nodes of elements in their order, components that move.
  std::vector<double> q(static_cast<std::size_t>(motion.count));
  for (Index node = 0; node < two.body.hosts.num_nodes(); ++node) {
    const double x = two.body.hosts.nodes[static_cast<std::size_t>(node) * 2];
    const double y = two.body.hosts.nodes[static_cast<std::size_t>(node) * 2 + 1];
    int component = x == 0.0 ? 1 : 0;
    for (std::size_t k = 0; k < q.size(); ++k) {
      if (owners[k] == two.particles.size() + node) {
        q[k] = component++ == 0 ? 0.1 * x : 0.2 * x - 0.3 * y;
      }
    }
  }
  const std::vector<double> u = motion.expand(q);
  for (Index i = 0; i < two.particles.size(); ++i) {
    const auto at = two.particles.position(i);
    EXPECT_NEAR(u[static_cast<std::size_t>(i) * 2], 0.1 * at[0], 1e-14);
    EXPECT_NEAR(u[static_cast<std::size_t>(i) * 2 + 1], 0.2 * at[0] - 0.3 * at[1], 1e-14);
  }
}

TEST(EmbeddedMotion, ElementsThatAreHeldInPartDoNotCarry) {
  EXPECT_EQ(TwoElements(3).body.whole, (std::vector<std::uint8_t>{0, 1}));
  EXPECT_EQ(TwoElements(5, 0.25).body.whole, (std::vector<std::uint8_t>{0, 1})) << "driven";
}

/// A quadratic element has a node in the middle of each edge, here between two of six particles.
TEST(EmbeddedMotion, HeldEdgesHoldNodesBetweenParticles) {
  TwoElements two(6, 0.0, 6);
  two.body.hosts = hosts_on_grid(two.particles, {}, {{{0, 4, 8}, {0, 5}, {}}}, 2, 1e-6);
  two.body.whole = fit_supports(two.body.hosts, two.body.free);
  EXPECT_EQ(two.body.whole, (std::vector<std::uint8_t>{1, 1}));
  const Unknowns motion = embedded_motion(two.body.hosts, two.body.free, two.body.whole);
  EXPECT_EQ(motion.count, 2 * 15 - 3) << "three nodes are held along x";
}

/// Two elements meet between the last of four held particles and the first free one: the node there
/// would make the support longer. On the last held one it does not.
TEST(EmbeddedMotion, SupportsDoNotGrowToTheEndsOfElements) {
  for (const double end : {3.0, 3.4, 3.99}) {
    Particles particles;
    particles.dim = 2;
    std::vector<std::uint8_t> held;
    for (int y = 0; y < 9; ++y) {
      for (int x = 0; x < 5; ++x) {
        particles.positions.insert(particles.positions.end(), {1.0 * x, 1.0 * y});
        particles.volumes.push_back(1.0);
        particles.kind.push_back(ParticleKind::solid);
        held.insert(held.end(), {x == 0 && y < 4, 0});
      }
    }
    const Hosts hosts = hosts_on_grid(particles, {}, {{{0, 4}, {0, end, 8}, {}}}, 1, 1e-6);
    const Unknowns free = number_unknowns(2, held, std::vector<double>(held.size(), 0.0));
    EXPECT_EQ(fit_supports(hosts, free)[0], end == 3.0 ? 1 : 0) << end;
  }
}

TEST(EmbeddedMotion, ParticlesBetweenElementsGoWithTheWholeOne) {
  const TwoElements two;
  const std::vector<std::uint8_t> second = {0, 1};
  const std::vector<Index> host = host_of_particles(two.body.hosts, second, 45);
  EXPECT_EQ(host[3], no_index);
  EXPECT_EQ(host[4], 1);
  const Unknowns motion = embedded_motion(two.body.hosts, two.body.free, second);
  EXPECT_EQ(motion.count, 2 * 20 - 5 + 2 * 4);
  EXPECT_EQ(motion.at(1, 0), 1) << "free particles keep their order";
}

/// Any forces on all particles: their sum and moment stay, less what is out of balance at nodes
/// that move, and free particles of elements keep their loads alone.
TEST(EmbeddedMotion, ForcesOutOfBalancePassToHeldParticles) {
  TwoElements two(6, 0.0, 6);
  for (std::size_t slot = 0; slot < two.body.free.number.size(); slot += 18) {
    two.body.free.number[slot + 1] = no_index;  // the left column along y, too
  }
  for (const int order : {1, 2}) {
    two.body.hosts = hosts_on_grid(two.particles, {}, {{{0, 4, 8}, {0, 5}, {}}}, order, 1e-6);
    two.body.whole = fit_supports(two.body.hosts, two.body.free);
    ASSERT_EQ(two.body.whole, (std::vector<std::uint8_t>{1, 1}));
    const Unknowns motion = embedded_motion(two.body.hosts, two.body.free, two.body.whole);
    std::vector<double> loads(two.body.free.number.size()), forces = loads;
    for (std::size_t slot = 0; slot < loads.size(); ++slot) {
      loads[slot] = std::sin(2.0 * static_cast<double>(slot));
      forces[slot] = std::cos(3.0 * static_cast<double>(slot));
    }
    const auto resultant = [&](const std::vector<double>& all) {
      Vector3 sum{};
      for (Index i = 0; i < two.particles.size(); ++i) {
        const auto x = two.particles.position(i);
        const std::size_t slot = static_cast<std::size_t>(i) * 2;
        const double fx = all[slot] - loads[slot], fy = all[slot + 1] - loads[slot + 1];
        sum = {sum[0] + fx, sum[1] + fy, sum[2] + x[0] * fy - x[1] * fx};
      }
      return sum;
    };
    // What is out of balance at moving nodes stays there: forces and moments about the left column.
    std::vector<double> missing = forces;
    for (std::size_t slot = 0; slot < missing.size(); ++slot) missing[slot] -= loads[slot];
    const std::vector<double> at_nodes = motion.restrict(missing);
    Vector3 lost{};
    const std::vector<Index> owners = motion.owners();
    for (std::size_t k = 0; k < owners.size(); ++k) {
      const std::size_t node = static_cast<std::size_t>(owners[k] - two.particles.size()) * 2;
      const bool along_y = k % 2 == 1;  // moving nodes move along both axes
      lost[along_y ? 1 : 0] += at_nodes[k];
      lost[2] += along_y ? two.body.hosts.nodes[node] * at_nodes[k]
                         : -two.body.hosts.nodes[node + 1] * at_nodes[k];
    }
    const Vector3 before = resultant(forces);
    pass_to_held(two.body.hosts, two.body.free, two.body.whole, loads, forces);
    const Vector3 after = resultant(forces);
    for (int a = 0; a < 3; ++a) EXPECT_NEAR(after[a] + lost[a], before[a], 1e-11) << order;
    for (std::size_t slot = 0; slot < forces.size(); ++slot) {
      const bool moves = two.body.free.number[slot] >= 0;
      EXPECT_TRUE(!moves || forces[slot] == loads[slot]) << slot;
    }
  }
}

}  // namespace
}  // namespace perilink

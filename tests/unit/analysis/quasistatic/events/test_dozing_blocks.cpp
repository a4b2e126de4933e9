#include "analysis/quasistatic/events/dozing_blocks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "analysis/quasistatic/events/break_search.hpp"
#include "analysis/quasistatic/events/event_engine.hpp"
#include "network/embedded_motion.hpp"
#include "support/analysis_bodies.hpp"
#include "support/micropolar_networks.hpp"

namespace perilink {
namespace {

using namespace test;

/// A body in elements of a grid, all but the first of which carry their particles.
struct CarriedBodyInMotion {
  explicit CarriedBodyInMotion(Network of_body) : network(std::move(of_body)) {
    const Particles& particles = network.particles;
    Divisions divisions;
    for (int a = 0; a < particles.dim; ++a) {
      double upper = particles.position(0)[a], lower = upper;
      for (Index i = 0; i < particles.size(); ++i) {
        lower = std::min(lower, particles.position(i)[a]);
        upper = std::max(upper, particles.position(i)[a]);
      }
      for (int k = 0; k <= 3; ++k) divisions[a].push_back(lower + (upper - lower) * k / 3.0);
    }
    hosts = hosts_on_grid(particles, {}, divisions, 2, 1e-9);
    const std::size_t slots = static_cast<std::size_t>(particles.size()) * network.width();
    const Unknowns free = number_unknowns(network.width(), std::vector<std::uint8_t>(slots, 0),
                                          std::vector<double>(slots, 0.0));
    std::vector<std::uint8_t> whole(static_cast<std::size_t>(hosts.size()), 1);
    whole[0] = 0;
    unknowns = embedded_motion(hosts, free, whole);
    host = host_of_particles(hosts, whole, particles.size());
    solution.resize(static_cast<std::size_t>(unknowns.count), 0.0);
    places = places_of_unknowns();
  }

  /// Adds a rigid rotation, which strains nothing, and a little of everything else.
  void move(std::mt19937& random, double rotation, double little) {
    const auto number = [&] { return static_cast<double>(random()) / std::mt19937::max() - 0.5; };
    for (std::size_t k = 0; k < solution.size(); ++k) {
      const auto& [x, component] = places[k];
      const double rigid = component == 0   ? -rotation * x[1]
                           : component == 1 ? rotation * x[0]
                           : component == network.width() - 1 && network.carries_moments()
                               ? rotation
                               : 0.0;
      solution[k] += rigid + little * number();
    }
  }

  Network network;
  Hosts hosts;
  Unknowns unknowns;
  std::vector<Index> host;
  std::vector<double> solution;
  std::vector<std::pair<Vector3, int>> places;

 private:
  std::vector<std::pair<Vector3, int>> places_of_unknowns() const {
    const std::vector<Index> owners = unknowns.owners();
    const std::vector<std::size_t> slots = unknowns.slots();
    std::vector<std::pair<Vector3, int>> result;
    for (std::size_t k = 0; k < owners.size(); ++k) {
      const Index node = owners[k] - network.particles.size();
      Vector3 x{};
      for (int a = 0; a < network.dim(); ++a) {
        x[a] = node >= 0 ? hosts.nodes[static_cast<std::size_t>(node) * network.dim() + a]
                         : network.particles.position(owners[k])[a];
      }
      result.emplace_back(x, static_cast<int>(slots[k]) % network.width());
    }
    return result;
  }
};

/// The same element and ratio, bit for bit, as a search that looks at all bonds; and displacements
/// that no bond asked for are left as they were.
void expect_same_answers(CarriedBodyInMotion body) {
  const auto search = make_break_search(body.network), all = make_break_search(body.network);
  std::mt19937 random(7);
  body.move(random, 0.3, 1e-3);
  std::vector<double> displacement = body.unknowns.expand(body.solution);
  const EmbeddedParticles embedded{body.hosts, body.host, body.unknowns, body.solution,
                                   displacement};
  const std::vector<std::uint8_t> awake = search->doze(embedded);
  ASSERT_TRUE(std::count(awake.begin(), awake.end(), 0) > 0);
  std::size_t left_alone = 0;
  for (int step = 0; step < 60; ++step) {
    body.move(random, 0.1, step % 20 == 19 ? 1e-3 : 1e-6);
    const std::vector<double> current = body.unknowns.expand(body.solution);
    for (std::size_t slot = 0; slot < current.size(); ++slot) {
      if (awake[slot / body.network.width()] != 0) displacement[slot] = current[slot];
    }
    const BreakSearch::Hit hit = search->find(displacement, tie_tolerance, 1);
    const BreakSearch::Hit expected = all->find(current, tie_tolerance, 1);
    ASSERT_EQ(hit.element, expected.element) << "step " << step;
    ASSERT_EQ(hit.ratio, expected.ratio);
    for (std::size_t slot = 0; slot < current.size(); ++slot) {
      left_alone += displacement[slot] != current[slot] ? 1 : 0;
    }
    for (BreakSearch* each : {search.get(), all.get()}) each->set_limit(hit.element, INFINITY);
  }
  EXPECT_GT(left_alone, displacement.size()) << "nothing has slept";
}

TEST(DozingBlocks, OfTrussesAnswerAsASearchAmongAll) {
  expect_same_answers(
      CarriedBodyInMotion(make_network({"plane", Pattern::rectangular, Surface::none}, 31)));
  expect_same_answers(
      CarriedBodyInMotion(make_network({"space", Pattern::cubic, Surface::none}, 10)));
}

TEST(DozingBlocks, OfFramesAnswerAsASearchAmongAll) {
  expect_same_answers(CarriedBodyInMotion(
      make_micropolar_network({"plane", Pattern::rectangular, Surface::none}, 31)));
  expect_same_answers(
      CarriedBodyInMotion(make_micropolar_network({"space", Pattern::cubic, Surface::none}, 10)));
}

/// A unit motion of one node against the rest can grow a ratio by the slope and no more.
TEST(DozingBlocks, BoundsGrowByTheSlope) {
  CarriedBodyInMotion body(make_network({"plane", Pattern::rectangular, Surface::none}, 31));
  std::vector<double> displacement = body.unknowns.expand(body.solution);
  const EmbeddedParticles embedded{body.hosts, body.host, body.unknowns, body.solution,
                                   displacement};
  std::vector<Index> elements(static_cast<std::size_t>(body.network.num_elements()));
  for (std::size_t e = 0; e < elements.size(); ++e) elements[e] = static_cast<Index>(e);
  DozingBlocks blocks(body.network, embedded, elements, 64, false, [](std::size_t, double, double) {
    return Slope{2.0, 0.0};
  });
  Index block = 0;
  while (!blocks.may_doze(block)) ++block;
  EXPECT_TRUE(std::isinf(blocks.bound(block))) << "nobody has looked";
  blocks.look(block);
  blocks.remember(block, 0.25);
  EXPECT_NEAR(blocks.bound(block), 0.25, 1e-8);
  for (double& q : body.solution) q += 3.0;  // moves all as one
  EXPECT_NEAR(blocks.bound(block), 0.25, 1e-8);
  std::mt19937 random(3);
  body.move(random, 0.0, 0.2);
  EXPECT_GT(blocks.bound(block), 0.25);
  EXPECT_LT(blocks.bound(block), 0.25 + 2.0 * 2.0 * std::hypot(0.1, 0.1));
  blocks.wake(static_cast<std::size_t>(block) * 64);
  blocks.remember(block, 0.25);
  EXPECT_TRUE(std::isinf(blocks.bound(block))) << "its limits have changed";
}

}  // namespace
}  // namespace perilink

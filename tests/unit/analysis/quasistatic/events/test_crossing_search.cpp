#include "analysis/quasistatic/events/crossing_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/quasistatic/events/event_engine.hpp"
#include "base/error.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// Scan in steps of d for what a search finds exactly, with the stretches of a textbook's beam.
struct Scan {
  const Network& network;
  const std::vector<double>&now, &growing;

  std::vector<double> at(double d) const {
    std::vector<double> u = now;
    for (std::size_t k = 0; k < u.size(); ++k) u[k] += d * growing[k];
    return u;
  }
  bool fails(Index e, const std::vector<double>& u) const {
    double value = stretch(network, u, e) / network.critical_stretch[e];
    if (network.law(e).sense() == Sense::both) value = std::abs(value);
    return value > 1.0;
  }
  bool any_fails(double d) const {
    const std::vector<double> u = at(d);
    for (Index e = 0; e < network.num_elements(); ++e) {
      if (network.has_limit(e) && fails(e, u)) return true;
    }
    return false;
  }
};

struct Kind {
  const char* name;
  LatticeCase lattice;
  bool bends;
};

class Crossings : public testing::TestWithParam<Kind> {
 protected:
  Crossings() {
    network_ = GetParam().bends ? make_micropolar_network(GetParam().lattice, 3)
                                : build_network(make_body(body_input(GetParam().lattice, 3)),
                                                network_input(body_input(GetParam().lattice, 3)));
    std::fill(network_.critical_stretch.begin(), network_.critical_stretch.end(), 1.0);
    slots_ = static_cast<std::size_t>(network_.particles.size()) * network_.width();
  }

  Network network_;
  std::size_t slots_ = 0;
};

TEST_P(Crossings, AheadIsWhereTheFirstElementBeginsToFail) {
  CrossingSearch search(network_);
  for (unsigned seed = 0; seed < 20; ++seed) {
    auto now = random_vector(slots_, seed);
    const auto growing = random_vector(slots_, seed + 100);
    for (double& u : now) u *= 0.01;
    const Scan scan{network_, now, growing};
    ASSERT_FALSE(scan.any_fails(0.0));
    for (const int sense : {1, -1}) {
      const auto found = search.ahead(now, growing, sense, tie_tolerance, 1 + seed % 2);
      ASSERT_NE(found.element, no_index);
      EXPECT_GT(sense * found.distance, 0.0);
      EXPECT_TRUE(scan.fails(found.element, scan.at(found.distance * (1.0 + 1e-6))));
      for (int k = 0; k <= 200; ++k) {
        EXPECT_FALSE(scan.any_fails(found.distance * (1.0 - 1e-6) * k / 200.0)) << "seed " << seed;
      }
    }
  }
}

/// A body that moves as a whole, except for the last digits, stretches no bond.
TEST_P(Crossings, RoundOffOfARigidMotionNeverFails) {
  CrossingSearch search(network_);
  const std::vector<double> now(slots_, 0.0);
  std::vector<double> growing = random_vector(slots_, 7);
  const auto width = static_cast<std::size_t>(network_.width());
  for (std::size_t slot = 0; slot < slots_; ++slot) {
    const bool turns = slot % width >= static_cast<std::size_t>(network_.dim());
    growing[slot] = turns ? 0.0 : 1.0 + 1e-15 * growing[slot];
  }
  EXPECT_EQ(search.ahead(now, growing, 1, tie_tolerance, 1).element, no_index);
  const auto found = search.largest(now, growing, tie_tolerance, 1);
  EXPECT_EQ(found.element, no_index);
  EXPECT_EQ(found.distance, infinity);
}

/// Errors of K^-1 carry round-off of a far motion to particles at rest, where it is large beside
/// their own motion. The piece that moves far is cut off.
TEST_P(Crossings, RoundOffOfAPieceFarAwayNeverFails) {
  CrossingSearch search(network_);
  const auto width = static_cast<std::size_t>(network_.width());
  const Index far = network_.particles.size() - 1;
  for (Index e = 0; e < network_.num_elements(); ++e) {
    if (network_.bonds.first[e] == far || network_.bonds.second[e] == far) {
      search.set_limit(e, infinity);
    }
  }
  std::vector<double> now = random_vector(slots_, 3), growing = random_vector(slots_, 7);
  for (std::size_t slot = 0; slot < slots_; ++slot) {
    now[slot] *= 1e-3;
    growing[slot] *= 1e-14;
  }
  growing[far * width] = 1.0;
  for (const int sense : {1, -1}) {
    EXPECT_EQ(search.ahead(now, growing, sense, tie_tolerance, 1).element, no_index);
  }
  const auto found = search.largest(now, growing, tie_tolerance, 1);
  EXPECT_EQ(found.element, no_index);
  EXPECT_EQ(found.distance, infinity);
  for (double& u : growing) u *= 1e-4;
  growing[far * width] = 1e-14;  // the rest moves as far
  for (double& u : growing) u *= 1e18;
  EXPECT_NE(search.ahead(now, growing, 1, tie_tolerance, 1).element, no_index);
}

TEST_P(Crossings, LargestIsTheLastWhereNoneFails) {
  CrossingSearch search(network_);
  int found_some = 0, found_none = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    auto now = random_vector(slots_, seed);
    const auto growing = random_vector(slots_, seed + 100);
    for (double& u : now) u *= (seed < 40 ? 0.002 : 0.02) * seed;
    const Scan scan{network_, now, growing};
    const auto found = search.largest(now, growing, tie_tolerance, 1);
    const bool none = found.element == no_index;
    (none ? found_none : found_some) += 1;
    if (none) {
      EXPECT_EQ(found.distance, -infinity);
    } else {
      EXPECT_FALSE(scan.any_fails(found.distance - 1e-9)) << "seed " << seed;
    }
    for (double d = 4.0; d > (none ? -4.0 : found.distance + 1e-9); d -= 0.01) {
      EXPECT_TRUE(scan.any_fails(d)) << "seed " << seed << ", " << d;
    }
  }
  EXPECT_GT(found_some, 10);
  EXPECT_GT(found_none, 3);
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, Crossings,
    testing::Values(Kind{"trusses", {"hexagonal", Pattern::hexagonal, Surface::none}, false},
                    Kind{"trusses_in_space", {"cubic", Pattern::cubic, Surface::none}, false},
                    Kind{"frames", {"hexagonal", Pattern::hexagonal, Surface::none}, true},
                    Kind{"frames_in_space", {"cubic", Pattern::cubic, Surface::none}, true}),
    [](const auto& kind) { return std::string(kind.param.name); });

/// Four bonds of unit length along x in make_square() order: u_x of the right ends are 1 d.
TEST(CrossingSearch, BreaksTiesByNumberAndForgetsWhatIsBroken) {
  AnalysisBody body = make_square();
  CrossingSearch search(body.network);
  std::vector<double> now(8, 0.0), growing(8, 0.0);
  for (Index i = 0; i < 4; ++i) {
    if (body.network.particles.position(i)[0] > 0.5) growing[slot(body, i, 0)] = 1.0;
  }
  const Index lower = bond_between(body.network, {0.0, 0.0}, {1.0, 0.0});
  const Index upper = bond_between(body.network, {0.0, 1.0}, {1.0, 1.0});
  const Index first = std::min(lower, upper), second = std::max(lower, upper);
  auto found = search.largest(now, growing, tie_tolerance, 1);
  EXPECT_EQ(found.element, first);
  EXPECT_NEAR(found.distance, 0.01, 1e-16);
  search.set_limit(first, infinity);
  EXPECT_EQ(search.largest(now, growing, tie_tolerance, 1).element, second);
  search.set_limit(second, 0.005);
  found = search.ahead(now, growing, 1, tie_tolerance, 1);
  EXPECT_EQ(found.element, second);
  EXPECT_NEAR(found.distance, 0.005, 1e-16);
  // Shortened bonds never fail: unloading has no event.
  EXPECT_EQ(search.ahead(now, growing, -1, tie_tolerance, 1).element, no_index);
}

TEST(CrossingSearch, TellsWhatIsNoNumber) {
  AnalysisBody body = make_square();
  CrossingSearch search(body.network);
  std::vector<double> now(8, 0.0), growing(8, 1.0);
  growing[3] = std::nan("");
  EXPECT_THROW(search.largest(now, growing, tie_tolerance, 1), SolverError);
}

}  // namespace
}  // namespace perilink

#include "analysis/quasistatic/events/frame_limit_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/quasistatic/events/event_engine.hpp"
#include "analysis/quasistatic/events/limit_search.hpp"
#include "base/error.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// Round-off of one ratio: the dense element matrix cancels a digit or two.
constexpr double round_off = 1e-12;

std::size_t num_slots(const Network& network) {
  return static_cast<std::size_t>(network.particles.size()) * network.width();
}

/// Every bond, one by one, with the energy of a textbook's beam.
BreakSearch::Hit brute_force(const Network& network, const std::vector<double>& u,
                             const std::vector<std::uint8_t>& removed) {
  BreakSearch::Hit best;
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (removed[e]) continue;
    const double ratio = stretch(network, u, e) / network.critical_stretch[e];
    if (ratio > best.ratio) best = {e, ratio};
  }
  return best;
}

class FramesOf : public testing::TestWithParam<LatticeCase> {};

TEST_P(FramesOf, TheLargestRatioIsFoundAgainAndAgain) {
  const Network network = make_micropolar_network(GetParam(), 4);
  std::vector<std::uint8_t> removed(static_cast<std::size_t>(network.num_elements()), 0);
  FrameLimitSearch search(network);
  for (unsigned seed = 0; seed < 30; ++seed) {
    const auto u = random_vector(num_slots(network), seed);
    const BreakSearch::Hit expected = brute_force(network, u, removed);
    const BreakSearch::Hit hit = search.find(u, tie_tolerance, 1 + seed % 2);
    ASSERT_EQ(hit.element, expected.element) << "seed " << seed;
    EXPECT_NEAR(hit.ratio, expected.ratio, round_off * expected.ratio);
    search.set_limit(hit.element, INFINITY);
    removed[hit.element] = 1;
  }
}

TEST_P(FramesOf, TheRatioGrowsInProportionToTheLoad) {
  const Network network = make_micropolar_network(GetParam(), 3);
  FrameLimitSearch search(network);
  auto u = random_vector(num_slots(network), 7);
  const BreakSearch::Hit once = search.find(u, tie_tolerance, 1);
  for (double& component : u) component *= 3.0;
  const BreakSearch::Hit thrice = search.find(u, tie_tolerance, 1);
  EXPECT_EQ(thrice.element, once.element);
  EXPECT_NEAR(thrice.ratio, 3.0 * once.ratio, round_off * thrice.ratio);
}

/// Without bending the search is that of trusses.
TEST_P(FramesOf, TrussesAmongThemBreakByTheirStretch) {
  Network network = make_micropolar_network(GetParam(), 3);
  std::fill(network.bending.begin(), network.bending.end(), 0.0);
  const auto motion = random_vector(num_slots(network), 9);
  std::vector<double> displacement;
  for (std::size_t slot = 0; slot < motion.size(); ++slot) {
    if (slot % network.width() < static_cast<std::size_t>(network.dim())) {
      displacement.push_back(motion[slot]);
    }
  }
  FrameLimitSearch frames(network);
  network.bending.clear();
  LimitSearch trusses(network);
  const BreakSearch::Hit hit = frames.find(motion, tie_tolerance, 1);
  const BreakSearch::Hit expected = trusses.find(displacement, tie_tolerance, 1);
  EXPECT_EQ(hit.element, expected.element);
  EXPECT_NEAR(hit.ratio, expected.ratio, round_off * expected.ratio);
}

INSTANTIATE_TEST_SUITE_P(Lattices, FramesOf,
                         testing::Values(LatticeCase{"plane", Pattern::hexagonal, Surface::none},
                                         LatticeCase{"space", Pattern::cubic, Surface::none}),
                         [](const auto& test) { return test.param.name; });

/// Pure bending, and shear of a shortened bond, cause no event.
TEST(FrameLimitSearch, BondsBreakInTensionOnly) {
  const Network network = single_frame(2, {1.0, 0.0}, 2.0, 3.0);
  FrameLimitSearch search(network);
  EXPECT_EQ(search.find(std::vector<double>{0, 0, 0.1, 0, 0.2, -0.1}, 0.0, 1).element, no_index);
  EXPECT_EQ(search.find(std::vector<double>{0, 0, 0.1, -1e-3, 0.2, -0.1}, 0.0, 1).element,
            no_index);
  // Round-off on a bond that keeps its length.
  EXPECT_EQ(search.find(std::vector<double>{0, 0, 0.1, 1e-17, 0.2, -0.1}, 0.0, 1).element,
            no_index);
  // s = 1e-3, g / xi = 0.2 - (0.1 - 0.1) / 2 = 0.2, dtheta = -0.2.
  const BreakSearch::Hit hit = search.find(std::vector<double>{0, 0, 0.1, 1e-3, 0.2, -0.1}, 0.0, 1);
  EXPECT_EQ(hit.element, 0);
  EXPECT_NEAR(hit.ratio, 1e3 * std::sqrt(1e-6 + 1.5 * 0.04 + 1.5 * 0.04 / 12.0), 1e-10);
}

/// Events follow from the axial stretch, whatever the shear; in compression only when active.
TEST(FrameLimitSearch, BondsThatCrushHaveALimitInEachSense) {
  Network network = single_frame(2, {1.0, 0.0}, 2.0, 3.0);
  network.laws = {BondLaw::brittle().crushing({{1.0, 1.0}}, 7.0, true)};
  const std::vector<double> pulled = {0, 0, 0.1, 1e-3, 0.2, -0.1};
  const std::vector<double> pushed = {0, 0, 0.1, -1e-3, 0.2, -0.1};
  FrameLimitSearch search(network);
  EXPECT_NEAR(search.find(pulled, 0.0, 1).ratio, 1.0, 1e-12);
  EXPECT_EQ(search.find(pushed, 0.0, 1).element, no_index) << "inactive";
  search.set_limits(0, 2e-3, 5e-4);
  EXPECT_NEAR(search.find(pulled, 0.0, 1).ratio, 0.5, 1e-12);
  EXPECT_NEAR(search.find(pushed, 0.0, 1).ratio, 2.0, 1e-12);
  search.set_limits(0, INFINITY, 5e-4);
  EXPECT_EQ(search.find(pulled, 0.0, 1).element, no_index);
  search.set_limit(0, INFINITY);
  EXPECT_EQ(search.find(pushed, 0.0, 1).element, no_index) << "broken";
}

/// An axial stretch of 3e-6 of the limit, beside shear of eight times the limit: at given loads the
/// bond is in tension, as CrossingSearch says. At load factor 1 the limit is no measure.
TEST(FrameLimitSearch, AtLoadsTensionIsMeasuredByTheLimit) {
  const Network network = single_frame(2, {1.0, 0.0}, 2.0, 2.0);
  for (const auto& [extension, element] : {std::pair{3e-9, Index{0}}, {0.5e-9, no_index}}) {
    const std::vector<double> u = {0, 0, 0, extension, 8e-3, 0};
    FrameLimitSearch at_loads(network, true), at_one(network);
    EXPECT_EQ(at_loads.find(u, tie_tolerance, 1).element, element) << extension;
    EXPECT_EQ(at_one.find(u, tie_tolerance, 1).element, no_index) << extension;
  }
}

/// The calibrated stiffness of a bond does not change the weights of shear and bending.
TEST(FrameLimitSearch, BendingOfCalibratedBondsCountsByItsOwnRatio) {
  Network network = single_frame(2, {1.0, 0.0}, 0.02 * 2.0, 1.7 * 3.0);
  network.bending_ratio = {1.5};
  const std::vector<double> u = {0, 0, 0.1, 1e-3, 0.2, -0.1};
  const double expected = 1e3 * std::sqrt(1e-6 + 1.5 * 0.04 + 1.5 * 0.04 / 12.0);
  EXPECT_NEAR(FrameLimitSearch(network).find(u, 0.0, 1).ratio, expected, 1e-10);
  network.bending_ratio.clear();
  const double own = 1.5 * 1.7 / 0.02;
  EXPECT_NEAR(FrameLimitSearch(network).find(u, 0.0, 1).ratio,
              1e3 * std::sqrt(1e-6 + own * 0.04 + own * 0.04 / 12.0), 1e-10);
}

/// Round-off selects no bond in an unstretched body either.
TEST(FrameLimitSearch, RefusesWhatIsNotFinite) {
  const Network network = single_frame(2, {1.0, 0.0}, 2.0, 3.0);
  for (const double extension : {1e-3, -1e-3}) {
    const std::vector<double> u = {0, 0, 0.1, extension, 0.2, -0.1};
    for (std::size_t slot = 0; slot < u.size(); ++slot) {
      auto broken = u;
      broken[slot] = NAN;
      FrameLimitSearch search(network);
      EXPECT_THROW(search.find(broken, tie_tolerance, 1), SolverError) << slot;
      EXPECT_NO_THROW(search.find(u, tie_tolerance, 1));
    }
  }
  for (const LatticeCase& lattice : {LatticeCase{"plane", Pattern::hexagonal, Surface::none},
                                     LatticeCase{"space", Pattern::cubic, Surface::none}}) {
    const Network body = make_micropolar_network(lattice, 4);
    auto u = random_vector(num_slots(body), 3);
    u.back() = NAN;  // a rotation
    EXPECT_THROW(FrameLimitSearch(body).find(u, tie_tolerance, 2), SolverError);
  }
}

/// Among bonds equal by symmetry the lowest number breaks, whatever the round-off.
TEST(FrameLimitSearch, TiesGoToTheLowestElement) {
  Network network = single_frame(2, {1.0, 0.0}, 2.0, 3.0);
  network.bonds.append(network.particles, 0, 1);
  network.stiffness.push_back(2.0);
  network.bending.push_back(3.0);
  network.critical_stretch.push_back(1e-3 * (1.0 - 1e-12));
  network.first_slip_spring = network.first_bar_element = 2;
  FrameLimitSearch search(network);
  const std::vector<double> u = {0, 0, 0.1, 0.3, 0.2, -0.1};
  EXPECT_EQ(search.find(u, tie_tolerance, 1).element, 0);
  EXPECT_EQ(search.find(u, 0.0, 1).element, 1);
  search.set_limit(0, INFINITY);
  EXPECT_EQ(search.find(u, tie_tolerance, 1).element, 1);
}

}  // namespace
}  // namespace perilink

#include "analysis/quasistatic/events/limit_search.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/quasistatic/events/event_engine.hpp"
#include "base/error.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// Round-off of one ratio, written as a sum over the axes: a few units of the last place.
constexpr double truss_round_off = 1e-13;

const LatticeCase plane{"plane", Pattern::hexagonal, Surface::none};
const LatticeCase space{"space", Pattern::cubic, Surface::none};

/// Every bond, one by one.
LimitSearch::Hit brute_force_of_bonds(const Network& network, const std::vector<double>& u,
                                      const std::vector<std::uint8_t>& removed = {}) {
  LimitSearch::Hit best;
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (!removed.empty() && removed[e]) continue;
    const double ratio = stretch(network, u, e) / network.critical_stretch[e];
    if (ratio > best.ratio) best = {e, ratio};
  }
  return best;
}

class EveryDimension : public testing::TestWithParam<LatticeCase> {};

TEST_P(EveryDimension, FindsTheLargestRatioAgainAndAgain) {
  const Network network = make_network(GetParam(), 4);
  std::vector<std::uint8_t> removed(static_cast<std::size_t>(network.num_elements()), 0);
  LimitSearch search(network);
  for (unsigned seed = 0; seed < 50; ++seed) {
    const auto u = random_vector(network.particles.positions.size(), seed);
    const LimitSearch::Hit expected = brute_force_of_bonds(network, u, removed);
    const LimitSearch::Hit hit = search.find(u, tie_tolerance, 1);
    ASSERT_EQ(hit.element, expected.element) << "seed " << seed;
    EXPECT_NEAR(hit.ratio, expected.ratio, truss_round_off * expected.ratio);
    search.set_limit(hit.element, INFINITY);
    removed[hit.element] = 1;
  }
}

/// Also elements that have events in compression.
TEST_P(EveryDimension, ListsAllThatReachARatio) {
  Network network = make_network(GetParam(), 4);
  network.laws.push_back(BondLaw::plateau(1.44));  // the first segment ends at 1.2
  network.law_of.assign(static_cast<std::size_t>(network.num_elements()), 0);
  for (Index e = 0; e < network.num_elements(); e += 3) network.law_of[e] = 1;
  LimitSearch search(network);
  const auto u = random_vector(network.particles.positions.size(), 5);
  search.set_limit(1, 1e-3 * network.critical_stretch[1]);
  const auto ratio_of = [&](Index e) {
    const double ratio = stretch(network, u, e) / network.critical_stretch[e];
    return e % 3 == 0 ? std::abs(ratio) / 1.2 : e == 1 ? 1e3 * ratio : ratio;
  };
  const double least = 0.5 * search.find(u, tie_tolerance, 1).ratio;
  const std::vector<LimitSearch::Hit> hits = search.list(u, least);
  auto hit = hits.begin();
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (ratio_of(e) < least) continue;
    ASSERT_NE(hit, hits.end());
    EXPECT_EQ(hit->element, e);
    EXPECT_NEAR(hit->ratio, ratio_of(e), truss_round_off * ratio_of(e));
    ++hit;
  }
  EXPECT_EQ(hit, hits.end());
  EXPECT_GT(hits.size(), 0U);
}

/// An element of either sense may be the first of equal ratios.
TEST(LimitSearch, TiesAcrossSensesGoToTheLowestNumber) {
  for (const Index yielding : {0, 1}) {
    Network network = make_network({"", Pattern::rectangular, Surface::none}, 2);
    network.laws.push_back(BondLaw::plateau(1.21));  // the first segment ends at 1.1
    network.law_of.assign(static_cast<std::size_t>(network.num_elements()), 0);
    network.law_of[yielding] = 1;
    network.critical_stretch.assign(network.law_of.size(), INFINITY);
    const auto u = linear_field(network.particles, {{{1, 0, 0}, {0, 1, 0}, {}}});
    for (const Index e : {0, 1}) {
      const double size = std::abs(stretch(network, u, e));
      network.critical_stretch[e] = e == yielding ? size / 1.1 : size;
    }
    LimitSearch search(network);
    EXPECT_EQ(search.find(u, tie_tolerance, 1).element, 0);
  }
}

TEST_P(EveryDimension, RemovedBondsNeverComeBack) {
  const Network network = make_network(GetParam(), 2);
  const auto u = random_vector(network.particles.positions.size(), 3);
  LimitSearch search(network);
  std::vector<std::uint8_t> removed(static_cast<std::size_t>(network.num_elements()), 0);
  double last = std::numeric_limits<double>::infinity();
  while (true) {
    const LimitSearch::Hit hit = search.find(u, tie_tolerance, 1);
    if (hit.element == no_index) break;
    ASSERT_FALSE(removed[hit.element]);
    EXPECT_LE(hit.ratio, last * (1.0 + tie_tolerance));
    last = hit.ratio;
    removed[hit.element] = 1;
    search.set_limit(hit.element, INFINITY);
  }
  for (Index e = 0; e < network.num_elements(); ++e) {
    EXPECT_EQ(removed[e] != 0, stretch(network, u, e) > 0.0) << e;
  }
}

TEST_P(EveryDimension, NegativeStretchNeverBreaks) {
  const Network network = make_network(GetParam(), 3);
  const auto shrink = linear_field(network.particles, {{{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}});
  const auto rest = std::vector<double>(shrink.size(), 0.0);
  LimitSearch search(network);
  EXPECT_EQ(search.find(shrink, tie_tolerance, 1).element, no_index);
  EXPECT_EQ(search.find(rest, tie_tolerance, 1).element, no_index);
}

INSTANTIATE_TEST_SUITE_P(LimitSearch, EveryDimension, testing::Values(plane, space),
                         [](const auto& test) { return test.param.name; });

/// Bonds of one length in a row have equal ratios under a uniform strain. Then one is changed by
/// less, or more, than the tolerance of equal ratios.
TEST(LimitSearch, TiesWithinTheToleranceGoToTheLowestNumber) {
  AnalysisBody body = make_chains(6, 1 + 1, false, 1.0, 0.01);
  Network& network = body.network;
  const auto u = linear_field(network.particles, {{{1, 0, 0}, {0, 0, 0}, {0, 0, 0}}});
  const std::vector<Index> row = bonds_of_row(network, 0.0);
  ASSERT_EQ(row.size(), 6u);

  EXPECT_EQ(LimitSearch(network).find(u, tie_tolerance, 1).element, row[0]);
  network.critical_stretch[row[4]] = 0.01 * (1.0 - 0.5 * tie_tolerance);
  EXPECT_EQ(LimitSearch(network).find(u, tie_tolerance, 1).element, row[0]);
  network.critical_stretch[row[4]] = 0.01 * (1.0 - 2.0 * tie_tolerance);
  EXPECT_EQ(LimitSearch(network).find(u, tie_tolerance, 1).element, row[4]);
}

TEST(LimitSearch, KnowsNoTeethInCompression) {
  Network network = make_network(plane, 3);
  LimitSearch search(network);
  EXPECT_THROW(search.set_limits(0, 1.0, 1.0), std::logic_error);
  network.laws = {BondLaw::brittle().crushing({{1.0, 1.0}}, 7.0, false)};
  EXPECT_THROW(LimitSearch{network}, std::invalid_argument);
}

TEST(LimitSearch, LeavesOutWhatCannotBreak) {
  AnalysisBody body = make_chains(3, 2, false, 1.0, 0.01);
  Network& network = body.network;
  const auto u = linear_field(network.particles, {{{1, 0, 0}, {0, 0, 0}, {0, 0, 0}}});
  const Index first = bonds_of_row(network, 0.0)[0];
  network.critical_stretch[first] = std::numeric_limits<double>::infinity();
  LimitSearch search(network);
  search.set_limit(first, INFINITY);  // not in the table: no effect
  EXPECT_EQ(search.find(u, tie_tolerance, 1).element, bonds_of_row(network, 0.0)[1]);

  for (double& limit : network.critical_stretch) limit = std::numeric_limits<double>::infinity();
  EXPECT_EQ(LimitSearch(network).find(u, tie_tolerance, 1).element, no_index);
}

/// A NaN measure or limit is reported, at any position in a block and for any other measures.
TEST(LimitSearch, RefusesWhatIsNotFinite) {
  for (const LatticeCase& lattice : {plane, space}) {
    Network network = make_network(lattice, 4);
    const auto u = random_vector(network.particles.positions.size(), 3);
    for (const float bad : {NAN, -NAN, INFINITY, -INFINITY}) {
      for (const std::size_t slot : {std::size_t{0}, u.size() / 2, u.size() - 1}) {
        auto broken = u;
        broken[slot] = bad;
        LimitSearch search(network);
        EXPECT_THROW(search.find(broken, tie_tolerance, 1), SolverError) << bad << " at " << slot;
        EXPECT_NO_THROW(search.find(u, tie_tolerance, 1));
      }
    }
    network.critical_stretch[7] = NAN;
    LimitSearch search(network);
    try {
      search.find(u, tie_tolerance, 1);
      FAIL() << "a limit that is not a number was taken for infinite";
    } catch (const SolverError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("element 7 "));
    }
  }
}

/// The table is searched in parallel from 400 blocks of 512 bonds on.
TEST(LimitSearch, ThreadsDoNotChangeTheResult) {
  const Network network = make_network({"large", Pattern::rectangular, Surface::none}, 150);
  ASSERT_GT(network.num_elements(), 401 * 512);
  std::vector<LimitSearch> searches(3, LimitSearch(network));
  for (unsigned seed = 0; seed < 3; ++seed) {
    const auto u = random_vector(network.particles.positions.size(), seed);
    const LimitSearch::Hit expected = searches[0].find(u, tie_tolerance, 1);
    EXPECT_EQ(expected.element, brute_force_of_bonds(network, u).element);
    for (int threads = 2; threads <= 3; ++threads) {
      const LimitSearch::Hit hit = searches[threads - 1].find(u, tie_tolerance, threads);
      EXPECT_EQ(hit.element, expected.element);
      EXPECT_EQ(hit.ratio, expected.ratio) << "to the last bit";
    }
  }
  // Under a uniform strain all bonds along x have equal ratios; the number decides.
  const auto pull = linear_field(network.particles, {{{1, 0, 0}, {0, -1, 0}, {0, 0, 0}}});
  for (int threads = 1; threads <= 3; ++threads) {
    EXPECT_EQ(searches[threads - 1].find(pull, tie_tolerance, threads).element, 0);
  }
}

}  // namespace
}  // namespace perilink

#include "analysis/quasistatic/subdomains/subdomain_factor.hpp"

#include <gtest/gtest.h>

#include "assembly/element_vector.hpp"
#include "assembly/stiffness.hpp"
#include "base/block.hpp"
#include "solver/factor_routes.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// Errors of columns are 1e-12 in the norm of energy, and far less in what small blocks magnify.
constexpr double closeness = 1e-9;
const SubdomainSolverOptions fine{.tolerance = 1e-12, .edge = 3};

double largest_difference(std::span<const double> a, std::span<const double> b) {
  double largest = 0.0, size = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    largest = std::max(largest, std::abs(a[k] - b[k]));
    size = std::max(size, std::abs(b[k]));
  }
  return largest / size;
}

/// Follows the same removals as a factor of the matrix.
void expect_what_a_factor_says(const BlockCase& block) {
  const AnalysisBody body = make_block(block);
  std::vector<double> secants = intact(body.network);
  const std::vector<double> no_ground;
  SubdomainFactor subdomains(body.network, fine);
  subdomains.begin(body.unknowns, secants, no_ground);
  const auto factor = make_factor(FactorRoute::in_place, 1);
  factor->factorize(assemble_stiffness(body.network, secants, body.unknowns),
                    body.unknowns.owners());
  std::vector<double> motion = body.unknowns.restrict(body.loads.forces), other = motion;
  subdomains.solve(motion, motion);
  factor->solve(other, other);
  EXPECT_LT(largest_difference(motion, other), closeness);

  int followed = 0, asked = 0;
  for (Index e = 0; followed < 60 && e < body.network.num_elements(); e += 7) {
    const double fraction = e % 2 == 0 ? 1.0 : 0.3;
    const ElementVectors parts =
        element_vectors(body.network, body.unknowns, e, fraction * secants[e]);
    if (parts.x[0].size() == 0) continue;
    const SparseVector& x = parts.x[0];
    const double pivot = factor->pivot(x);
    EXPECT_NEAR(subdomains.pivot(x), pivot, closeness);
    ++asked;
    if (parts.count > 1) {  // the modes of a frame interact
      std::vector<double> found(9), expected(9);
      const std::span<const SparseVector> three(parts.x.data(), 3);
      subdomains.compliance(three, found);
      factor->compliance(three, expected);
      EXPECT_LT(largest_difference(found, expected), closeness);
    }
    if (pivot < 0.2) continue;
    EXPECT_LT(largest_difference(subdomains.columns({&x, 1}), factor->columns({&x, 1})), closeness);
    if (parts.count == 1)
      secants[e] *= 1.0 - fraction;  // products follow, of frames they cannot
    else
      continue;
    const double load = 0.1 * followed++;
    subdomains.downdate({&x, 1}, {&load, 1}, {&pivot, 1}, motion);
    factor->downdate({&x, 1}, {&load, 1}, {&pivot, 1}, other);
    ASSERT_LT(largest_difference(motion, other), closeness) << followed;
  }
  if (!body.network.carries_moments()) {
    EXPECT_EQ(followed, 60);
    EXPECT_LE(subdomains.columns_solved(), asked);      // some are made up of others ...
    EXPECT_GT(subdomains.columns_solved(), asked / 2);  // ... but most are not
    std::vector<double> again = body.unknowns.restrict(body.loads.forces), expected = again;
    subdomains.solve(again, again);  // with the secants as they are now
    factor->solve(expected, expected);
    EXPECT_LT(largest_difference(again, expected), closeness);
  }
}

TEST(SubdomainFactor, SaysWhatAFactorSays) {
  expect_what_a_factor_says({{"hexagonal", Pattern::hexagonal, Surface::none}, false, false, 9});
  expect_what_a_factor_says({{"cubic", Pattern::cubic, Surface::none}, false, false, 5});
  BlockCase frames{{"hexagonal", Pattern::hexagonal, Surface::none}};
  frames.micropolar = true;
  expect_what_a_factor_says(frames);
}

TEST(SubdomainFactor, ASpringIsAnUpdate) {
  const AnalysisBody body = make_block({{"cubic", Pattern::cubic, Surface::none}});
  const std::vector<double> secants = intact(body.network);
  std::vector<double> ground;
  SubdomainFactor subdomains(body.network, fine);
  subdomains.begin(body.unknowns, secants, ground);
  SparseVector x, other;
  x.add(40, 3.0);
  other.add(41, 2.0);
  const double before = 1.0 - subdomains.pivot(x);
  double coupled[4];
  const SparseVector both[] = {x, other};
  subdomains.compliance(both, coupled);
  subdomains.update(x);
  EXPECT_NEAR(1.0 - subdomains.pivot(x), before / (1.0 + before), 1e-12);
  EXPECT_NEAR(1.0 - subdomains.pivot(other), coupled[3] - coupled[1] * coupled[1] / (1.0 + before),
              1e-12);
  ground.assign(static_cast<std::size_t>(body.unknowns.count), 0.0);
  ground[40] = 9.0;
  std::vector<double> load(ground.size(), 0.0);
  load[40] = 3.0;
  subdomains.solve(load, load);
  EXPECT_NEAR(3.0 * load[40], before / (1.0 + before), 1e-11);
}

SparseVector unit(Index unknown) { return {{unknown}, {1.0}}; }

TEST(SubdomainFactor, HoldsWhatWasExpected) {
  const AnalysisBody body = make_block({{"cubic", Pattern::cubic, Surface::none}});
  const std::vector<double> secants = intact(body.network), no_ground;
  SubdomainFactor subdomains(body.network, fine);
  subdomains.begin(body.unknowns, secants, no_ground);
  EXPECT_FALSE(subdomains.holds(unit(7)));
  subdomains.expect({unit(7), unit(9), unit(7)});
  subdomains.pivot(unit(5));
  SparseVector all;
  for (const Index unknown : {9, 5, 7}) all.add(unknown, 0.1 * unknown);
  EXPECT_TRUE(subdomains.holds(all));
  EXPECT_EQ(subdomains.columns_solved(), 3);
  EXPECT_THROW(subdomains.refactorize({}), std::logic_error);
}

/// The vector of an element, whatever is left of it, and no other on the same unknowns.
TEST(SubdomainFactor, HoldsVectorsByThemselves) {
  const AnalysisBody body = make_block({{"cubic", Pattern::cubic, Surface::none}});
  const std::vector<double> secants = intact(body.network), no_ground;
  SubdomainFactor subdomains(body.network, fine);
  subdomains.begin(body.unknowns, secants, no_ground);
  const SparseVector x{{4, 5, 11}, {0.0, 2.0, -3.0}};
  const double whole = 1.0 - subdomains.pivot(x);
  EXPECT_EQ(subdomains.columns_solved(), 1);
  const SparseVector half{{4, 5, 11}, {0.0, -1.0, 1.5}}, other{{4, 5, 11}, {1.0, 2.0, -3.0}};
  EXPECT_TRUE(subdomains.holds(half));
  EXPECT_FALSE(subdomains.holds(other));
  EXPECT_FALSE(subdomains.holds(unit(5)));
  EXPECT_NEAR(1.0 - subdomains.pivot(half), 0.25 * whole, 1e-15 * whole);

  // Beside something that is held, on one unknown: counted by its size.
  const SparseVector alone{{20}, {3.0}};
  const double stiff = 1.0 - subdomains.pivot(alone);
  EXPECT_NEAR(1.0 - subdomains.pivot(unit(20)), stiff / 9.0, 1e-15 * stiff);
  EXPECT_EQ(subdomains.columns_solved(), 2);
}

/// A vector that two of the window make up costs no column, and is followed as they are.
TEST(SubdomainFactor, HoldsWhatOthersMakeUp) {
  const AnalysisBody body = make_block({{"cubic", Pattern::cubic, Surface::none}});
  const std::vector<double> secants = intact(body.network), no_ground;
  SubdomainFactor subdomains(body.network, fine), by_itself(body.network, fine);
  subdomains.begin(body.unknowns, secants, no_ground);
  by_itself.begin(body.unknowns, secants, no_ground);
  const SparseVector first{{4, 11}, {2.0, 1.0}}, second{{11, 30}, {1.0, 5.0}};
  const SparseVector sum{{4, 11, 30}, {4.0, 1.0, -5.0}};  // 2 first - second
  EXPECT_FALSE(subdomains.holds(sum));
  subdomains.hold(std::vector{first, second});
  ASSERT_TRUE(subdomains.holds(sum));
  EXPECT_LT(largest_difference(subdomains.columns({&sum, 1}), by_itself.columns({&sum, 1})),
            closeness);
  EXPECT_NEAR((1.0 - subdomains.pivot(sum)) / (1.0 - by_itself.pivot(sum)), 1.0, closeness);
  EXPECT_EQ(subdomains.columns_solved(), 2);
  // A column that combines other columns of the request is not solved for either.
  by_itself.clear();
  by_itself.hold(std::vector{first, second, sum});
  EXPECT_EQ(by_itself.columns_solved(), 1 + 2);
  EXPECT_TRUE(by_itself.holds(sum));
}

TEST(SubdomainFactor, ColumnsUsedLastStay) {
  const AnalysisBody body = make_block({{"cubic", Pattern::cubic, Surface::none}, false, false, 6});
  const std::vector<double> secants = intact(body.network), no_ground;
  SubdomainSolverOptions small = fine;
  small.window = 4 * block_width;
  SubdomainFactor subdomains(body.network, small);
  subdomains.begin(body.unknowns, secants, no_ground);
  std::vector<SparseVector> held;
  std::vector<bool> taken(static_cast<std::size_t>(body.network.particles.size()), false);
  for (Index e = 0; e < body.network.num_elements() && held.size() < 5 * block_width; ++e) {
    const Index first = body.network.bonds.first[e], second = body.network.bonds.second[e];
    if (taken[first] || taken[second]) continue;  // no two make up a third
    const SparseVector x = element_vectors(body.network, body.unknowns, e, 1.0).x[0];
    if (x.size() == 0) continue;
    taken[first] = taken[second] = true;
    held.push_back(x);
    if (held.size() % block_width != 0) continue;
    if (held.size() == 5 * block_width) subdomains.columns({&held[0], 1});
    subdomains.hold(std::span(held).last(block_width));
  }
  ASSERT_EQ(held.size(), 5u * block_width);
  // The fifth block found the cache full: half of it stayed, and the first column, used last.
  for (std::size_t k = 0; k < held.size(); ++k) {
    const bool stays = k == 0 || (k >= 2 * block_width && k != 3 * block_width - 1);
    EXPECT_EQ(subdomains.holds(held[k]), stays) << k;
  }
}

TEST(SubdomainFactor, KeepsColumnsThatMemoryHasRoomFor) {
  const std::size_t most = 4'000'000'000 / 8;  // numbers in 4 GB
  EXPECT_EQ(columns_of_window(3'000), 256u);
  EXPECT_EQ(columns_of_window(most / 100), 100u / block_width * block_width);
  EXPECT_EQ(columns_of_window(most), 64u);
}

/// Elements whose unknowns are in the window, and those that are in it themselves.
TEST(SubdomainFactor, UnknownsSayWhatVectorsSay) {
  const AnalysisBody body = make_block({{"cubic", Pattern::cubic, Surface::none}, false, false, 5});
  std::vector<double> secants = intact(body.network);
  const std::vector<double> no_ground;
  SubdomainFactor vectors(body.network, fine), unknowns(body.network, fine);
  vectors.begin(body.unknowns, secants, no_ground);
  unknowns.begin(body.unknowns, secants, no_ground);
  std::vector<double> motion = body.unknowns.restrict(body.loads.forces);
  vectors.solve(motion, motion);
  std::vector<double> other = motion;
  for (Index e = 0; e < body.network.num_elements() && e < 100; e += 9) {
    const SparseVector x =
        element_vector(body.network, body.unknowns, e, body.network.stiffness[e]);
    if (x.size() == 0) continue;
    for (const Index unknown : x.rows) unknowns.pivot(unit(unknown));
    const Index before = unknowns.columns_solved();
    const double pivot = vectors.pivot(x), load = 0.0;
    EXPECT_NEAR(unknowns.pivot(x), pivot, closeness);
    EXPECT_EQ(unknowns.columns_solved(), before);
    if (pivot < 0.2) continue;
    secants[e] = 0.0;
    vectors.downdate({&x, 1}, {&load, 1}, {&pivot, 1}, motion);
    unknowns.downdate({&x, 1}, {&load, 1}, {&pivot, 1}, other);
    ASSERT_LT(largest_difference(motion, other), closeness);
  }
  EXPECT_GT(unknowns.columns_solved(), vectors.columns_solved());
}

/// The elements of a corner particle are reduced one by one to a two hundredth; the last of them
/// hold it.
TEST(SubdomainFactor, FollowsSmallPivots) {
  const AnalysisBody body = make_block({{"cubic", Pattern::cubic, Surface::none}, false, false, 5});
  std::vector<double> secants = intact(body.network);
  const std::vector<double> no_ground;
  SubdomainFactor subdomains(body.network, fine);
  subdomains.begin(body.unknowns, secants, no_ground);
  const auto factor = make_factor(FactorRoute::in_place, 1);
  factor->factorize(assemble_stiffness(body.network, secants, body.unknowns),
                    body.unknowns.owners());
  const Index corner = body.network.particles.size() - 1;
  double smallest = 1.0;
  for (Index e = 0; e < body.network.num_elements(); ++e) {
    if (body.network.bonds.first[e] != corner && body.network.bonds.second[e] != corner) continue;
    const SparseVector x =
        element_vector(body.network, body.unknowns, e, 0.995 * body.network.stiffness[e]);
    if (x.size() == 0) continue;
    const double pivot = factor->pivot(x), load = 0.0;
    EXPECT_NEAR(subdomains.pivot(x), pivot, closeness);
    smallest = std::min(smallest, pivot);
    secants[e] = 0.005;
    subdomains.downdate({&x, 1}, {&load, 1}, {&pivot, 1}, {});
    factor->downdate({&x, 1}, {&load, 1}, {&pivot, 1}, {});
  }
  EXPECT_LT(smallest, 0.05);
}

/// Columns that were solved for after the secants have changed would take the change twice.
TEST(SubdomainFactor, ChangesOnlyWhatItHolds) {
  const AnalysisBody body = make_block({{"cubic", Pattern::cubic, Surface::none}});
  const std::vector<double> secants = intact(body.network), no_ground;
  SubdomainFactor subdomains(body.network, fine);
  subdomains.begin(body.unknowns, secants, no_ground);
  SparseVector x;
  x.add(5, 1.0);
  const double load = 0.0, pivot = 0.5;
  EXPECT_THROW(subdomains.downdate({&x, 1}, {&load, 1}, {&pivot, 1}, {}), std::logic_error);
  subdomains.hold({&x, 1});
  EXPECT_NO_THROW(subdomains.downdate({&x, 1}, {&load, 1}, {&pivot, 1}, {}));
}

}  // namespace
}  // namespace perilink

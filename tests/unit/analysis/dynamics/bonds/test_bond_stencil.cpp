#include "analysis/dynamics/bonds/bond_stencil.hpp"

#include <gtest/gtest.h>

#include <set>

#include "support/analysis_bodies.hpp"
#include "support/clouds.hpp"
#include "support/stencil_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

class BondStencils : public testing::TestWithParam<StencilCase> {};

/// Every slot leads to the ends of its element, and every element has one slot at either end or is
/// left to others.
TEST_P(BondStencils, HoldBothHalvesOfEveryBond) {
  const Network network = stencil_network(GetParam());
  const BondStencil stencil = find_stencil(network);
  std::vector<int> seen(static_cast<std::size_t>(network.num_elements()), 0);
  ASSERT_EQ(stencil.groups.size(),
            (network.particles.size() + BondStencil::lanes - 1) / BondStencil::lanes);
  for (std::size_t g = 0; g < stencil.groups.size(); ++g) {
    std::size_t slot = stencil.groups[g].first_slot;
    for (const StencilLine& line : stencil.patterns[stencil.groups[g].pattern]) {
      for (int k = 0; k < BondStencil::line_slots; ++k, ++slot) {
        const Index e = stencil.element[slot];
        if (e == no_index) continue;
        const Index own = static_cast<Index>(g) * BondStencil::lanes + k % BondStencil::lanes;
        const bool incoming = k >= BondStencil::lanes;
        EXPECT_EQ(network.bonds.first[e], incoming ? own - line.in : own);
        EXPECT_EQ(network.bonds.second[e], incoming ? own : own + line.out);
        const BondKind& kind = stencil.kinds[line.kind];
        EXPECT_NEAR(kind.length, network.bonds.lengths[e], 1e-11);
        EXPECT_NEAR(kind.limit, network.critical_stretch[e] * kind.length, 1e-11);
        seen[e] += incoming ? 10 : 1;
      }
    }
  }
  for (const Index e : stencil.rest) seen[e] += 11;
  for (const int count : seen) EXPECT_EQ(count, 11);
}

/// Surfaces, holes and interfaces leave few bonds to others: not even a tenth.
TEST_P(BondStencils, HoldNearlyAllBondsOfLattices) {
  const Network network = stencil_network(GetParam());
  const BondStencil stencil = find_stencil(network);
  EXPECT_LT(10 * stencil.rest.size(), static_cast<std::size_t>(network.num_elements()));
}

INSTANTIATE_TEST_SUITE_P(Bodies, BondStencils, testing::ValuesIn(stencil_cases()),
                         [](const auto& tested) { return tested.param.name; });

/// With a horizon of 2.5 spacings a particle of a square lattice has 20 neighbours: ten kinds.
TEST(BondStencil, KindsOfASquareLattice) {
  const Network network = make_network({"", Pattern::rectangular, Surface::none}, 20);
  const BondStencil stencil = find_stencil(network);
  EXPECT_EQ(stencil.kinds.size(), 10U);
  EXPECT_TRUE(stencil.rest.empty());
}

TEST(BondStencil, CloudsHaveNone) {
  const Body particle_set = make_unstructured(1, 4);
  const Network network = build_network(particle_set, network_input(body_input({}, 4)));
  const BondStencil stencil = find_stencil(network);
  EXPECT_TRUE(stencil.kinds.empty());
  EXPECT_EQ(stencil.rest.size(), static_cast<std::size_t>(network.num_elements()));
}

/// The stencil is empty also where too many bonds differ to find recurring ones.
TEST(BondStencil, BodiesWithoutOrderHaveNone) {
  Network network = make_network({"", Pattern::rectangular, Surface::none}, 90);
  for (Index e = 0; e < network.num_elements(); ++e) network.stiffness[e] *= 1.0 + 1e-5 * e;
  ASSERT_GT(network.num_elements(), 1 << 16);
  EXPECT_TRUE(find_stencil(network).kinds.empty());
}

TEST(BondStencil, LeavesBarsToOthers) {
  const AnalysisBody body =
      make_block({{"plane", Pattern::rectangular, Surface::none}, false, true, 12, 0.0});
  const BondStencil stencil = find_stencil(body.network);
  const std::set<Index> rest(stencil.rest.begin(), stencil.rest.end());
  EXPECT_FALSE(stencil.kinds.empty());
  for (Index e = body.network.first_bar_element; e < body.network.num_elements(); ++e) {
    EXPECT_TRUE(rest.contains(e));
  }
}

/// A slot holds one bond: of two between the same particles the second is left to others.
TEST(BondStencil, HoldsOneOfTwoBondsSideBySide) {
  Network network = make_network({"", Pattern::rectangular, Surface::none}, 20);
  const Index copied = 100, added = network.num_elements();
  const auto again = [&](auto& values, std::size_t at) { values.push_back(values[at]); };
  again(network.bonds.first, copied);
  again(network.bonds.second, copied);
  again(network.bonds.lengths, copied);
  again(network.bonds.directions, 2 * copied);
  again(network.bonds.directions, 2 * copied + 1);
  again(network.stiffness, copied);
  again(network.critical_stretch, copied);
  network.first_slip_spring = network.first_bar_element = network.num_elements();
  EXPECT_EQ(find_stencil(network).rest, std::vector<Index>{added});
}

/// A bond that is a millionth stiffer than the others of its kind is no bond of that kind.
TEST(BondStencil, TellsBondsApart) {
  Network network = make_network({"", Pattern::rectangular, Surface::none}, 20);
  network.stiffness[100] *= 1.0 + 1e-6;
  network.critical_stretch[200] *= 1.0 - 1e-9;
  EXPECT_EQ(find_stencil(network).rest, (std::vector<Index>{100, 200}));
}

}  // namespace
}  // namespace perilink

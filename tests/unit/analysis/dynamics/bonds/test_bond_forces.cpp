#include "analysis/dynamics/bonds/bond_forces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>

#include "analysis/dynamics/time_state.hpp"
#include "assembly/internal_force.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

BondMotion motion_of_body(const AnalysisBody& body, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-size, size);
  BondMotion motion;
  for (std::size_t slot = 0; slot < body.unknowns.number.size(); ++slot) {
    motion.displacement.push_back(any(random));
    motion.velocity.push_back(any(random));
  }
  return motion;
}

struct Forces {
  std::vector<double> force;
  BondLosses losses;
};

Forces all_forces(const AnalysisBody& body, ExplicitBonds& bonds, const BondMotion& motion,
                  double time_step) {
  Forces result;
  result.force.assign(motion.displacement.size(), 0.0);
  result.losses = bonds.forces(0, body.network.particles.size(), time_step, motion, result.force);
  return result;
}

void expect_near(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], tolerance) << k;
}

class HalvesOfBlocks : public testing::TestWithParam<BlockCase> {};

/// Round-off of sums of some forty forces of size one.
constexpr double round_off = 1e-12;

/// In bodies that carry moments some bonds are hinged at one end.
TEST_P(HalvesOfBlocks, ForcesAreThoseOfTheNetwork) {
  AnalysisBody body = make_block(GetParam());
  if (body.network.carries_moments()) {
    for (Index e = 0; e < body.network.num_elements(); ++e) {
      const int ends = e % 3 == 2 ? first_end : e % 3 == 1 ? second_end : 0;
      body.network.hinged.push_back(static_cast<std::uint8_t>(ends));
      body.network.inflection.push_back(ends == 0 ? 0.5 : ends == first_end ? 0.0 : 1.0);
    }
  }
  std::fill(body.network.critical_stretch.begin(), body.network.critical_stretch.end(), INFINITY);
  const BondMotion motion = motion_of_body(body, 1.0, 3);
  const auto bonds = make_explicit_bonds(body.network);
  const Forces found = all_forces(body, *bonds, motion, 0.1);
  const InternalForce expected =
      internal_force(body.network, intact(body.network), motion.displacement);
  double largest = 0.0;
  for (const double f : expected.forces) largest = std::max(largest, std::abs(f));
  expect_near(found.force, expected.forces, round_off * largest);
  EXPECT_EQ(found.losses.broken_halves(), 0);
  EXPECT_EQ(found.losses.fractured, 0.0);
  // With no velocity the stored energy is that of the displacement.
  BondMotion still = motion;
  std::fill(still.velocity.begin(), still.velocity.end(), 0.0);
  EXPECT_NEAR(bonds->stored(0, body.network.particles.size(), 0.1, still), expected.energy,
              round_off * expected.energy);
}

/// Which bonds break is compared with the energies of textbook beams: a bond in tension breaks
/// where 2 U / (k xi^2) exceeds the square of its critical stretch.
TEST_P(HalvesOfBlocks, BondsBreakWhereTheirEnergyIsTooLarge) {
  const AnalysisBody body = make_block(GetParam());
  const Network& network = body.network;
  const BondMotion motion = motion_of_body(body, 0.04, 5);
  const auto bonds = make_explicit_bonds(network);
  const Forces found = all_forces(body, *bonds, motion, 0.1);
  const std::vector<double> secants = bonds->secants();
  Index broken = 0;
  for (Index e = 0; e < network.first_bar_element; ++e) {
    const std::size_t first = static_cast<std::size_t>(network.bonds.first[e]) * network.width();
    const std::size_t second = static_cast<std::size_t>(network.bonds.second[e]) * network.width();
    double extension = 0.0;
    for (int a = 0; a < network.dim(); ++a) {
      extension += network.bonds.direction(e)[a] *
                   (motion.displacement[second + a] - motion.displacement[first + a]);
    }
    const double length = network.bonds.lengths[e];
    const double demand = 2.0 * element_energy(network, motion.displacement, e) /
                          (network.stiffness[e] * length * length);
    const double limit = network.critical_stretch[e] * network.critical_stretch[e];
    const bool breaks = extension > 0.0 && demand > limit;
    EXPECT_EQ(secants[e], breaks ? 0.0 : 1.0) << e;
    broken += breaks;
  }
  ASSERT_GT(broken, 0);
  ASSERT_LT(broken, network.first_bar_element);
  EXPECT_EQ(found.losses.broken_halves(), 2 * broken);
  const InternalForce expected = internal_force(network, secants, motion.displacement);
  double largest = 0.0;
  for (const double f : expected.forces) largest = std::max(largest, std::abs(f));
  expect_near(found.force, expected.forces, round_off * largest);
}

/// u_(n-1)' (K before - K after) u_n / 2 is what was lost.
TEST_P(HalvesOfBlocks, LossesAreTheDifferenceOfStoredEnergies) {
  const AnalysisBody body = make_block(GetParam());
  const BondMotion motion = motion_of_body(body, 0.04, 7);
  const auto bonds = make_explicit_bonds(body.network);
  const Index all = body.network.particles.size();
  const double before = bonds->stored(0, all, 0.3, motion);
  const Forces found = all_forces(body, *bonds, motion, 0.3);
  const double after = bonds->stored(0, all, 0.3, motion);
  ASSERT_GT(found.losses.broken_halves(), 0);
  EXPECT_NEAR(found.losses.fractured, before - after, round_off * std::abs(before));
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, HalvesOfBlocks,
    testing::Values(
        BlockCase{{"plane", Pattern::rectangular, Surface::none}},
        BlockCase{{"plane", Pattern::rectangular, Surface::none}, false, true},
        BlockCase{{"space", Pattern::cubic, Surface::none}, false, false, 4},
        BlockCase{{"plane", Pattern::rectangular, Surface::none}, false, false, 6, 0.1, true},
        BlockCase{{"space", Pattern::cubic, Surface::none}, false, false, 4, 0.1, true}),
    [](const auto& body) { return to_string(body.param) + std::to_string(body.index); });

/// Bars fall at once to the segment that resists the demand, and the lost energy is counted;
/// compression changes nothing.
TEST(ExplicitBonds, FallToTheToothOnWhichTheyHold) {
  const AnalysisBody body = make_block(
      {{"plane", Pattern::rectangular, Surface::none}, false, false, 6, 0.0, false, true});
  const Network& network = body.network;
  const double critical =
      *std::min_element(network.critical_stretch.begin(), network.critical_stretch.end());
  const auto segment_at = [](double stretch) {
    return stretch > 3.0 ? 0.0 : stretch > 1.4 ? 0.2 : stretch > 1.0 ? 0.6 : 1.0;
  };
  for (const double strain : {0.9, 1.2, 2.1, 4.1, -4.1}) {
    BondMotion motion;
    motion.displacement = linear_field(network.particles, {{{strain * critical, 0, 0}, {}, {}}});
    motion.velocity.assign(motion.displacement.size(), 0.0);
    const auto bonds = make_explicit_bonds(network);
    const Forces found = all_forces(body, *bonds, motion, 0.1);
    const std::vector<double> secants = bonds->secants();
    int broken = 0;
    double lost = 0.0;
    for (Index e = 0; e < network.num_elements(); ++e) {
      const double n = network.bonds.direction(e)[0], stretch = strain * critical * n * n;
      const double expected = segment_at(stretch / network.critical_stretch[e]);
      EXPECT_EQ(secants[e], expected) << strain << " " << e;
      broken += expected == 0.0;
      lost += 0.5 * network.stiffness[e] * (1.0 - expected) *
              std::pow(stretch * network.bonds.lengths[e], 2);
    }
    EXPECT_EQ(found.losses.broken_halves(), 2 * broken);
    EXPECT_NEAR(found.losses.fractured, lost, 1e-12 * lost);  // round-off of some 200 terms
  }
}

/// A bar that is stretched to seven times its yield strain holds about its yield force, on either
/// side of zero.
TEST(ExplicitBonds, BarsYieldEitherWay) {
  AnalysisBody body = make_block({{"plane", Pattern::rectangular, Surface::none}, false, true});
  Network& network = body.network;
  ASSERT_LT(network.first_bar_element, network.num_elements());
  std::fill_n(network.critical_stretch.begin(), network.first_bar_element, INFINITY);
  const double yield = network.critical_stretch[network.first_bar_element];
  for (const double strain : {7.0 * yield, -7.0 * yield}) {
    BondMotion motion;
    motion.displacement = linear_field(network.particles, {{{strain, 0, 0}, {}, {}}});
    motion.velocity.assign(motion.displacement.size(), 0.0);
    const auto bonds = make_explicit_bonds(network);
    const Forces found = all_forces(body, *bonds, motion, 0.1);
    const std::vector<double> secants = bonds->secants();
    for (Index e = network.first_bar_element; e < network.num_elements(); ++e) {
      // Segments lie within a factor sqrt(1.05) of the plateau.
      EXPECT_NEAR(secants[e] * 7.0, 1.0, 0.025);
    }
    EXPECT_EQ(found.losses.broken_halves(), 0);
    EXPECT_GT(found.losses.fractured, 0.0);
  }
}

TEST(ExplicitBonds, BondsWithMomentsHaveSmallStrainsOnly) {
  const AnalysisBody body =
      make_block({{"plane", Pattern::rectangular, Surface::none}, false, false, 6, 0.1, true});
  EXPECT_THROW(make_explicit_bonds(body.network, Strain::green), std::invalid_argument);
}

/// After a motion in which some bonds change their segment repeatedly and others break.
TEST(ExplicitBonds, RestoredOnesPullAsTheSavedOnes) {
  for (const bool micropolar : {false, true}) {
    AnalysisBody body = make_block({.lattice = {"plane", Pattern::rectangular, Surface::none},
                                    .micropolar = micropolar,
                                    .toothed = true});
    const std::vector<double>& limits = body.network.critical_stretch;
    const double size = 0.5 * *std::min_element(limits.begin(), limits.end());
    const auto bonds = make_explicit_halves(body.network);
    for (const double part : {0.4, 0.6, 0.9}) {
      all_forces(body, *bonds, motion_of_body(body, part * size, 3), 0.1);
    }
    MovingElements state;
    bonds->save(state);
    ASSERT_GT(state.changed.size(), 20U);
    const auto restored = make_explicit_halves(body.network);
    restored->restore(state);
    EXPECT_EQ(restored->secants(), bonds->secants());
    for (const double part : {0.5, 2.0}) {
      const BondMotion motion = motion_of_body(body, part * size, 4);
      const Forces expected = all_forces(body, *bonds, motion, 0.1);
      const Forces found = all_forces(body, *restored, motion, 0.1);
      EXPECT_EQ(found.force, expected.force);
      EXPECT_EQ(found.losses.fractured, expected.losses.fractured);
      EXPECT_EQ(found.losses.broken, expected.losses.broken);
    }
    const auto small = make_explicit_halves(make_chains(1, 2, true, 1.0, 1.0).network);
    EXPECT_THROW(small->restore(state), std::invalid_argument);
  }
}

}  // namespace
}  // namespace perilink

#include "network/builder/bar_elements.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "discretization/lattices/make_body.hpp"
#include "network/builder/network_builder.hpp"
#include "network/unknowns.hpp"
#include "support/small_networks.hpp"

namespace perilink {
namespace {

using namespace test;

/// A square body with one bar across it, off the rows of particles.
struct Barred {
  LatticeInput body = body_input({"", Pattern::rectangular, Surface::none}, 8);
  NetworkInput input = network_input(body);

  Barred() {
    RebarLine bar{{0.1, 0.43, 0.0}, {0.9, 0.57, 0.0}};
    bar.embedded = true;
    input.bars = {bar};
    BarMaterial material{200.0, 0.01};
    material.bond.perimeter = 0.4;
    input.bar_materials = {material};
  }
  Network build() const { return build_network(make_body(body), input); }
  BarMaterial& material() { return input.bar_materials[0]; }
};

TEST(BarElements, EveryNodeHasAnAnchorAndTiesAlongAndAcross) {
  const Network network = Barred().build();
  const Index nodes = network.num_elements() - network.first_bar_element + 1;
  EXPECT_EQ(network.embedded_points.size(), nodes);
  EXPECT_EQ(network.first_bar_element - network.first_embedded_slip_spring, 2 * nodes);
  EXPECT_EQ(network.first_embedded_slip_spring, network.first_slip_spring);
  for (Index e = network.first_slip_spring; e < network.first_bar_element; e += 2) {
    const Index node = network.bonds.first[e], embedded_point = network.bonds.second[e];
    EXPECT_EQ(network.particles.kind[node], ParticleKind::rebar);
    EXPECT_EQ(network.particles.kind[embedded_point], ParticleKind::embedded_point);
    EXPECT_TRUE(network.is_embedded(e));
    const auto along = network.bonds.direction(e), across = network.bonds.direction(e + 1);
    EXPECT_NEAR(along[0] * across[0] + along[1] * across[1], 0.0, 1e-14);
    EXPECT_LT(along[0], 0.0) << "a node that moves along the bar lengthens its tie";
    EXPECT_FALSE(network.has_limit(e));
    EXPECT_EQ(network.stiffness[e], network.stiffness[e + 1]);
  }
}

/// Slips of linear motions are zero: anchors move as the solid does.
TEST(BarElements, AnchorsFollowLinearMotions) {
  const Network network = Barred().build();
  std::vector<double> motion;
  for (Index i = 0; i < network.particles.size(); ++i) {
    const auto x = network.particles.position(i);
    const bool embedded_point = network.is_embedded_point(i);
    motion.push_back(embedded_point ? 0.0 : 0.1 + 0.2 * x[0] - 0.3 * x[1]);
    motion.push_back(embedded_point ? 0.0 : 0.4 * x[0] + 0.5 * x[1]);
  }
  follow_particles(network, motion);
  for (Index i = network.first_embedded_point(); i < network.particles.size(); ++i) {
    const auto x = network.particles.position(i);
    EXPECT_NEAR(motion[2 * i], 0.1 + 0.2 * x[0] - 0.3 * x[1], 1e-13);
    EXPECT_NEAR(motion[2 * i + 1], 0.4 * x[0] + 0.5 * x[1], 1e-13);
  }
}

TEST(BarElements, BondGivesTiesAlongTheBarTheirStiffnessAndLaw) {
  Barred barred;
  barred.material().bond.curve = ForceCurve{{{0.002, 6.0}, {0.01, 8.0}}};
  barred.material().bond.hook_to = true;
  const Network network = barred.build();
  double surface = 0.0;
  const Index last = network.first_bar_element - 2;
  for (Index e = network.first_slip_spring; e < last; e += 2) {
    surface += network.stiffness[e] / (6.0 / 0.002);
    EXPECT_NEAR(network.critical_stretch[e] * network.bonds.lengths[e], 0.002, 1e-15);
    EXPECT_TRUE(network.law(e).endless());
    EXPECT_FALSE(network.has_limit(e + 1));
  }
  EXPECT_FALSE(network.has_limit(last)) << "a hook does not slip";
  const double length = std::hypot(0.8, 0.14);
  const double of_last = 0.5 * network.bonds.lengths[network.first_bar_element];
  EXPECT_NEAR(surface, 0.4 * (length - of_last), 1e-13);
}

TEST(BarElements, WhereNothingIsNearTheyHangOnTheirBar) {
  Barred barred;
  barred.input.bars[0].to = {3.0, 0.5, 0.0};
  const Network network = barred.build();
  const Index nodes = network.num_elements() - network.first_bar_element + 1;
  EXPECT_LT(network.embedded_points.size(), nodes);
  EXPECT_GT(network.embedded_points.size(), 0);
}

TEST(BarElements, CracksKeepAnchorsOnTheirSide) {
  Barred barred;
  barred.input.cracks = {{{{0.53, -1.0, 0.0}, {0.53, 3.0, 0.0}}}};
  const Network network = barred.build();
  for (Index k = 0; k < network.embedded_points.size(); ++k) {
    const double x = network.particles.position(network.first_embedded_point() + k)[0];
    for (const Index i : network.embedded_points.particles.row(k)) {
      EXPECT_EQ(network.particles.position(i)[0] > 0.53, x > 0.53);
    }
  }
}

TEST(BarElements, ThoseThatBendAreFramesAndThoseThatShiftEndAtAnchors) {
  Barred barred;
  barred.material().bends = true;
  barred.material().shifts = true;
  const Network network = barred.build();
  ASSERT_TRUE(network.carries_moments());
  const double inertia = 0.01 * 0.01 / (4.0 * std::numbers::pi);
  for (Index e = network.first_bar_element; e < network.num_elements(); ++e) {
    const double length = network.bonds.lengths[e];
    EXPECT_NEAR(network.bending[e], 12.0 * 200.0 * inertia / std::pow(length, 3),
                1e-12 * network.bending[e]);
    ASSERT_TRUE(network.is_embedded_point(network.bonds.second[e]));
    const Index embedded_point = network.bonds.second[e] - network.first_embedded_point();
    EXPECT_EQ(network.embedded_points.particles.row(embedded_point).size(), 1u);
  }
  EXPECT_EQ(network.bending[0], 0.0);
}

TEST(BarElements, SteelHasItsOwnCurve) {
  Barred barred;
  barred.material().yield_strength = 0.4;
  EXPECT_TRUE(barred.build().law(barred.build().num_elements() - 1).endless());
  barred.material().curve = ForceCurve{{{0.002, 0.4}, {0.05, 0.5}}, false};
  const Network network = barred.build();
  const Index e = network.num_elements() - 1;
  EXPECT_EQ(network.critical_stretch[e], 0.002);
  EXPECT_TRUE(network.can_break(e));
  ASSERT_EQ(network.bars.curves.size(), 1u);
  EXPECT_NEAR(network.bars.curves[0].points[1][0], 25.0, 1e-12);
  EXPECT_NEAR(network.bars.curves[0].points[1][1], 1.25, 1e-12);
}

}  // namespace
}  // namespace perilink

#include <gtest/gtest.h>

#include <cmath>

#include "discretization/lattices/lattice.hpp"
#include "discretization/lattices/make_body.hpp"
#include "discretization/rebar.hpp"

namespace perilink {
namespace {

Particles rebar_square(Surface surface = Surface::none) {
  LatticeInput input;
  input.pattern = Pattern::rectangular;
  input.surface = surface;
  input.spacing = 0.1;
  input.horizon = 0.2;
  input.solid = {{{0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}}};
  input.material = {0};
  return make_body(input).particles;
}

TEST(Rebar, DividesABarAndTiesItsNodes) {
  Particles particles = rebar_square();
  const Index before = particles.size();
  const RebarMesh mesh =
      add_rebar(particles, {{{0.05, 0.55, 0.0}, {0.95, 0.55, 0.0}}}, 0.1, 0.2, 0.01);
  EXPECT_EQ(particles.size(), before + 10);
  EXPECT_EQ(mesh.segments.size(), 9);
  for (const double length : mesh.segments.lengths) EXPECT_NEAR(length, 0.1, 1e-15);
  for (Index node = before; node < particles.size(); ++node) {
    EXPECT_EQ(particles.kind[node], ParticleKind::rebar);
    EXPECT_EQ(particles.volumes[node], 0.01);
    EXPECT_EQ(particles.material[node], no_index);
  }
  // A node in the middle of a cell has 12 particles within two spacings: 4 at sqrt(1/2), 8 at
  // sqrt(5/2) spacings.
  const Csr neighbourhoods = bonds_of_particles(mesh.ties, particles.size());
  EXPECT_EQ(neighbourhoods.row(before + 5).size(), 12U);
  for (Index tie = 0; tie < mesh.ties.size(); ++tie) {
    EXPECT_LT(mesh.ties.first[tie], before);
    EXPECT_GE(mesh.ties.second[tie], before);
    EXPECT_LE(mesh.ties.lengths[tie], 0.2 * (1.0 + horizon_tolerance));
  }
}

TEST(Rebar, ANodeOnAParticleIsThatParticle) {
  Particles particles = rebar_square();
  const Index before = particles.size();
  const RebarMesh mesh =
      add_rebar(particles, {{{0.0, 0.5, 0.0}, {1.0, 0.5 + 1e-8, 0.0}}}, 0.1, 0.2, 0.01);
  EXPECT_EQ(particles.size(), before);
  EXPECT_EQ(mesh.segments.size(), 10);
  EXPECT_EQ(mesh.ties.size(), 0);
  for (Index s = 0; s < 10; ++s) EXPECT_EQ(mesh.segments.second[s], mesh.segments.first[s] + 1);
}

TEST(Rebar, CrossingBarsShareTheirNode) {
  Particles particles = rebar_square();
  const Index before = particles.size();
  const std::vector<RebarLine> bars = {{{0.05, 0.55, 0.0}, {0.95, 0.55, 0.0}},
                                       {{0.55, 0.05, 0.0}, {0.55, 0.95, 0.0}}};
  const RebarMesh mesh = add_rebar(particles, bars, 0.1, 0.2, 0.01);
  EXPECT_EQ(particles.size(), before + 19);
  EXPECT_EQ(mesh.segments.size(), 18);
  EXPECT_EQ(mesh.bar_of_element.front(), 0);
  EXPECT_EQ(mesh.bar_of_element.back(), 1);
  const Csr neighbourhoods = bonds_of_particles(mesh.segments, particles.size());
  EXPECT_EQ(neighbourhoods.row(before + 5).size(), 4U);
}

TEST(Rebar, IsNotTiedToGhosts) {
  Particles particles = rebar_square(Surface::ghost);
  const RebarMesh mesh =
      add_rebar(particles, {{{0.0, 0.57, 0.0}, {1.0, 0.57, 0.0}}}, 0.1, 0.2, 0.01);
  for (const Index solid : mesh.ties.first) {
    EXPECT_EQ(particles.kind[solid], ParticleKind::solid);
  }
}

TEST(Rebar, AnchoredBarsHaveNodesOfTheirOwn) {
  Particles particles = rebar_square();
  const Index before = particles.size();
  RebarLine bar{{0.0, 0.5, 0.0}, {0.5, 0.0, 0.0}, {{0.5, 0.5, 0.0}}};
  bar.embedded = true;
  const RebarMesh mesh = add_rebar(particles, {bar, bar}, 0.1, 0.2, 0.01);
  EXPECT_EQ(particles.size(), before + 22) << "not even bars in one place share nodes";
  EXPECT_EQ(mesh.ties.size(), 0);
  ASSERT_EQ(mesh.embedded.size(), 22u);
  double length = 0.0;
  for (std::size_t k = 0; k < 11; ++k) length += mesh.embedded[k].length;
  EXPECT_NEAR(length, 1.0, 1e-14);
  EXPECT_TRUE(mesh.embedded[0].begins);
  EXPECT_TRUE(mesh.embedded[10].ends);
  EXPECT_EQ(mesh.embedded[11].bar, 1);
  EXPECT_NEAR(mesh.embedded[2].along[0], 1.0, 1e-14);
  EXPECT_NEAR(mesh.embedded[5].along[0], std::sqrt(0.5), 1e-14);  // at the bend
  EXPECT_NEAR(mesh.embedded[5].along[1], -std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(mesh.embedded[5].length, 0.1, 1e-14);
  EXPECT_NEAR(mesh.embedded[10].along[1], -1.0, 1e-14);
}

TEST(Rebar, NodesAreTiedToTheLengthInTheBody) {
  for (const double face : {1.0, 1.03, 0.97}) {
    Particles particles = rebar_square();
    RebarLine bar{{0.5, 1.4, 0.0}, {0.5, 0.2, 0.0}};
    bar.embedded = true;
    bar.inside = [face](const Vector3& x) { return x[1] <= face + 1e-12; };
    const RebarMesh mesh = add_rebar(particles, {bar}, 0.1, 0.2, 0.01);
    double length = 0.0;
    for (const BarNode& node : mesh.embedded) {
      length += node.length;
      const bool in_air = particles.position(node.particle)[1] > face + 1e-9;
      EXPECT_EQ(node.length == 0.0, in_air);
    }
    EXPECT_NEAR(length, face - 0.2, 1e-9);
  }
}

TEST(Rebar, AStirrupEndsAtItsFirstNode) {
  Particles particles = rebar_square();
  const Index before = particles.size();
  RebarLine bar{
      {0.2, 0.2, 0.0}, {0.2, 0.2, 0.0}, {{0.8, 0.2, 0.0}, {0.8, 0.8, 0.0}, {0.2, 0.8, 0.0}}};
  bar.embedded = true;
  const RebarMesh mesh = add_rebar(particles, {bar}, 0.1, 0.2, 0.01);
  EXPECT_EQ(particles.size(), before + 24);
  EXPECT_EQ(mesh.segments.size(), 24);
  EXPECT_EQ(mesh.turned.back(), 1);
  for (const BarNode& node : mesh.embedded) {
    EXPECT_NEAR(node.length, 0.1, 1e-14);
    EXPECT_FALSE(node.begins || node.ends);
  }
  EXPECT_NEAR(mesh.embedded[0].along[0], std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(mesh.embedded[0].along[1], -std::sqrt(0.5), 1e-14);
}

TEST(Rebar, RefusesABarWithoutLength) {
  Particles particles = rebar_square();
  EXPECT_THROW(add_rebar(particles, {{{0.5, 0.5, 0.0}, {0.5, 0.5, 0.0}}}, 0.1, 0.2, 0.01),
               std::invalid_argument);
}

}  // namespace
}  // namespace perilink

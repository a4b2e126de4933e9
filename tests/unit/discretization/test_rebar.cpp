#include <gtest/gtest.h>

#include <cmath>

#include "discretization/lattices/lattice.hpp"
#include "discretization/lattices/make_body.hpp"
#include "discretization/rebar.hpp"

namespace perilink {
namespace {

Particles square(Surface surface = Surface::none) {
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
  Particles particles = square();
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
  const Csr families = bonds_of_particles(mesh.ties, particles.size());
  EXPECT_EQ(families.row(before + 5).size(), 12U);
  for (Index tie = 0; tie < mesh.ties.size(); ++tie) {
    EXPECT_LT(mesh.ties.first[tie], before);
    EXPECT_GE(mesh.ties.second[tie], before);
    EXPECT_LE(mesh.ties.lengths[tie], 0.2 * (1.0 + horizon_tolerance));
  }
}

TEST(Rebar, ANodeOnAParticleIsThatParticle) {
  Particles particles = square();
  const Index before = particles.size();
  const RebarMesh mesh =
      add_rebar(particles, {{{0.0, 0.5, 0.0}, {1.0, 0.5 + 1e-8, 0.0}}}, 0.1, 0.2, 0.01);
  EXPECT_EQ(particles.size(), before);
  EXPECT_EQ(mesh.segments.size(), 10);
  EXPECT_EQ(mesh.ties.size(), 0);
  for (Index s = 0; s < 10; ++s) EXPECT_EQ(mesh.segments.second[s], mesh.segments.first[s] + 1);
}

TEST(Rebar, CrossingBarsShareTheirNode) {
  Particles particles = square();
  const Index before = particles.size();
  const std::vector<RebarLine> bars = {{{0.05, 0.55, 0.0}, {0.95, 0.55, 0.0}},
                                       {{0.55, 0.05, 0.0}, {0.55, 0.95, 0.0}}};
  const RebarMesh mesh = add_rebar(particles, bars, 0.1, 0.2, 0.01);
  EXPECT_EQ(particles.size(), before + 19);
  EXPECT_EQ(mesh.segments.size(), 18);
  EXPECT_EQ(mesh.bar_of_segment.front(), 0);
  EXPECT_EQ(mesh.bar_of_segment.back(), 1);
  const Csr families = bonds_of_particles(mesh.segments, particles.size());
  EXPECT_EQ(families.row(before + 5).size(), 4U);
}

TEST(Rebar, IsNotTiedToGhosts) {
  Particles particles = square(Surface::ghost);
  const RebarMesh mesh =
      add_rebar(particles, {{{0.0, 0.57, 0.0}, {1.0, 0.57, 0.0}}}, 0.1, 0.2, 0.01);
  for (const Index solid : mesh.ties.first) {
    EXPECT_EQ(particles.kind[solid], ParticleKind::solid);
  }
}

TEST(Rebar, RefusesABarWithoutLength) {
  Particles particles = square();
  EXPECT_THROW(add_rebar(particles, {{{0.5, 0.5, 0.0}, {0.5, 0.5, 0.0}}}, 0.1, 0.2, 0.01),
               std::invalid_argument);
}

}  // namespace
}  // namespace perilink

#include "calibration/surface_columns.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "discretization/lattices/lattice.hpp"
#include "discretization/lattices/make_body.hpp"

namespace perilink {
namespace {

/// Under the side of a square of a horizon of two spacings columns are two particles deep; deeper
/// ones stand alone.
TEST(SurfaceColumns, HangFromTheNearestParticleOfTheSurface) {
  LatticeInput input;
  input.spacing = 0.1;
  input.surface = Surface::calibrated;
  input.solid = {{{0, 0, 0}, {1, 1, 0}}};
  input.material = {0};
  const Body body = make_body(input);
  const Bonds bonds = make_bonds(body.particles, 0.2001);
  const std::vector<Index> head = surface_columns(bonds, body.facets, body.particles);
  const auto at = [&](double x, double y) {
    for (Index i = 0; i < body.particles.size(); ++i) {
      const auto p = body.particles.position(i);
      if (std::hypot(p[0] - x, p[1] - y) < 1e-9) return i;
    }
    return no_index;
  };
  EXPECT_EQ(head[at(0.5, 0.0)], at(0.5, 0.0));
  EXPECT_EQ(head[at(0.5, 0.1)], at(0.5, 0.0));
  EXPECT_EQ(head[at(0.5, 0.2)], at(0.5, 0.0));
  EXPECT_EQ(head[at(0.5, 0.3)], at(0.5, 0.3));
  EXPECT_EQ(head[at(0.9, 0.4)], at(1.0, 0.4));
}

/// Columns stop where materials meet, and particles there belong to none.
TEST(SurfaceColumns, DoNotMixMaterials) {
  LatticeInput input;
  input.spacing = 0.1;
  input.surface = Surface::calibrated;
  input.solid = {{{0, 0, 0}, {0.5, 1, 0}}, {{0.5, 0, 0}, {1, 1, 0}}};
  input.material = {0, 1};
  const Body body = make_body(input);
  const Bonds bonds = make_bonds(body.particles, 0.3001);
  const std::vector<Index> head = surface_columns(bonds, body.facets, body.particles);
  Index without = 0, joined = 0;
  for (Index i = 0; i < body.particles.size(); ++i) {
    const auto x = body.particles.position(i);
    if (head[i] == no_index) {
      EXPECT_NEAR(x[0], 0.5, 1e-9);
      ++without;
    } else {
      EXPECT_EQ(body.particles.material[head[i]], body.particles.material[i]);
      joined += head[i] != i;
    }
  }
  EXPECT_EQ(without, 11);
  EXPECT_GT(joined, 30);
}

/// Under a side of regular triangles every second row is as far from two particles of the side: the
/// last bit of coordinates, which moves every bond's length, must not choose between them.
TEST(SurfaceColumns, DoNotDependOnRoundOff) {
  LatticeInput input;
  input.pattern = Pattern::hexagonal;
  input.spacing = 0.1;
  input.surface = Surface::calibrated;
  input.solid = {{{0, 0, 0}, {1, 1, 0}}};
  input.material = {0};
  const Body body = make_body(input);
  const double horizon = 2.0 * body.lattice.spacing;
  const auto columns = [&](const Particles& particles) {
    return surface_columns(make_bonds(particles, horizon), body.facets, particles);
  };
  const std::vector<Index> head = columns(body.particles);
  std::mt19937 random(3);
  for (int round = 0; round < 5; ++round) {
    Particles noisy = body.particles;
    for (double& x : noisy.positions) x = std::nextafter(x, random() % 2 ? 10.0 : -10.0);
    EXPECT_EQ(columns(noisy), head);
  }
}

}  // namespace
}  // namespace perilink

#include "discretization/lattices/triangulate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <set>
#include <stdexcept>

#include "discretization/lattices/make_body.hpp"

namespace perilink {
namespace {

/// A box of 2 by 1 (by 1) with a notch in its upper side, and a second material to the right.
LatticeInput notched(Pattern pattern, double spacing) {
  LatticeInput input;
  input.pattern = pattern;
  input.spacing = spacing;
  input.thickness = pattern == Pattern::cubic ? 1.0 : 3.0;
  // The notch is as deep as some rows of the hexagonal lattice, which lie 1/6 apart.
  const double tip = pattern == Pattern::hexagonal ? 0.5 : 0.6;
  input.solid = {{{0, 0, 0}, {2, tip, 1}}, {{0, tip, 0}, {0.8, 1, 1}}, {{1.2, tip, 0}, {2, 1, 1}}};
  input.material = {0, 0, 1};
  return input;
}

double thickness_of(const LatticeInput& input) {
  return input.pattern == Pattern::cubic ? 1.0 : input.thickness;
}

class Triangulation : public testing::TestWithParam<Pattern> {
 protected:
  LatticeInput input_ = notched(GetParam(), 0.2);
  Body body_ = make_body(input_);
  Simplices cells_ = triangulate(input_, body_);
};

TEST_P(Triangulation, FillsTheBodyWithCellsThatStandUpright) {
  const auto volumes = cell_volumes(cells_, body_.particles.positions, thickness_of(input_));
  for (const double volume : volumes) EXPECT_GT(volume, 0.0);
  const double sum = std::accumulate(volumes.begin(), volumes.end(), 0.0);
  const double exact =
      std::accumulate(body_.particles.volumes.begin(), body_.particles.volumes.end(), 0.0);
  EXPECT_NEAR(sum, exact, 1e-12 * exact);  // round-off of some hundred terms
}

TEST_P(Triangulation, IsConforming) {
  // Sides that only one cell has are the surface, whose area is that of the lattice's own facets: a
  // hanging particle would add inner sides to it. facets_of() refuses sides of more than two cells.
  const Facets surface = facets_of(cells_, body_.particles.positions, thickness_of(input_));
  const auto area = [](const Facets& facets) {
    double sum = 0.0;
    for (Index f = 0; f < facets.size(); ++f) {
      if (!facets.on_surface(f)) continue;
      double square = 0.0;
      for (const double component : facets.area_vector(f)) square += component * component;
      sum += std::sqrt(square);
    }
    return sum;
  };
  const double tip = input_.solid[0].upper[1];
  const double outline = 6.0 + 2.0 * (1.0 - tip);
  const double front = 2.0 - 0.4 * (1.0 - tip);
  EXPECT_NEAR(area(surface),
              GetParam() == Pattern::cubic ? outline + 2.0 * front : outline * input_.thickness,
              1e-10);
}

TEST_P(Triangulation, EveryParticleIsAVertex) {
  const std::set<Index> used(cells_.vertices.begin(), cells_.vertices.end());
  EXPECT_EQ(static_cast<Index>(used.size()), body_.particles.size());
}

TEST_P(Triangulation, CellsHaveTheMaterialOfTheirPlace) {
  for (Index number = 0; number < cells_.size(); ++number) {
    double x = 0.0, y = 0.0;
    for (const Index i : cells_.cell(number)) {
      x += body_.particles.position(i)[0] / (cells_.dim + 1);
      y += body_.particles.position(i)[1] / (cells_.dim + 1);
    }
    EXPECT_EQ(cells_.material[number], x > 1.2 && y > input_.solid[0].upper[1] ? 1 : 0);
  }
}

TEST_P(Triangulation, ShapeIntegralsAreTheVolumeAndItsFirstMoment) {
  const auto integrals = shape_integrals(cells_, body_.particles.positions, thickness_of(input_));
  double volume = 0.0, moment = 0.0;
  for (Index i = 0; i < body_.particles.size(); ++i) {
    volume += integrals[i];
    moment += integrals[i] * body_.particles.position(i)[0];
  }
  EXPECT_NEAR(moment, volume, 1e-12 * volume) << "the centroid of the body is at x = 1";
}

INSTANTIATE_TEST_SUITE_P(Patterns, Triangulation,
                         testing::Values(Pattern::rectangular, Pattern::hexagonal, Pattern::cubic),
                         [](const auto& test) {
                           return test.param == Pattern::cubic       ? "cubic"
                                  : test.param == Pattern::hexagonal ? "hexagonal"
                                                                     : "rectangular";
                         });

TEST(Triangulate, DiagonalsAlternate) {
  LatticeInput input;
  input.spacing = 1.0;
  input.solid = {{{0, 0, 0}, {2, 2, 0}}};
  input.material = {0};
  const Body body = make_body(input);
  const Simplices cells = triangulate(input, body);
  ASSERT_EQ(cells.size(), 8);
  int around_centre = 0;
  for (const Index i : cells.vertices) around_centre += i == 4;
  EXPECT_EQ(around_centre, 8) << "all diagonals meet in the middle particle of 3 by 3";
}

TEST(Triangulate, EdgesAreThoseOfTheCellsOnce) {
  Particles particles;
  particles.positions = {0, 0, 3, 0, 0, 4, 3, 4};
  particles.volumes.assign(4, 1.0);
  Simplices cells;
  cells.vertices = {0, 1, 2, 3, 2, 1};
  cells.material = {0, 0};
  const Bonds edges = edges_of(cells, particles);
  EXPECT_EQ(edges.first, (std::vector<Index>{0, 0, 1, 1, 2}));
  EXPECT_EQ(edges.second, (std::vector<Index>{1, 2, 2, 3, 3}));
  EXPECT_DOUBLE_EQ(edges.lengths[2], 5.0);
}

TEST(Triangulate, RefusesWhatHasNoCells) {
  LatticeInput input;
  input.spacing = 0.5;
  input.horizon = 1.0;
  input.solid = {{{0, 0, 0}, {1, 1, 1}}};
  input.material = {0};
  input.surface = Surface::ghost;
  EXPECT_THROW(triangulate(input, make_body(input)), std::invalid_argument);
  input.surface = Surface::none;
  input.pattern = Pattern::face_centred;
  EXPECT_THROW(triangulate(input, make_body(input)), std::invalid_argument);
}

}  // namespace
}  // namespace perilink

#include "discretization/facets.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>

#include "discretization/lattices/lattice.hpp"
#include "discretization/lattices/make_body.hpp"

namespace perilink {
namespace {

/// Two boxes that make an L, one of them of another material; faces lie on planes of every lattice.
LatticeInput l_shape(Pattern pattern) {
  LatticeInput input;
  input.pattern = pattern;
  input.spacing = pattern == Pattern::face_centred ? 0.25 * std::sqrt(2.0) : 0.25;
  input.thickness = 0.5;
  const double row = pattern == Pattern::hexagonal ? 2.0 / 9.0 : 0.25;
  input.solid = {{{0, 0, 0}, {2, 4 * row, 1}}, {{0, 0, 0}, {1, 9 * row, 1}}};
  if (pattern == Pattern::rectangular || pattern == Pattern::cubic ||
      pattern == Pattern::face_centred) {
    input.solid[1].upper[1] = 2.0;
  }
  input.material = {0, 1};
  return input;
}

class LatticeFacets : public testing::TestWithParam<Pattern> {};

/// Divergence theorem with linear functions: the sum of A x' over the surface is V I. Corners carry
/// equal shares, so the centre of a facet is the mean of its corners.
TEST_P(LatticeFacets, SatisfyTheDivergenceTheoremForLinearFields) {
  const Body body = make_body(l_shape(GetParam()));
  const int dim = body.particles.dim;
  const double volume =
      std::accumulate(body.particles.volumes.begin(), body.particles.volumes.end(), 0.0);
  double closure[3] = {};
  double moments[3][3] = {};
  for (Index f = 0; f < body.facets.size(); ++f) {
    if (!body.facets.on_surface(f)) continue;
    const Vector3 x = body.facets.centre(f, body.particles.positions);
    for (int a = 0; a < dim; ++a) {
      closure[a] += body.facets.area_vector(f)[a];
      for (int b = 0; b < dim; ++b) moments[a][b] += body.facets.area_vector(f)[a] * x[b];
    }
  }
  for (int a = 0; a < dim; ++a) {
    EXPECT_NEAR(closure[a], 0.0, 1e-13);
    for (int b = 0; b < dim; ++b) EXPECT_NEAR(moments[a][b], a == b ? volume : 0.0, 1e-12);
  }
}

/// Round-off of sums of a hundred areas near one: 1e-13.
TEST_P(LatticeFacets, SeparateMaterialsFromTheLowerToTheHigher) {
  const Body body = make_body(l_shape(GetParam()));
  double area = 0.0;
  for (Index f = 0; f < body.facets.size(); ++f) {
    if (body.facets.on_surface(f)) continue;
    EXPECT_EQ(body.facets.inside[f], 0);
    EXPECT_EQ(body.facets.outside[f], 1);
    area -= body.facets.area_vector(f)[0];  // the box of material 1 lies to the left
  }
  const double height = GetParam() == Pattern::hexagonal ? 8.0 / 9.0 : 1.0;
  EXPECT_NEAR(area, height * (body.particles.dim == 2 ? 0.5 : 1.0), 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Patterns, LatticeFacets,
                         testing::Values(Pattern::rectangular, Pattern::hexagonal, Pattern::cubic,
                                         Pattern::face_centred));

TEST(FacetsOf, ATriangleHasItsEdges) {
  Simplices cells;
  cells.vertices = {0, 1, 2};
  cells.material = {0};
  const std::vector<double> positions = {0, 0, 1, 0, 0, 2};
  const Facets facets = facets_of(cells, positions, 3.0);
  ASSERT_EQ(facets.size(), 3);
  const std::map<std::vector<Index>, Vector3> expected = {
      {{0, 1}, {0, -3, 0}}, {{0, 2}, {-6, 0, 0}}, {{1, 2}, {6, 3, 0}}};
  for (Index f = 0; f < 3; ++f) {
    const auto corners = facets.corners.row(f);
    const Vector3& area = expected.at({corners.begin(), corners.end()});
    EXPECT_DOUBLE_EQ(facets.area_vector(f)[0], area[0]);
    EXPECT_DOUBLE_EQ(facets.area_vector(f)[1], area[1]);
  }
}

TEST(FacetsOf, TetrahedraPointOutward) {
  Simplices cells;
  cells.dim = 3;
  cells.vertices = {0, 1, 2, 3, 0, 2, 1, 4};  // one above, one below the same triangle
  cells.material = {0, 0};
  const std::vector<double> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1};
  const Facets facets = facets_of(cells, positions, 1.0);
  ASSERT_EQ(facets.size(), 6);
  double outward = 0.0;
  for (Index f = 0; f < 6; ++f) {
    const Vector3 x = facets.centre(f, positions);
    for (int a = 0; a < 3; ++a) outward += facets.area_vector(f)[a] * x[a];
  }
  EXPECT_NEAR(outward, 3.0 * (2.0 / 6.0), 1e-14);  // three times the volume
}

TEST(FacetsOf, RefusesASideOfThreeCells) {
  Simplices cells;
  cells.vertices = {0, 1, 2, 0, 1, 3, 0, 1, 4};
  cells.material = {0, 0, 0};
  const std::vector<double> positions = {0, 0, 1, 0, 0, 1, 0, -1, 1, 1};
  EXPECT_THROW(facets_of(cells, positions, 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace perilink

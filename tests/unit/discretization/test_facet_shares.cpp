#include "discretization/facet_shares.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "discretization/lattice.hpp"

namespace perilink {
namespace {

/// Quarter of a ring, coarse, with unequal steps: the work of its boundary on Killing tensors of the
/// third degree is not zero with equal shares.
struct Ring {
  Simplices cells;
  std::vector<double> positions;
};

Ring quarter_ring() {
  Ring ring;
  const double angles[] = {0.0, 0.2, 0.5, 0.7, 1.1, 1.3, std::acos(0.0)};
  for (const double angle : angles) {
    for (const double radius : {1.0, 1.4, 2.0}) {
      ring.positions.push_back(radius * std::cos(angle));
      ring.positions.push_back(radius * std::sin(angle));
    }
  }
  for (Index s = 0; s < 6; ++s) {
    for (Index r = 0; r < 2; ++r) {
      const Index a = 3 * s + r, b = a + 1, c = a + 4, d = a + 3;
      for (const Index vertex : {a, b, c, a, c, d}) ring.cells.vertices.push_back(vertex);
      ring.cells.material.insert(ring.cells.material.end(), 2, 0);
    }
  }
  return ring;
}

/// Work of the boundary on e r r, e the unit vector along x and r the rigid rotation about the origin:
/// 2 (e . r) (A . r) + (r . r) (A . e).
double cubic_work(const Facets& facets, const std::vector<double>& positions) {
  double work = 0.0;
  for (Index f = 0; f < facets.size(); ++f) {
    for (Index c = facets.corners.offsets[f]; c < facets.corners.offsets[f + 1]; ++c) {
      const double x = positions[2 * facets.corners.values[c]];
      const double y = positions[2 * facets.corners.values[c] + 1];
      const auto area = facets.area_vector(f);
      work += facets.shares[c] *
              (-2.0 * y * (-y * area[0] + x * area[1]) + (x * x + y * y) * area[0]);
    }
  }
  return work;
}

TEST(FacetShares, BalanceTheWorkOnKillingTensors) {
  const Ring ring = quarter_ring();
  Facets facets = facets_of(ring.cells, ring.positions, 1.0);
  const std::vector<Index> parts(ring.positions.size() / 2, 0);
  EXPECT_GT(std::abs(cubic_work(facets, ring.positions)), 1e-3);
  balance_shares(facets, ring.positions, parts, std::vector<double>{2.5});
  EXPECT_NEAR(cubic_work(facets, ring.positions), 0.0, 1e-12);
  for (Index f = 0; f < facets.size(); ++f) {
    double sum = 0.0;
    for (Index c = facets.corners.offsets[f]; c < facets.corners.offsets[f + 1]; ++c) {
      sum += facets.shares[c];
      EXPECT_NEAR(facets.shares[c], 0.5, 0.1);
    }
    EXPECT_NEAR(sum, 1.0, 1e-14);
  }
}

TEST(FacetShares, OfALatticeStayEqual) {
  for (const Pattern pattern : {Pattern::rectangular, Pattern::cubic}) {
    LatticeInput input;
    input.pattern = pattern;
    input.spacing = 0.25;
    input.solid = {{{0, 0, 0}, {1, 1, 1}}};
    input.material = {0};
    Body body = make_body(input);
    const std::vector<double> before = body.facets.shares;
    balance_shares(body.facets, body.particles.positions,
                   std::vector<Index>(static_cast<std::size_t>(body.particles.size()), 0),
                   std::vector<double>{1.0});
    for (std::size_t c = 0; c < before.size(); ++c) {
      EXPECT_NEAR(body.facets.shares[c], before[c], 1e-13);
    }
  }
}

Body plate(double spacing) {
  LatticeInput input;
  input.pattern = Pattern::rectangular;
  input.spacing = spacing;
  input.horizon = 3.0 * spacing;
  input.solid = {Box{{0.0, 0.0, 0.0}, {2.0, 1.5, 0.0}}};
  input.material = {0};
  return make_body(input);
}

/// Sum of x^power over the lower side y = 0, of length 2.
double sum_over_lower_side(const Body& body, int power) {
  double sum = 0.0;
  for (Index f = 0; f < body.facets.size(); ++f) {
    if (!(body.facets.area_vector(f)[1] < 0.0)) continue;
    for (Index c = body.facets.corners.offsets[f]; c < body.facets.corners.offsets[f + 1]; ++c) {
      const double x = body.particles.position(body.facets.corners.values[c])[0];
      sum -= body.facets.shares[c] * body.facets.area_vector(f)[1] * std::pow(x, power);
    }
  }
  return sum;
}

/// By Euler and Maclaurin the error of the trapezoidal rule for x^2 is h^2 L / 6; with slopes at the
/// ends taken over the last edge, off by h x'' / 2 = h at either end, h^3 / 6 of it is left.
TEST(CorrectEnds, StraightSidesAreIntegratedToTheNextOrder) {
  for (const double h : {0.25, 0.125}) {
    Body body = plate(h);
    EXPECT_NEAR(sum_over_lower_side(body, 2), 8.0 / 3.0 + h * h * 2.0 / 6.0, 1e-13);
    correct_ends(body.facets);
    EXPECT_NEAR(sum_over_lower_side(body, 0), 2.0, 1e-13);
    EXPECT_NEAR(sum_over_lower_side(body, 1), 2.0, 1e-13);
    EXPECT_NEAR(sum_over_lower_side(body, 2), 8.0 / 3.0 + h * h * h / 6.0, 1e-13);
  }
}

TEST(CorrectEnds, OnlyLastEdgesOfStraightPiecesChange) {
  Body body = plate(0.25);
  correct_ends(body.facets);
  int changed = 0;
  for (Index f = 0; f < body.facets.size(); ++f) {
    const Index c = body.facets.corners.offsets[f];
    EXPECT_NEAR(body.facets.shares[c] + body.facets.shares[c + 1], 1.0, 1e-15);
    const double least = std::min(body.facets.shares[c], body.facets.shares[c + 1]);
    if (least == 0.5) continue;
    EXPECT_NEAR(least, 5.0 / 12.0, 1e-15);
    ++changed;
  }
  EXPECT_EQ(changed, 8);  // two at each corner
}

/// Arcs of the ring turn at every particle; its two straight sides of unequal edges end at both.
TEST(CorrectEnds, CurvedOutlinesKeepEqualShares) {
  const Ring ring = quarter_ring();
  Facets facets = facets_of(ring.cells, ring.positions, 1.0);
  correct_ends(facets);
  int changed = 0;
  for (Index f = 0; f < facets.size(); ++f) {
    const auto area = facets.area_vector(f);
    const bool on_straight_side = std::abs(area[0] * area[1]) < 1e-12;
    const bool equal = std::abs(facets.shares[facets.corners.offsets[f]] - 0.5) < 1e-15;
    EXPECT_EQ(equal, !on_straight_side);
    changed += equal ? 0 : 1;
  }
  EXPECT_EQ(changed, 4);
}

}  // namespace
}  // namespace perilink

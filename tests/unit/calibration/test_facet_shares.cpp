#include "calibration/facet_shares.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "discretization/lattices/lattice.hpp"
#include "discretization/lattices/make_body.hpp"

namespace perilink {
namespace {

/// Quarter of a ring, coarse, with unequal steps: the work of its boundary on Killing tensors of
/// the third degree is not zero with equal shares.
struct FacetRing {
  Simplices cells;
  std::vector<double> positions;
};

FacetRing quarter_ring() {
  FacetRing ring;
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

/// Work of the boundary on e r r, e the unit vector along x and r the rigid rotation about the
/// origin: 2 (e . r) (A . r) + (r . r) (A . e).
double cubic_work(const Facets& facets, const std::vector<double>& positions) {
  double work = 0.0;
  for (Index f = 0; f < facets.size(); ++f) {
    for (Index c = facets.corners.offsets[f]; c < facets.corners.offsets[f + 1]; ++c) {
      const double x = positions[2 * facets.corners.values[c]];
      const double y = positions[2 * facets.corners.values[c] + 1];
      const auto area = facets.area_vector(f);
      work +=
          facets.shares[c] * (-2.0 * y * (-y * area[0] + x * area[1]) + (x * x + y * y) * area[0]);
    }
  }
  return work;
}

TEST(FacetShares, BalanceTheWorkOnKillingTensors) {
  const FacetRing ring = quarter_ring();
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

}  // namespace
}  // namespace perilink

#include "discretization/cuts/bonds_across_gaps.hpp"

#include <gtest/gtest.h>

#include "discretization/lattices/lattice.hpp"
#include "discretization/lattices/make_body.hpp"

namespace perilink {
namespace {

Body rectangular(std::vector<Box> solid) {
  LatticeInput input;
  input.pattern = Pattern::rectangular;
  input.spacing = 1.0;
  input.horizon = 3.0;
  input.material.assign(solid.size(), 0);
  input.solid = std::move(solid);
  return make_body(input);
}

TEST(Gaps, NoBondCrossesANotchNarrowerThanTheHorizon) {
  // A notch 1 wide and 5 deep, open at the bottom, between x = 5 and 6.
  const std::vector<Box> solid = {Box{{0, 0, 0}, {5, 10, 0}}, Box{{6, 0, 0}, {11, 10, 0}},
                                  Box{{5, 5, 0}, {6, 10, 0}}};
  const Body body = rectangular(solid);
  Bonds bonds = make_bonds(body.particles, 3.0);
  const Index before = bonds.size();

  const Index removed = remove_bonds_across_gaps(body.particles, bonds, solid, 1e-6);

  EXPECT_GT(removed, 0);
  EXPECT_EQ(bonds.size(), before - removed);
  int above = 0, along_face = 0;
  for (Index b = 0; b < bonds.size(); ++b) {
    const auto p = body.particles.position(bonds.first[b]);
    const auto q = body.particles.position(bonds.second[b]);
    const bool crosses = (p[0] <= 5.0) != (q[0] <= 5.0);
    if (crosses) {
      EXPECT_GE(std::max(p[1], q[1]), 5.0);
      above += p[1] >= 5.0 && q[1] >= 5.0;
    }
    along_face += p[0] == 5.0 && q[0] == 5.0;
  }
  EXPECT_GT(above, 0) << "bonds above the notch stay";
  EXPECT_GT(along_face, 0) << "bonds along its flank stay";
}

TEST(Gaps, BodiesApartAreNotBonded) {
  const std::vector<Box> solid = {Box{{0, 0, 0}, {4, 4, 0}}, Box{{5, 0, 0}, {9, 4, 0}}};
  const Body body = rectangular(solid);
  Bonds bonds = make_bonds(body.particles, 3.0);
  remove_bonds_across_gaps(body.particles, bonds, solid, 1e-6);
  for (Index b = 0; b < bonds.size(); ++b) {
    EXPECT_EQ(body.particles.position(bonds.first[b])[0] < 4.5,
              body.particles.position(bonds.second[b])[0] < 4.5);
  }
}

TEST(Gaps, AWholeBoxOfSeveralRegionsKeepsAllBonds) {
  const std::vector<Box> solid = {Box{{0, 0, 0}, {4, 4, 0}}, Box{{4, 0, 0}, {9, 4, 0}},
                                  Box{{2, 1, 0}, {3, 3, 0}}};
  const Body body = rectangular(solid);
  Bonds bonds = make_bonds(body.particles, 3.0);
  EXPECT_EQ(remove_bonds_across_gaps(body.particles, bonds, solid, 1e-6), 0);
}

}  // namespace
}  // namespace perilink

#include "network/crack_cost.hpp"

#include <gtest/gtest.h>

#include "discretization/lattices/make_body.hpp"
#include "support/clouds.hpp"
#include "support/lattice_networks.hpp"

namespace perilink {
namespace {

using namespace test;

struct Made {
  Body body;
  NetworkInput input;
  double cost() const { return crack_cost(body, input, input.materials[0]); }
};

Made make(Pattern pattern, double ratio, double spacing = 1.0) {
  const bool space = pattern == Pattern::cubic || pattern == Pattern::face_centred;
  LatticeInput lattice;
  lattice.pattern = pattern;
  lattice.surface = Surface::none;
  lattice.spacing = spacing;
  lattice.solid = {{{0.0, 0.0, 0.0}, {8.0 * spacing, 8.0 * spacing, space ? 8.0 * spacing : 0.0}}};
  lattice.material = {0};
  Made made{make_body(lattice), {}};
  made.input.problem = space ? Problem::three_dimensional : Problem::plane_stress;
  made.input.horizon = ratio * made.body.lattice.spacing;
  made.input.materials = {{1000.0, 1.0, 0.0}};
  return made;
}

Made micropolar(Problem problem, double poissons_ratio) {
  Made made = make(Pattern::rectangular, 3.0);
  made.input.problem = problem;
  made.input.model = BondModel::micropolar;
  made.input.materials[0].poissons_ratio = poissons_ratio;
  return made;
}

TEST(CrackCost, FallsTowardsOneAsNeighboursShareTheWork) {
  for (const Pattern pattern : {Pattern::rectangular, Pattern::hexagonal, Pattern::cubic}) {
    double before = make(pattern, 2.0).cost();
    for (const double ratio : {3.0, 5.0, 8.0}) {
      const double cost = make(pattern, ratio).cost();
      EXPECT_LT(cost, before);
      EXPECT_GT(cost, 1.0);
      before = cost;
    }
    EXPECT_NEAR(before, 1.0, 0.05);
  }
}

/// A ratio of energies: no length and no modulus enters.
TEST(CrackCost, DependsOnNoScale) {
  const double cost = make(Pattern::rectangular, 3.0).cost();
  Made other = make(Pattern::rectangular, 3.0, 0.02);
  other.input.materials[0].youngs_modulus = 3e10;
  other.input.thickness = 0.1;
  EXPECT_EQ(other.cost(), cost);
  EXPECT_EQ(make(Pattern::rectangular, 3.1).cost(), cost);  // the same neighbours
  EXPECT_LT(make(Pattern::rectangular, 3.2).cost(), cost);
}

/// In the plane bonds know Lame's two constants, not the kinematics that they come from: nu = 1/5
/// in plane stress and 1/6 in plane strain have lambda = mu / 2.
TEST(CrackCost, FollowsTheRatioOfLamesConstants) {
  EXPECT_NEAR(micropolar(Problem::plane_stress, 0.2).cost(),
              micropolar(Problem::plane_strain, 1.0 / 6.0).cost(), 1e-12);
  const double bonds = make(Pattern::rectangular, 3.0).cost();
  EXPECT_NEAR(micropolar(Problem::plane_stress, 1.0 / 3.0).cost(), bonds, 1e-12);
  EXPECT_NEAR(micropolar(Problem::plane_strain, 0.25).cost(), bonds, 1e-12);
  const double least = micropolar(Problem::plane_stress, 0.0).cost();
  EXPECT_LT(least, bonds);
  EXPECT_EQ(micropolar(Problem::plane_stress, -0.2).cost(), least);
  const double low = micropolar(Problem::plane_stress, 0.05).cost();
  EXPECT_GT(low, least);
  EXPECT_LT(low, micropolar(Problem::plane_stress, 0.1).cost());
}

TEST(CrackCost, OfCloudsFollowsTheHorizonRatio) {
  const Body body = make_unstructured(1, 10);
  NetworkInput input = unstructured_micropolar_input(10);
  input.model = BondModel::bond_based;
  double before = 2.0;
  for (const double ratio : {2.5, 3.0, 3.5, 4.0, 6.0}) {
    input.horizon = ratio * body.lattice.spacing;
    const double cost = crack_cost(body, input, input.materials[0]);
    EXPECT_LT(cost, before);
    EXPECT_GT(cost, 1.0);
    before = cost;
  }
}

}  // namespace
}  // namespace perilink

#include "network/network_input.hpp"

#include <gtest/gtest.h>

#include "discretization/lattices/make_body.hpp"
#include "material/elasticity.hpp"
#include "support/small_networks.hpp"

namespace perilink {
namespace {

using namespace test;

// Bonds that act along their length give lambda = mu, in plane stress with lambda of the plane.
TEST(NetworkInput, BondBasedSolidsHaveOneLameConstant) {
  for (const Problem problem :
       {Problem::plane_stress, Problem::plane_strain, Problem::three_dimensional}) {
    NetworkInput input;
    input.problem = problem;
    const LameConstants lame = lame_constants(input, {30.0, 0.02});
    EXPECT_NEAR(lame.lambda, lame.mu, 1e-14 * lame.mu);
  }
}

TEST(NetworkInput, MicropolarSolidsHaveTheirOwnRatio) {
  NetworkInput input;
  input.model = BondModel::micropolar;
  const LameConstants lame = lame_constants(input, {30.0, 0.02, 0.2});
  const HookeConstants hooke = hooke_constants(input.problem, 30.0, 0.2);
  EXPECT_NEAR(lame.lambda, hooke.lambda, 1e-14 * hooke.lambda);
  EXPECT_NEAR(lame.mu, hooke.mu, 1e-14 * hooke.mu);
}

TEST(NetworkInput, OnlyMicropolarBondsBend) {
  const LatticeInput body_of = body_input({"", Pattern::rectangular, Surface::none}, 6);
  const Body body = make_body(body_of);
  NetworkInput input = network_input(body_of);
  input.materials = {{30.0, 0.02, 0.2}};
  EXPECT_EQ(moduli_of(body, input, input.materials[0]).bending_modulus, 0.0);
  input.model = BondModel::micropolar;
  EXPECT_GT(moduli_of(body, input, input.materials[0]).bending_modulus, 0.0);
}

}  // namespace
}  // namespace perilink

#include "network/builder/graded_stiffness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <vector>

#include "support/small_networks.hpp"

namespace perilink {
namespace {

using namespace test;

/// Returns 1 + 2 x + y as a factor.
PropertyField sloping_modulus() {
  return {VaryingProperty::youngs_modulus, {}, {1}, [](std::span<const double> x) {
            return 1.0 + 2.0 * x[0] + x[1];
          }};
}

/// A linear factor and a uniform strain give each interior particle the divergence of the stress of
/// the continuum, (S-11).
TEST(GradedStiffness, GivesInteriorParticlesTheBodyForceOfTheContinuum) {
  LatticeInput lattice = body_input(rectangular, 15);
  lattice.surface = Surface::calibrated;
  lattice.horizon = 3.0 * lattice.spacing;
  NetworkInput input = network_input(lattice);
  input.fields = {sloping_modulus()};
  const Body body = make_body(lattice);
  const Network network = build_network(body, input);
  const LameConstants lame = lame_constants(input, input.materials[0]);
  const double xx = 0.3, yy = -0.1, xy = 0.2;
  // div (g sigma) = sigma grad g
  const double trace = lame.lambda * (xx + yy);
  const double x = 2.0 * (trace + 2.0 * lame.mu * xx) + 2.0 * lame.mu * xy;
  const double y = 2.0 * 2.0 * lame.mu * xy + trace + 2.0 * lame.mu * yy;
  const double middle = 7.5 * lattice.spacing;
  int interior = 0;
  for (Index i = 0; i < network.particles.size(); ++i) {
    const auto at = network.particles.position(i);
    if (std::abs(at[0] - middle) > lattice.spacing || std::abs(at[1] - middle) > lattice.spacing) {
      continue;
    }
    ++interior;
    double fx = 0.0, fy = 0.0;
    for (Index b = 0; b < network.bonds.size(); ++b) {
      if (network.bonds.first[b] != i && network.bonds.second[b] != i) continue;
      const auto n = network.bonds.direction(b);
      const double way = network.bonds.first[b] == i ? 1.0 : -1.0;
      const double stretch = n[0] * n[0] * xx + n[1] * n[1] * yy + 2.0 * n[0] * n[1] * xy;
      const double force = way * network.stiffness[b] * network.bonds.length(b) * stretch;
      fx += force * n[0];
      fy += force * n[1];
    }
    EXPECT_NEAR(fx / (network.particles.volumes[i] * x), 1.0, 1e-10);
    EXPECT_NEAR(fy / (network.particles.volumes[i] * y), 1.0, 1e-10);
  }
  EXPECT_EQ(interior, 4);
}

TEST(GradedStiffness, ScalesCellsAtTheirCentroid) {
  const std::vector<double> corners = {0.0, 0.0, 1.0, 0.0, 0.0, 2.0};
  Simplices cells;
  cells.dim = 2;
  cells.vertices = {0, 1, 2};
  cells.material = {0};
  const std::vector<IsotropicMaterial> materials = {{3.0, 0.2}};
  const LinearElements even =
      make_linear_elements(cells, corners, 1.0, Problem::plane_strain, materials);
  LinearElements elements = even;
  const std::vector<PropertyField> fields = {sloping_modulus()};
  scale_stiffness(fields, corners, elements);
  const double factor = 1.0 + 2.0 / 3.0 + 2.0 / 3.0;
  EXPECT_NEAR(elements.mu[0], factor * even.mu[0], 1e-14 * factor * even.mu[0]);
  EXPECT_NEAR(elements.lambda[0], factor * even.lambda[0], 1e-14 * factor * even.lambda[0]);
}

}  // namespace
}  // namespace perilink

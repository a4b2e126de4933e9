#include "network/lattice_neighbourhoods.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "discretization/lattices/make_body.hpp"
#include "support/small_networks.hpp"

namespace perilink {
namespace {

using namespace test;

/// Half the energy of the bonds of a particle in a uniform strain, per volume: C of the material.
void expect_isotropic(const LatticeNeighbourhoods& neighbourhoods, const LameConstants& constants,
                      double volume) {
  const double strains[3][3] = {{1.0, 0.3, 0.0}, {0.2, -1.0, 0.5}, {0.0, 0.0, 1.0}};  // xx yy xy
  for (const auto& e : strains) {
    double energy = 0.0;
    for (std::size_t k = 0; k < neighbourhoods.offsets().size(); ++k) {
      const Vector3& x = neighbourhoods.offsets()[k];
      const double xi2 = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
      const double stretch =
          (x[0] * x[0] * e[0] + x[1] * x[1] * e[1] + 2.0 * x[0] * x[1] * e[2]) / xi2;
      energy += 0.25 * neighbourhoods.stiffness(0).axial[k] * xi2 * stretch * stretch;
    }
    const double trace = e[0] + e[1];
    const double expected = 0.5 * constants.lambda * trace * trace +
                            constants.mu * (e[0] * e[0] + e[1] * e[1] + 2.0 * e[2] * e[2]);
    EXPECT_NEAR(energy / volume, expected, 1e-10 * constants.mu);
  }
}

TEST(LatticeNeighbourhoods, AreIsotropicInEveryLattice) {
  for (const Pattern pattern :
       {Pattern::rectangular, Pattern::hexagonal, Pattern::cubic, Pattern::face_centred}) {
    const LatticeInput of_body = body_input({"", pattern, Surface::calibrated}, 8);
    const Body body = make_body(of_body);
    const NetworkInput input = network_input(of_body);
    const LatticeNeighbourhoods neighbourhoods(body, input);
    expect_isotropic(neighbourhoods, lame_constants(input, input.materials[0]),
                     body.lattice.cell_volume);
    double modulus = 0.0;
    for (std::size_t k = 0; k < neighbourhoods.offsets().size(); ++k) {
      const Vector3& x = neighbourhoods.offsets()[k];
      modulus +=
          0.5 * neighbourhoods.stiffness(0).axial[k] * (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    }
    EXPECT_NEAR(neighbourhoods.modulus(0), modulus, 1e-12 * modulus);
  }
}

TEST(LatticeNeighbourhoods, FindBondsByTheirVectors) {
  const LatticeInput of_body = body_input({"", Pattern::hexagonal, Surface::calibrated}, 8);
  const Body body = make_body(of_body);
  const LatticeNeighbourhoods neighbourhoods(body, network_input(of_body));
  for (Index k = 0; k < neighbourhoods.size(); ++k) {
    const Vector3& x = neighbourhoods.offsets()[k];
    const double xi = std::hypot(x[0], x[1]);
    const double direction[2] = {x[0] / xi, x[1] / xi};
    EXPECT_EQ(neighbourhoods.find(direction, xi), k);
    EXPECT_EQ(neighbourhoods.find(direction, 0.35 * xi), no_index);
  }
}

}  // namespace
}  // namespace perilink

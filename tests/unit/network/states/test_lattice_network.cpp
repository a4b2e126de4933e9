#include "network/states/lattice_network.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "assembly/fields.hpp"
#include "assembly/internal_force.hpp"
#include "support/lattice_networks.hpp"
#include "support/small_networks.hpp"

namespace perilink {
namespace {

using namespace testing_support;

constexpr double concrete_modulus = 25e9;  // that of elastic_concrete()

class LatticeNetworkOf : public testing::TestWithParam<StateLatticeCase> {
 protected:
  LatticeNetworkOf()
      : model_(state_block(GetParam(), 4.1)),
        body_(lattice_network(model_)),
        network_(body_.network),
        secants_(static_cast<std::size_t>(network_.num_elements()), 1.0) {}

  ExplicitModel model_;
  LatticeNetwork body_;
  const Network& network_;
  std::vector<double> secants_;
};

TEST_P(LatticeNetworkOf, HasTheParticlesAndBondsOfTheRows) {
  const LatticeRows& lattice = model_.lattice;
  ASSERT_EQ(network_.particles.size() + body_.left_out, lattice.particles());
  ASSERT_EQ(body_.slots.size(), network_.particles.volumes.size());
  const Csr neighbourhoods = bonds_of_particles(network_.bonds, network_.particles.size());
  Index missing = 0;
  for (Index i = 0; i < network_.particles.size(); ++i) {
    const Index slot = body_.slots[i];
    EXPECT_EQ(network_.particles.position(i)[1], lattice.positions[lattice.at(1, slot)]);
    EXPECT_EQ(network_.particles.volumes[i], model_.volume[slot]);
    missing += lattice.bond_count[slot] - static_cast<Index>(neighbourhoods.row(i).size());
  }
  EXPECT_EQ(missing, body_.left_out);  // each that is left out hung on one bond
  for (Index e = 0; e < network_.num_elements(); ++e) {
    const double length = network_.bonds.lengths[e] / lattice.spacing;
    EXPECT_LT(std::min(std::abs(length - 1.0), std::abs(length - std::sqrt(2.0))), 1e-12);
    if (e == 0) continue;
    const Bonds& bonds = network_.bonds;
    EXPECT_LT(std::tuple(bonds.first[e - 1], bonds.second[e - 1]),
              std::tuple(bonds.first[e], bonds.second[e]));
  }
}

/// Hooke's energy per volume of a strain.
double energy_density(const StateLatticeCase& lattice, const std::array<Vector3, 3>& strain) {
  const HookeConstants hooke =
      hooke_constants(lattice.problem, concrete_modulus, lattice.poissons_ratio);
  double trace = 0.0, squares = 0.0;
  for (int a = 0; a < 3; ++a) {
    trace += strain[a][a];
    for (int b = 0; b < 3; ++b) squares += strain[a][b] * strain[a][b];
  }
  return 0.5 * hooke.lambda * trace * trace + hooke.mu * squares;
}

/// Particles that have all their neighbours store Hooke's energy, and those whose neighbours have
/// all theirs are in balance.
TEST_P(LatticeNetworkOf, IsHookesSolidInUniformStrain) {
  const std::array<std::array<Vector3, 3>, 4> strains = {{
      {{{1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}},
      {{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0}}},
      {{{0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}},
      {{{0.3, -0.4, 0.0}, {-0.4, 0.7, 0.0}, {0.0, 0.0, 0.0}}},
  }};
  const Csr neighbourhoods = bonds_of_particles(network_.bonds, network_.particles.size());
  const std::vector<int> depth = depths(network_);
  ASSERT_GT(*std::max_element(depth.begin(), depth.end()), 1);
  for (std::array<Vector3, 3> strain : strains) {
    if (network_.dim() == 3) {
      strain[2] = {0.2, 0.1, -0.6};
      strain[0][2] = 0.2;
      strain[1][2] = 0.1;
    }
    const std::vector<double> u = test::linear_field(network_.particles, strain);
    const InternalForce internal = internal_force(network_, secants_, u);
    const double size = *std::max_element(internal.forces.begin(), internal.forces.end());
    const std::vector<double> density = strain_energy_density(network_, secants_, u);
    const double exact = energy_density(GetParam(), strain);
    double sum = 0.0;
    for (Index i = 0; i < network_.particles.size(); ++i) {
      sum += density[i] * network_.particles.volumes[i];
      if (depth[i] >= 1) {
        EXPECT_NEAR(density[i], exact, 1e-12 * exact);
      }
      for (int a = 0; a < network_.dim() && depth[i] >= 2; ++a) {
        EXPECT_NEAR(internal.forces[i * network_.dim() + a], 0.0, 1e-12 * size);
      }
    }
    EXPECT_NEAR(sum, internal.energy, 1e-12 * internal.energy);
  }
}

/// Two triangles, a particle that hangs on one bond, and one that hangs on that.
TEST(LatticeNetwork, LeavesOutWhatCouldMoveForNothing) {
  LatticeCut cut = rectangle(10.0, 10.0, 1.0, 0.0);
  cut.inside = [](const Vector3& x) {
    return (std::abs(x[1]) < 0.1 && x[0] > -0.1 && x[0] < 3.1) ||
           (x[1] > 0.1 && x[1] < 1.0 && x[0] > 0.0 && x[0] < 1.0) ||
           (x[1] < -0.1 && x[1] > -1.0 && x[0] > 0.0 && x[0] < 1.0);
  };
  const ExplicitModel model = plane_model(cut, elastic_concrete());
  ASSERT_EQ(model.lattice.particles(), 6);
  const LatticeNetwork body = lattice_network(model);
  EXPECT_EQ(body.left_out, 2);
  EXPECT_EQ(body.network.particles.size(), 4);
  EXPECT_EQ(body.network.num_elements(), 5);
  for (Index i = 0; i < 4; ++i) EXPECT_LT(body.network.particles.position(i)[0], 1.5);
}

INSTANTIATE_TEST_SUITE_P(All, LatticeNetworkOf, testing::ValuesIn(state_lattice_cases()),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace perilink

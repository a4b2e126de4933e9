#include "analysis/dynamics/lattice/body/lattice_statics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "analysis/quasistatic/elastic_analysis.hpp"
#include "assembly/internal_force.hpp"
#include "support/lattice_networks.hpp"
#include "support/lattice_operator.hpp"
#include "support/small_networks.hpp"

namespace perilink {
namespace {

using namespace testing_support;

class LatticeStatics : public testing::TestWithParam<StateLatticeCase> {};

/// The network is the explicit run's body for small displacements.
TEST_P(LatticeStatics, HasTheForcesOfExplicitSteps) {
  const ExplicitModel model = state_block(GetParam(), 3.1);
  const LatticeRows& lattice = model.lattice;
  const LatticeNetwork body = lattice_network(model);
  ASSERT_EQ(body.left_out, 0);
  const Network& network = body.network;
  // Second-order terms of the true lengths are this part of the forces.
  const double size = 1e-8 * lattice.spacing;
  const std::vector<double> u = random_values(network.particles.positions.size(), 3, -size, size);
  ExplicitState state(model);
  for (Index i = 0; i < lattice.particles(); ++i) {
    for (int c = 0; c < lattice.dim; ++c) {
      state.displacement[lattice.at(c, lattice.particle_slot[i])] = u[i * lattice.dim + c];
    }
  }
  evaluate(model, state);
  const std::vector<double> forces = resultants(model, state);
  const InternalForce internal =
      internal_force(network, std::vector<double>(network.stiffness.size(), 1.0), u);
  double largest = 0.0;
  for (const double force : internal.forces) largest = std::max(largest, std::abs(force));
  for (Index i = 0; i < lattice.particles(); ++i) {
    for (int c = 0; c < lattice.dim; ++c) {
      EXPECT_NEAR(internal.forces[i * lattice.dim + c],
                  -forces[lattice.at(c, lattice.particle_slot[i])], 1e-7 * largest);
    }
  }
  EXPECT_NEAR(internal.energy, stored_energy(state), 1e-7 * internal.energy);
}

/// With two layers of particles held where a uniform strain takes them, the others follow: sums of
/// stretches at the surface are incomplete, and the first layer inside feels them.
TEST_P(LatticeStatics, PassesThePatchTest) {
  const Network network = lattice_network(state_block(GetParam(), 4.1)).network;
  const std::vector<double> exact = test::linear_field(
      network.particles, {{{0.3, 0.5, -0.1}, {-0.2, 0.7, 0.4}, {0.6, 0.1, 0.2}}});
  const std::vector<int> depth = depths(network);
  std::vector<std::uint8_t> held;
  std::vector<double> prescribed = exact;
  for (std::size_t slot = 0; slot < exact.size(); ++slot) {
    held.push_back(depth[slot / network.dim()] < 2);
    if (!held.back()) prescribed[slot] = 0.0;
  }
  const Unknowns unknowns = number_unknowns(network.dim(), held, prescribed);
  ASSERT_GT(unknowns.count, 0);
  const Loads none{std::vector<double>(exact.size(), 0.0)};
  const ElasticResult result = run_elastic_analysis({network, unknowns, none, {}});
  for (std::size_t slot = 0; slot < exact.size(); ++slot) {
    // Condition number times round-off, of displacements of 0.04.
    EXPECT_NEAR(result.displacement[slot], exact[slot], 1e-14);
  }
}

/// Twice the energy is the work of the loads; a symmetric matrix gives reciprocity.
TEST_P(LatticeStatics, StoresTheWorkOfItsLoads) {
  const Network network = lattice_network(state_block(GetParam(), 3.1)).network;
  const std::size_t slots = network.particles.positions.size();
  std::vector<std::uint8_t> held(slots, 0);
  for (std::size_t slot = 0; slot < slots; ++slot) {
    held[slot] = network.particles.positions[slot - slot % network.dim()] < -0.024;
  }
  const Unknowns unknowns = number_unknowns(network.dim(), held, std::vector<double>(slots, 0.0));
  const Loads first{random_values(slots, 5, -1.0, 1.0)}, second{random_values(slots, 6, -1.0, 1.0)};
  const ElasticResult a = run_elastic_analysis({network, unknowns, first, {}});
  const ElasticResult b = run_elastic_analysis({network, unknowns, second, {}});
  double own = 0.0, across = 0.0, back = 0.0;
  for (std::size_t slot = 0; slot < slots; ++slot) {
    own += first.forces[slot] * a.displacement[slot];
    across += first.forces[slot] * b.displacement[slot];
    back += second.forces[slot] * a.displacement[slot];
  }
  EXPECT_NEAR(2.0 * a.strain_energy, own, 1e-12 * own);
  EXPECT_NEAR(across, back, 1e-12 * own);
  EXPECT_LT(a.residual, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(All, LatticeStatics, testing::ValuesIn(state_lattice_cases()),
                         testing::PrintToStringParamName());

constexpr double height = 0.3;
const double speed = std::sqrt(25e9 / 2323.0);  // waves along a bar of elastic_concrete()

enum class Ends { one, both, none };

/// Period of a column 0.15 across that moves only along itself, whose ends are rows of particles.
double period_of_column(int rows, Ends held) {
  // Without Poisson's effect the column vibrates like a bar.
  ExplicitModel model =
      plane_model(rectangle(0.075, 0.5 * height + 1e-9, height / (rows * std::sqrt(0.75)), 0.0),
                  elastic_concrete(0.0));
  std::vector<PrescribedMotion> motions;
  for (const Index slot : model.lattice.particle_slot) {
    const double y = model.lattice.positions[model.lattice.at(1, slot)];
    motions.push_back({slot, 0, 0.0});
    const bool low = y<-0.5 * height + 1e-6, high = y> 0.5 * height - 1e-6;
    if ((low && held != Ends::none) || (high && held == Ends::both)) {
      motions.push_back({slot, 1, 0.0});
    }
  }
  prescribe(model, motions);
  return fundamental_period(model);
}

/// Sums of stretches lack bonds along the sides, whose part of the body falls with the spacing.
TEST(LatticePeriod, OfAColumnTendsToThatOfABar) {
  const std::vector<std::pair<Ends, double>> cases = {{Ends::one, 4.0 * height / speed},
                                                      {Ends::both, 2.0 * height / speed},
                                                      {Ends::none, 2.0 * height / speed}};
  for (const auto& [ends, exact] : cases) {
    const double coarse = period_of_column(40, ends) / exact - 1.0;
    const double fine = period_of_column(80, ends) / exact - 1.0;
    EXPECT_LT(std::abs(coarse), 0.03);
    EXPECT_NEAR(fine / coarse, 0.5, 0.1);
  }
}

/// Concrete of Nikravesh & Gerstle (2018), 0.15 x 0.30, ends clamped: they print 0.00035.
TEST(LatticePeriod, OfAGrippedSpecimenIsThePrintedOne) {
  ExplicitModel model =
      plane_model(rectangle(0.075, 0.5 * height + 1e-9, height / (40 * std::sqrt(0.75)), 0.0),
                  elastic_concrete(0.2));
  std::vector<PrescribedMotion> motions;
  for (const Index slot : model.lattice.particle_slot) {
    if (std::abs(model.lattice.positions[model.lattice.at(1, slot)]) < 0.5 * height - 1e-6)
      continue;
    motions.push_back({slot, 0, 0.0});
    motions.push_back({slot, 1, 0.0});
  }
  prescribe(model, motions);
  EXPECT_NEAR(fundamental_period(model), 0.00035, 0.000005);  // half of its last digit
}

TEST(LatticePeriod, IsInfiniteWhereNothingVibrates) {
  ExplicitModel model = state_block({}, 2.1);
  std::vector<PrescribedMotion> motions;
  for (const Index slot : model.lattice.particle_slot) {
    motions.push_back({slot, 0, 0.0});
    motions.push_back({slot, 1, 0.0});
  }
  prescribe(model, motions);
  EXPECT_TRUE(std::isinf(fundamental_period(model)));
}

}  // namespace
}  // namespace perilink

#include <gtest/gtest.h>

#include "analysis/dynamics/bonds/bond_forces.hpp"
#include "discretization/lattices/make_body.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// Round-off of sums over the bonds of a particle, relative to the stiffest bond.
constexpr double green_round_off = 1e-12;

class GreenBonds : public testing::TestWithParam<LatticeCase> {
 protected:
  void SetUp() override {
    const LatticeInput input = body_input(GetParam(), 4);
    network_ = build_network(make_body(input), network_input(input));
    std::fill(network_.critical_stretch.begin(), network_.critical_stretch.end(), INFINITY);
    scale_ = *std::max_element(network_.stiffness.begin(), network_.stiffness.end());
  }

  std::size_t slots() const { return network_.particles.positions.size(); }

  std::vector<double> forces(const std::vector<double>& displacement) const {
    std::vector<double> force(slots());
    bonds()->forces(0, network_.particles.size(), 0.0, at(displacement), force);
    return force;
  }

  double energy(const std::vector<double>& displacement) const {
    return bonds()->stored(0, network_.particles.size(), 0.0, at(displacement));
  }

  BondMotion at(const std::vector<double>& displacement) const {
    return {displacement, std::vector<double>(slots(), 0.0)};
  }

  std::unique_ptr<ExplicitBonds> bonds() const {
    return make_explicit_bonds(network_, Strain::green);
  }

  Network network_;
  double scale_ = 0.0;
};

TEST_P(GreenBonds, ForceIsTheDerivativeOfTheEnergy) {
  std::vector<double> displacement = random_vector(slots(), 5);
  const std::vector<double> force = forces(displacement);
  const double whole = energy(displacement);
  // The energy is a polynomial of degree four, so central differences with steps h and 2h have only
  // cancellation errors.
  constexpr double step = 1e-2;
  for (std::size_t slot = 0; slot < slots(); slot += 5) {
    const auto difference = [&](double h) {
      const double kept = displacement[slot];
      displacement[slot] = kept + h;
      const double above = energy(displacement);
      displacement[slot] = kept - h;
      const double below = energy(displacement);
      displacement[slot] = kept;
      return (above - below) / (2.0 * h);
    };
    const double derivative = (4.0 * difference(step) - difference(2.0 * step)) / 3.0;
    EXPECT_NEAR(derivative, force[slot], 1e-13 * whole / step) << slot;
  }
}

/// The motion is a quarter turn about z and a shift.
TEST_P(GreenBonds, TurningCostsNothing) {
  std::vector<double> displacement(slots());
  const int dim = network_.dim();
  for (Index i = 0; i < network_.particles.size(); ++i) {
    const auto x = network_.particles.position(i);
    const std::size_t slot = static_cast<std::size_t>(i) * dim;
    displacement[slot] = -x[1] - x[0] + 0.3;
    displacement[slot + 1] = x[0] - x[1] - 0.2;
    if (dim == 3) displacement[slot + 2] = 0.1;
  }
  for (const double f : forces(displacement)) EXPECT_NEAR(f, 0.0, green_round_off * scale_);
  EXPECT_NEAR(energy(displacement), 0.0,
              green_round_off * green_round_off * scale_ * network_.num_elements());
}

TEST_P(GreenBonds, ForcesAndMomentsBalance) {
  const std::vector<double> displacement = random_vector(slots(), 3);
  const std::vector<double> force = forces(displacement);
  const int dim = network_.dim();
  Vector3 sum{}, moment{};
  for (Index i = 0; i < network_.particles.size(); ++i) {
    Vector3 x{}, f{};
    for (int a = 0; a < dim; ++a) {
      const std::size_t slot = static_cast<std::size_t>(i) * dim + a;
      x[a] = network_.particles.position(i)[a] + displacement[slot];  // current position
      f[a] = force[slot];
    }
    for (int k = 0; k < 3; ++k) {
      sum[k] += f[k];
      moment[k] += x[(k + 1) % 3] * f[(k + 2) % 3] - x[(k + 2) % 3] * f[(k + 1) % 3];
    }
  }
  const double largest = std::abs(*std::max_element(
      force.begin(), force.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(sum[k], 0.0, green_round_off * largest * network_.particles.size());
    EXPECT_NEAR(moment[k], 0.0, green_round_off * largest * network_.particles.size());
  }
}

/// Forces at small displacements equal those of small strains up to second order.
TEST_P(GreenBonds, SmallMotionsAreSmallStrains) {
  const std::vector<double> direction = random_vector(slots(), 7);
  const auto small = make_explicit_bonds(network_);
  double errors[2] = {};
  for (int k = 0; k < 2; ++k) {
    std::vector<double> displacement = direction;
    for (double& u : displacement) u *= k == 0 ? 1e-4 : 1e-5;
    std::vector<double> expected(slots());
    small->forces(0, network_.particles.size(), 0.0, at(displacement), expected);
    const std::vector<double> found = forces(displacement);
    for (std::size_t s = 0; s < slots(); ++s) {
      errors[k] = std::max(errors[k], std::abs(found[s] - expected[s]));
    }
  }
  EXPECT_NEAR(errors[0] / errors[1], 100.0, 1.0);
}

INSTANTIATE_TEST_SUITE_P(
    Lattices, GreenBonds,
    testing::Values(LatticeCase{"rectangular", Pattern::rectangular, Surface::none},
                    LatticeCase{"hexagonal", Pattern::hexagonal, Surface::none},
                    LatticeCase{"cubic", Pattern::cubic, Surface::none}),
    [](const auto& tested) { return tested.param.name; });

/// A bond breaks at the energy of its critical stretch, so that cracks dissipate as much as with
/// small strains.
TEST(GreenBondsThatBreak, BreakAtTheGreenStretch) {
  const AnalysisBody body = make_chains(1, 2, true, 10.0, 0.5);
  const auto bonds = make_explicit_bonds(body.network, Strain::green);
  const double at_limit = std::sqrt(2.0) - 1.0;  // s + s^2/2 = 1/2
  const auto pulled = [&](double by) {
    BondMotion motion;
    motion.displacement = linear_field(body.network.particles, {{{by, 0, 0}, {}, {}}});
    motion.velocity.assign(8, 0.0);
    return motion;
  };
  std::vector<double> force(8);
  EXPECT_EQ(bonds->forces(0, 4, 0.0, pulled(at_limit - 1e-9), force).broken_halves(), 0);
  const BondLosses losses = bonds->forces(0, 4, 0.0, pulled(at_limit + 1e-9), force);
  EXPECT_EQ(losses.broken_halves(), 4);
  EXPECT_NEAR(losses.fractured, 2.0 * 0.5 * 10.0 * 0.25, 1e-6);
  for (const double f : force) EXPECT_EQ(f, 0.0);
}

}  // namespace
}  // namespace perilink

#include <gtest/gtest.h>

#include "analysis/dynamics/bonds/bond_stencil.hpp"
#include "support/stencil_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// Bodies with some broken bonds.
class StencilBonds : public testing::TestWithParam<StencilCase> {
 protected:
  void SetUp() override {
    ASSERT_FALSE(find_stencil(network_).kinds.empty());
    size_ = network_.critical_stretch[0] * network_.bonds.lengths[0];
    const ForcesOfAll torn =
        forces_of_all(network_, *bonds_, random_motion(network_, 0.7 * size_, 3), 0.0);
    ASSERT_GT(torn.losses.broken_halves(), 0);
  }

  Network network_ = stencil_network(GetParam());
  std::unique_ptr<ExplicitBonds> bonds_ = make_explicit_bonds(network_);
  double size_ = 0.0;
};

TEST_P(StencilBonds, ForceIsTheDerivativeOfTheEnergy) {
  BondMotion motion = random_motion(network_, 0.1 * size_, 5);  // too small to break further bonds
  std::fill(motion.velocity.begin(), motion.velocity.end(), 0.0);
  const ForcesOfAll found = forces_of_all(network_, *bonds_, motion, 0.0);
  ASSERT_EQ(found.losses.broken_halves(), 0);
  const auto energy = [&] { return bonds_->stored(0, network_.particles.size(), 0.0, motion); };
  const double whole = energy();
  // The energy is quadratic, so central differences have only cancellation errors.
  const double step = 0.1 * size_;
  for (std::size_t slot = 0; slot < found.force.size(); slot += 17) {
    double& u = motion.displacement[slot];
    const double kept = u;
    u = kept + step;
    const double above = energy();
    u = kept - step;
    const double below = energy();
    u = kept;
    EXPECT_NEAR((above - below) / (2.0 * step), found.force[slot], 1e-12 * whole / step) << slot;
  }
}

/// Forces of damaged bodies also sum to zero, with zero moment about the reference positions.
TEST_P(StencilBonds, ForcesAndMomentsBalance) {
  const ForcesOfAll found =
      forces_of_all(network_, *bonds_, random_motion(network_, 0.1 * size_, 7), 0.0);
  const int dim = network_.dim();
  Vector3 sum{}, moment{};
  double largest = 0.0;
  for (Index i = 0; i < network_.particles.size(); ++i) {
    Vector3 x{}, f{};
    for (int a = 0; a < dim; ++a) {
      x[a] = network_.particles.position(i)[a];
      f[a] = found.force[static_cast<std::size_t>(i) * dim + a];
      largest = std::max(largest, std::abs(f[a]));
    }
    for (int k = 0; k < 3; ++k) {
      sum[k] += f[k];
      moment[k] += x[(k + 1) % 3] * f[(k + 2) % 3] - x[(k + 2) % 3] * f[(k + 1) % 3];
    }
  }
  // Round-off of forces at several hundred particles up to three lengths apart.
  const double tolerance = 1e-14 * largest * network_.particles.size();
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(sum[k], 0.0, tolerance);
    EXPECT_NEAR(moment[k], 0.0, 3.0 * tolerance);
  }
}

INSTANTIATE_TEST_SUITE_P(Bodies, StencilBonds, testing::ValuesIn(stencil_cases()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace perilink

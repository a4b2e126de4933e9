#include "material/j2_plasticity.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace perilink {
namespace {

// Nikravesh & Gerstle 2018, Table 1 [MPa]; softening to zero at twice the ultimate strain.
constexpr YieldCurve yielding_concrete{22.98, 27.58, 0.003, 0.006};
constexpr double e = 25e3, nu = 0.2;

TEST(J2Plasticity, YieldStressHardensThenSoftens) {
  EXPECT_EQ(yield_stress(yielding_concrete, 0.0), 22.98);
  EXPECT_NEAR(yield_stress(yielding_concrete, 0.0015), 0.5 * (22.98 + 27.58), 1e-12);
  EXPECT_NEAR(yield_stress(yielding_concrete, 0.003), 27.58, 1e-12);
  EXPECT_NEAR(yield_stress(yielding_concrete, 0.0045), 0.5 * 27.58, 1e-12);
  EXPECT_EQ(yield_stress(yielding_concrete, 0.01), 0.0);
}

TEST(J2Plasticity, FailureStrainDissipatesTheEnergyInTheBand) {
  // Triangle of height f_u: width f_u (e_f - e_u) / 2 = G.
  const double strain = failure_strain(yielding_concrete, 0.05, 10.0);
  EXPECT_NEAR(10.0 * 27.58 * (strain - 0.003) / 2.0, 0.05, 1e-15);
}

TEST(J2Plasticity, MisesStressOfSimpleStates) {
  EXPECT_NEAR(mises_stress({5.0, 0, 0, 0, 0, 0}), 5.0, 1e-14);
  EXPECT_NEAR(mises_stress({5.0, 5.0, 5.0, 0, 0, 0}), 0.0, 1e-14);
  EXPECT_NEAR(mises_stress({0, 0, 0, 5.0, 0, 0}), 5.0 * std::sqrt(3.0), 1e-14);
}

TEST(J2Plasticity, StaysElasticBelowYield) {
  PlasticState state;
  const SymmetricTensor stress = return_stress(Problem::plane_stress, e, nu, yielding_concrete,
                                               {-1e-4, 0.2e-4, 0, 0, 0, 0}, state);
  EXPECT_NEAR(stress[0], -2.5, 1e-12);
  EXPECT_NEAR(stress[1], 0.0, 1e-12);
  EXPECT_EQ(state.equivalent_strain, 0.0);
}

/// For any strain the stress ends on the yield surface, the flow keeps the volume and follows the
/// deviator, and total = elastic + plastic.
TEST(J2Plasticity, EndsOnTheYieldSurfaceByAssociatedFlow) {
  for (const Problem problem :
       {Problem::plane_stress, Problem::plane_strain, Problem::three_dimensional}) {
    for (const SymmetricTensor& strain :
         {SymmetricTensor{-2e-3, 4e-4, 0, 0, 0, 0}, SymmetricTensor{2e-3, 2e-3, 0, 0, 0, 0},
          SymmetricTensor{1e-4, -3e-4, 0, 1e-3, 0, 0},
          SymmetricTensor{5e-3, -1e-3, 0, 3e-3, 0, 0}}) {
      PlasticState state;
      const SymmetricTensor stress =
          return_stress(problem, e, nu, yielding_concrete, strain, state);
      const SymmetricTensor& plastic = state.strain;
      ASSERT_GT(state.equivalent_strain, 0.0);
      // Round-off and the last bit of the bisection.
      EXPECT_NEAR(mises_stress(stress), yield_stress(yielding_concrete, state.equivalent_strain),
                  1e-9);
      EXPECT_NEAR(plastic[0] + plastic[1] + plastic[2], 0.0, 1e-17);
      const double mean = (stress[0] + stress[1] + stress[2]) / 3.0;
      const double factor = 1.5 * state.equivalent_strain / mises_stress(stress);
      EXPECT_NEAR(plastic[0], factor * (stress[0] - mean), 1e-12);
      EXPECT_NEAR(plastic[1], factor * (stress[1] - mean), 1e-12);
      EXPECT_NEAR(plastic[3], factor * stress[3], 1e-12);
      const HookeConstants hooke = hooke_constants(problem, e, nu);
      const double xx = strain[0] - plastic[0], yy = strain[1] - plastic[1];
      const double zz = problem == Problem::plane_stress ? 0.0 : strain[2] - plastic[2];
      EXPECT_NEAR(stress[0], hooke.lambda * (xx + yy + zz) + 2.0 * hooke.mu * xx, 1e-8);
      EXPECT_NEAR(stress[1], hooke.lambda * (xx + yy + zz) + 2.0 * hooke.mu * yy, 1e-8);
      EXPECT_NEAR(stress[3], 2.0 * hooke.mu * (strain[3] - plastic[3]), 1e-8);
    }
  }
}

TEST(J2Plasticity, UniaxialCompressionFollowsTheYieldCurve) {
  PlasticState state;
  // Lateral strain of a free side: found so that its stress vanishes, by steps of Newton's secant.
  for (int step = 1; step <= 200; ++step) {
    const double axial = -4e-3 * step / 200;
    double lateral = -nu * axial, moved = lateral + 1e-5;
    const auto side_stress = [&](double side) {
      PlasticState trial = state;
      return return_stress(Problem::plane_stress, e, nu, yielding_concrete,
                           {axial, side, 0, 0, 0, 0}, trial)[1];
    };
    for (int k = 0; k < 60; ++k) {
      const double a = side_stress(lateral), b = side_stress(moved);
      if (std::abs(b) < 1e-10 || a == b) break;
      const double next = moved - b * (moved - lateral) / (b - a);
      lateral = moved;
      moved = next;
    }
    const SymmetricTensor stress = return_stress(Problem::plane_stress, e, nu, yielding_concrete,
                                                 {axial, moved, 0, 0, 0, 0}, state);
    if (state.equivalent_strain == 0.0) continue;
    EXPECT_NEAR(-stress[0], yield_stress(yielding_concrete, state.equivalent_strain), 1e-6) << step;
    // Uniaxial: the equivalent plastic strain is the axial one.
    EXPECT_NEAR(-state.strain[0], state.equivalent_strain, 1e-9) << step;
  }
  EXPECT_GT(state.equivalent_strain, 0.0025);
}

TEST(J2Plasticity, NothingIsLeftBeyondFailure) {
  PlasticState state;
  const SymmetricTensor stress = return_stress(Problem::plane_strain, e, nu, yielding_concrete,
                                               {-0.03, 0.03, 0, 0, 0, 0}, state);
  EXPECT_NEAR(mises_stress(stress), 0.0, 1e-9);
}

}  // namespace
}  // namespace perilink

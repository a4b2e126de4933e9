#include "analysis/quasistatic/elastic_analysis.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// Condition numbers of these bodies stay below 1e5; one step of refinement leaves round-off times
/// a few.
constexpr double tolerance = 1e-11;

class ElasticBlock : public testing::TestWithParam<BlockCase> {};

TEST_P(ElasticBlock, EqualsADenseSolution) {
  const AnalysisBody body = make_block(GetParam());
  const ElasticResult result = run_elastic_analysis(body);
  const Eigen::VectorXd expected = dense_displacement(body, intact(body.network));
  EXPECT_LT(difference(result.displacement, expected), tolerance);
  const double energy =
      0.5 * expected.dot(dense_stiffness(body.network, intact(body.network)) * expected);
  EXPECT_NEAR(result.strain_energy, energy, tolerance * energy);
  if (!GetParam().driven) {  // Clapeyron: half the work of the dead load
    double work = 0.0;
    for (std::size_t k = 0; k < body.loads.forces.size(); ++k) {
      work += 0.5 * body.loads.forces[k] * result.displacement[k];
    }
    EXPECT_NEAR(result.strain_energy, work, tolerance * work);
  }
  EXPECT_NEAR(result.work, energy, tolerance * energy);
  EXPECT_LT(result.residual, 1e-13);
  EXPECT_EQ(result.factor.factorizations, 1);
  EXPECT_EQ(result.factor.size, body.unknowns.count);
}

TEST_P(ElasticBlock, ThreadsDoNotChangeTheResult) {
  const AnalysisBody body = make_block(GetParam());
  const auto one = run_elastic_analysis(body);
  const auto two = run_elastic_analysis(body, {.threads = 2});
  EXPECT_EQ(one.displacement, two.displacement);
  EXPECT_EQ(one.residual, two.residual);
}

const LatticeCase ghost{"hexagonal_ghost", Pattern::hexagonal, Surface::ghost};

INSTANTIATE_TEST_SUITE_P(Elastic, ElasticBlock,
                         testing::Values(BlockCase{rectangular, false, false},
                                         BlockCase{rectangular, true, true},
                                         BlockCase{ghost, false, true}, BlockCase{ghost, true},
                                         BlockCase{cubic, false, false, 3},
                                         BlockCase{cubic, true, false, 3}),
                         [](const auto& test) { return to_string(test.param); });

/// Three bonds of stiffness 5 in series under a force of 1: u = 1/5, 2/5, 3/5 and energy 3/10.
TEST(ElasticAnalysis, ChainByHand) {
  const AnalysisBody body = make_chains(3, 2, false, 5.0, 1.0);
  const ElasticResult result = run_elastic_analysis(body);
  for (Index i = 0; i < body.network.particles.size(); ++i) {
    EXPECT_NEAR(result.displacement[slot(body, i, 0)], body.network.particles.position(i)[0] / 5.0,
                1e-15);
    EXPECT_EQ(result.displacement[slot(body, i, 1)], 0.0);
  }
  EXPECT_NEAR(result.strain_energy, 2 * 0.3, 1e-15);  // two chains
}

/// Supports that settle and turn by a million times its strains leave a body as strained as before:
/// what round-off does on their motion is no imbalance.
TEST(ElasticAnalysis, ASettlementIsNoImbalance) {
  AnalysisBody body = make_block({rectangular, true});
  const double strained = run_elastic_analysis(body).strain_energy;
  const Particles& particles = body.network.particles;
  for (double& u : body.unknowns.prescribed) u *= 1e-6;
  for (Index i = 0; i < particles.size(); ++i) {
    const std::span<const double> x = particles.position(i);
    if (body.unknowns.at(i, 0) < 0) body.unknowns.prescribed[slot(body, i, 0)] += 2.0 - 0.5 * x[1];
    if (body.unknowns.at(i, 1) < 0) body.unknowns.prescribed[slot(body, i, 1)] += 3.0 + 0.5 * x[0];
  }
  const ElasticResult result = run_elastic_analysis(body);
  EXPECT_NEAR(result.strain_energy, 1e-12 * strained, 1e-7 * 1e-12 * strained);
  EXPECT_NEAR(result.work, result.strain_energy, 1e-7 * result.strain_energy);
}

TEST(ElasticAnalysis, RefusesABodyThatNothingHolds) {
  AnalysisBody body = make_block({rectangular});
  number(body, [](Index, int) { return false; });
  EXPECT_THROW(run_elastic_analysis(body), SolverError);
}

}  // namespace
}  // namespace perilink

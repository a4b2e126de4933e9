#include "analysis/dynamics/inertia.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numeric>
#include <stdexcept>

#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

constexpr double density = 2.5;

/// Highest frequency of the free body by a dense solution.
double highest_frequency(const Network& network, const Inertia& inertia) {
  const auto size = static_cast<Eigen::Index>(inertia.mass.size());
  Eigen::MatrixXd stiffness = dense_stiffness(network, intact(network));
  for (std::size_t slot = 0; slot < network.support_stiffness.size(); ++slot) {
    stiffness(slot, slot) += network.support_stiffness[slot];
  }
  const Eigen::VectorXd root =
      Eigen::Map<const Eigen::VectorXd>(inertia.mass.data(), size).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(root.asDiagonal() * stiffness *
                                                              root.asDiagonal());
  return std::sqrt(solver.eigenvalues()[size - 1]);
}

class InertiaOfBlocks : public testing::TestWithParam<BlockCase> {};

/// The bound is one of every body, so it may be too high, by as much as where short and long bonds
/// differ; by half would cost every run half of its time.
TEST_P(InertiaOfBlocks, NoVibrationIsFasterThanTheBound) {
  AnalysisBody body = make_block(GetParam());
  body.network.support_stiffness.assign(body.unknowns.number.size(), 0.0);
  body.network.support_stiffness[0] = body.network.stiffness[0];
  for (const MassScaling scaling : {MassScaling::none, MassScaling::uniform}) {
    const Inertia inertia = lumped_inertia(body.network, std::vector{density}, scaling);
    const double highest = highest_frequency(body.network, inertia);
    EXPECT_LE(highest, inertia.frequency_bound);
    EXPECT_GT(highest, inertia.frequency_bound / 1.5);
  }
}

TEST_P(InertiaOfBlocks, MassIsThatOfTheVolume) {
  const AnalysisBody body = make_block(GetParam());
  const Particles& particles = body.network.particles;
  const Inertia inertia = lumped_inertia(body.network, std::vector{density});
  for (Index i = 0; i < particles.size(); ++i) {
    for (int c = 0; c < particles.dim; ++c) {
      const double mass = inertia.mass[slot(body, i, c)];
      if (particles.material[i] == 0) {
        EXPECT_DOUBLE_EQ(mass, density * particles.volumes[i]);
      } else {
        EXPECT_GT(mass, 0.0);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, InertiaOfBlocks,
    testing::Values(
        BlockCase{{"plane", Pattern::rectangular, Surface::none}},
        BlockCase{{"hexagonal", Pattern::hexagonal, Surface::calibrated}},
        BlockCase{{"plane", Pattern::rectangular, Surface::none}, false, true},
        BlockCase{{"space", Pattern::cubic, Surface::none}, false, false, 4},
        BlockCase{{"plane", Pattern::rectangular, Surface::calibrated}, false, false, 6, 0.1, true},
        BlockCase{{"space", Pattern::cubic, Surface::none}, false, false, 4, 0.1, true}),
    [](const auto& body) { return to_string(body.param) + std::to_string(body.index); });

/// The bound is that of all bonds stretched to their limit, k ((1 + 2 g) n n' + g I).
TEST(Inertia, GreenStrainsAllowForTheStretchAtWhichBondsBreak) {
  AnalysisBody body = make_block({{"plane", Pattern::rectangular, Surface::none}});
  const Inertia small = lumped_inertia(body.network, std::vector{density});
  const double stretch = 0.02;
  std::fill(body.network.critical_stretch.begin(), body.network.critical_stretch.end(), stretch);
  const Inertia green =
      lumped_inertia(body.network, std::vector{density}, MassScaling::none, Strain::green);
  // Along a bond 1 + 3 g, and across it g; at the edge across counts half as much as along.
  const double square = std::pow(green.frequency_bound / small.frequency_bound, 2);
  EXPECT_GT(square, 1.0 + 2.0 * stretch);
  EXPECT_LT(square, 1.0 + 5.0 * stretch);
  std::fill(body.network.critical_stretch.begin(), body.network.critical_stretch.end(), INFINITY);
  EXPECT_EQ(lumped_inertia(body.network, std::vector{density}, MassScaling::none, Strain::green)
                .frequency_bound,
            small.frequency_bound);
}

/// Scaled masses have the true sum, differ one by one, and allow a longer step.
TEST(Inertia, ScalingKeepsTheMassOfTheBody) {
  const AnalysisBody body = make_block({{"plane", Pattern::rectangular, Surface::none}});
  const Inertia plain = lumped_inertia(body.network, std::vector{density});
  const Inertia scaled = lumped_inertia(body.network, std::vector{density}, MassScaling::uniform);
  const double total = std::accumulate(plain.mass.begin(), plain.mass.end(), 0.0);
  EXPECT_NEAR(std::accumulate(scaled.mass.begin(), scaled.mass.end(), 0.0), total, 1e-12 * total);
  EXPECT_LT(scaled.frequency_bound, plain.frequency_bound);
}

TEST(Inertia, EveryMaterialNeedsADensity) {
  const AnalysisBody body = make_block({{"plane", Pattern::rectangular, Surface::none}});
  EXPECT_THROW(lumped_inertia(body.network, {}), std::invalid_argument);
  EXPECT_THROW(lumped_inertia(body.network, std::vector{0.0}), std::invalid_argument);
  EXPECT_THROW(lumped_inertia(body.network, std::vector{-1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace perilink

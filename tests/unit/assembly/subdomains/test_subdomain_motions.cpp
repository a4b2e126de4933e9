#include "assembly/subdomains/subdomain_motions.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "assembly/subdomains/subdomain_stiffness.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;
using Eigen::MatrixXd;

const BlockCase square{{"rectangular", Pattern::rectangular, Surface::none}};
const BlockCase cubic{{"cubic", Pattern::cubic, Surface::none}, true, true, 4};
BlockCase with_moments(BlockCase block) {
  block.micropolar = true;
  return block;
}

/// P as a dense matrix, from its rows.
MatrixXd fields_of(const SubdomainMotions& motions, const AnalysisBody& body) {
  const int count = motions.num_motions();
  MatrixXd fields = MatrixXd::Zero(body.unknowns.count, motions.num_subdomains() * count);
  for (Index p = 0; p < body.network.particles.size(); ++p) {
    for (int c = 0; c < body.unknowns.width; ++c) {
      if (body.unknowns.at(p, c) < 0) continue;
      for (int m = 0; m < count; ++m) {
        fields(body.unknowns.at(p, c), motions.subdomain_of(p) * count + m) =
            motions.row(p, c)[static_cast<std::size_t>(m)];
      }
    }
  }
  return fields;
}

/// The dense stiffness between unknowns.
MatrixXd stiffness_of(const AnalysisBody& body) {
  const MatrixXd all = dense_stiffness(body.network, intact(body.network));
  MatrixXd part(body.unknowns.count, body.unknowns.count);
  for (std::size_t a = 0; a < body.unknowns.number.size(); ++a) {
    for (std::size_t b = 0; b < body.unknowns.number.size(); ++b) {
      const Index i = body.unknowns.number[a], j = body.unknowns.number[b];
      if (i >= 0 && j >= 0) {
        part(i, j) = all(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
      }
    }
  }
  return part;
}

class Subdomains : public testing::TestWithParam<BlockCase> {};

TEST_P(Subdomains, StiffnessIsThatOfTheirMotions) {
  const AnalysisBody body = make_block(GetParam());
  const std::vector<double> secants = intact(body.network);
  const SubdomainMotions motions(body.network, secants, body.unknowns, 7);
  ASSERT_GT(motions.num_subdomains(), 2);
  const MatrixXd stiffness = stiffness_of(body), fields = fields_of(motions, body);
  const MatrixXd expected = fields.transpose() * stiffness * fields;
  const SubdomainStiffness found =
      assemble_subdomain_stiffness(body.network, secants, body.unknowns, motions);
  const MatrixXd coarse = MatrixXd(found.coarse).selfadjointView<Eigen::Lower>();
  const double size = expected.cwiseAbs().maxCoeff();
  // What is added resists motions only that move nothing.
  EXPECT_LT((fields * (coarse - expected)).cwiseAbs().maxCoeff(), 1e-8 * size);
  EXPECT_EQ(coarse.llt().info(), Eigen::Success);
  const int width = body.unknowns.width;
  for (Index p = 0; p < body.network.particles.size(); ++p) {
    for (int r = 0; r < width; ++r) {
      for (int c = 0; c < width; ++c) {
        const Index i = body.unknowns.at(p, r), j = body.unknowns.at(p, c);
        const double own = i >= 0 && j >= 0 ? stiffness(i, j) : r == c ? 1.0 : 0.0;
        EXPECT_NEAR(found.blocks[static_cast<std::size_t>((p * width + r) * width + c)], own,
                    1e-12 * stiffness.cwiseAbs().maxCoeff());
      }
    }
  }
}

TEST_P(Subdomains, RestrictAndAddAreTheFieldsAndTheirTranspose) {
  const AnalysisBody body = make_block(GetParam());
  const SubdomainMotions motions(body.network, intact(body.network), body.unknowns, 7);
  const MatrixXd fields = fields_of(motions, body);
  const Eigen::VectorXd residual = Eigen::VectorXd::Random(fields.rows());
  Eigen::VectorXd coarse(fields.cols()), result = residual;
  motions.restrict({residual.data(), static_cast<std::size_t>(residual.size())},
                   {coarse.data(), static_cast<std::size_t>(coarse.size())});
  EXPECT_LT((coarse - fields.transpose() * residual).norm(), 1e-13 * coarse.norm());
  motions.add({coarse.data(), static_cast<std::size_t>(coarse.size())},
              {result.data(), static_cast<std::size_t>(result.size())});
  EXPECT_LT((result - residual - fields * coarse).norm(), 1e-13 * result.norm());
}

/// Where nothing is held: no bond feels a box that moves rigidly.
TEST_P(Subdomains, BondsInsideAFreeBoxAreAtRest) {
  AnalysisBody body = make_block(GetParam());
  number(body, [](Index, int) { return false; });
  const SubdomainMotions one(body.network, intact(body.network), body.unknowns, 100000);
  ASSERT_EQ(one.num_subdomains(), 1);
  const MatrixXd fields = fields_of(one, body), stiffness = stiffness_of(body);
  EXPECT_LT((stiffness * fields).cwiseAbs().maxCoeff(), 1e-13 * stiffness.cwiseAbs().maxCoeff());
}

INSTANTIATE_TEST_SUITE_P(Blocks, Subdomains,
                         testing::Values(square, with_moments(square), cubic, with_moments(cubic)),
                         [](const auto& test) { return to_string(test.param); });

TEST(SubdomainMotions, WhatACrackCutsApartMovesByItself) {
  AnalysisBody body = make_block(square);
  const Particles& particles = body.network.particles;
  const double middle = 0.5 * particles.position(particles.size() - 1)[1] + 0.01;
  std::vector<double> secants = intact(body.network);
  for (Index e = 0; e < body.network.num_elements(); ++e) {
    const bool below = particles.position(body.network.bonds.first[e])[1] < middle;
    const bool above = particles.position(body.network.bonds.second[e])[1] > middle;
    if (below == above) secants[e] = 0.0;
  }
  const SubdomainMotions motions(body.network, secants, body.unknowns, 100000);
  EXPECT_EQ(motions.num_subdomains(), 2);
}

TEST(SubdomainMotions, HaveAFactorWhereAHeldParticleHasLostItsBonds) {
  AnalysisBody body = make_block(square);
  number(body, [](Index i, int) { return i < 3; });
  std::vector<double> secants = intact(body.network);
  for (Index e = 0; e < body.network.num_elements(); ++e) {
    if (body.network.bonds.first[e] == 0) secants[e] = 0.0;
  }
  const SubdomainMotions motions(body.network, secants, body.unknowns, 100000);
  ASSERT_EQ(motions.num_subdomains(), 2);
  const MatrixXd coarse(
      assemble_subdomain_stiffness(body.network, secants, body.unknowns, motions).coarse);
  EXPECT_EQ(MatrixXd(coarse.selfadjointView<Eigen::Lower>()).llt().info(), Eigen::Success);
}

}  // namespace
}  // namespace perilink

#include "analysis/dynamics/subdomain_preconditioner.hpp"

#include <gtest/gtest.h>

#include "support/dense_vibration.hpp"

namespace perilink {
namespace {

using namespace test;

/// The preconditioner as a dense matrix of the unknown components.
Eigen::MatrixXd dense_preconditioner(const AnalysisBody& body) {
  const SubdomainPreconditioner inverse(body.network, body.unknowns);
  const std::vector<Index>& number = body.unknowns.number;
  const auto slots = static_cast<Eigen::Index>(number.size());
  Eigen::MatrixXd matrix(body.unknowns.count, body.unknowns.count);
  for (Eigen::Index column = 0; column < slots; ++column) {
    if (number[column] == no_index) continue;
    const Eigen::VectorXd result = inverse.times(Eigen::VectorXd::Unit(slots, column));
    for (Eigen::Index row = 0; row < slots; ++row) {
      if (number[row] != no_index) {
        matrix(number[row], number[column]) = result[row];
      } else {
        EXPECT_EQ(result[row], 0.0) << "nothing held moves";
      }
    }
  }
  return matrix;
}

/// Largest over smallest eigenvalue of the preconditioned stiffness.
double condition(const AnalysisBody& body) {
  const Eigen::LLT<Eigen::MatrixXd> root(dense_preconditioner(body));
  EXPECT_EQ(root.info(), Eigen::Success) << "it must be positive definite";
  const Eigen::MatrixXd lower = root.matrixL();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      lower.transpose() * dense_stiffness_of_unknowns(body) * lower, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().tail(1)[0] / solver.eigenvalues()[0];
}

TEST(SubdomainPreconditioner, IsSymmetric) {
  for (const bool micropolar : {false, true}) {
    const AnalysisBody body = make_block(
        {{"plane", Pattern::rectangular, Surface::none}, true, false, 14, 0.1, micropolar});
    const Eigen::MatrixXd matrix = dense_preconditioner(body);
    EXPECT_LT((matrix - matrix.transpose()).norm(), 1e-13 * matrix.norm());
  }
}

/// With one subdomain per particle the coarse part is the inverse; the blocks add at most a few
/// times as much.
TEST(SubdomainPreconditioner, OfASmallBodyIsTheInverseAndTheBlocks) {
  const AnalysisBody body = make_block({{"plane", Pattern::rectangular, Surface::none}});
  EXPECT_EQ(body.network.particles.size(), 49);
  const Eigen::MatrixXd stiffness = dense_stiffness_of_unknowns(body);
  Eigen::MatrixXd blocks = Eigen::MatrixXd::Zero(stiffness.rows(), stiffness.cols());
  const std::vector<Index>& number = body.unknowns.number;
  for (std::size_t slot = 0; slot < number.size(); slot += 2) {
    if (number[slot] == no_index) continue;  // the left end is held in both directions
    const Index at = number[slot];
    blocks.block(at, at, 2, 2) = stiffness.block(at, at, 2, 2).inverse();
  }
  const Eigen::MatrixXd expected = stiffness.inverse() + blocks;
  EXPECT_LT((dense_preconditioner(body) - expected).norm(), 1e-9 * expected.norm());
}

/// Rigid motions of subdomains reduce the condition number; the stiffness has 1e7 and 2e8.
TEST(SubdomainPreconditioner, DoesNotMindHowSlenderABodyIs) {
  const double shorter = condition(cantilever(100, 2)), longer = condition(cantilever(200, 2));
  EXPECT_LT(shorter, 100.0);
  EXPECT_LT(longer, 100.0);
}

}  // namespace
}  // namespace perilink

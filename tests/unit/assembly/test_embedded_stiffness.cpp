#include "assembly/embedded_stiffness.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "assembly/stiffness.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

class EmbeddedStiffness : public testing::TestWithParam<bool> {};

/// T' K T by dense products, of a block in which two nodes that are no particles carry four
/// particles, and one of these a fixed share of a third particle's motion. 1e-12: round-off.
TEST_P(EmbeddedStiffness, IsThatOfTheMotion) {
  BlockCase block;
  block.lattice = {"plane", Pattern::rectangular, Surface::none};
  block.columns = 6;
  block.micropolar = GetParam();
  AnalysisBody body = make_block(block);
  Network& network = body.network;
  const int width = network.width();
  network.support_stiffness.assign(body.unknowns.number.size(), 0.0);
  network.support_stiffness[slot(body, 8, 1)] = 3.0;
  const Index all = network.particles.size();
  number(body, [&](Index i, int) { return i >= 7 && i < 11; });
  Unknowns& motion = body.unknowns;
  std::vector<Index> nodes;
  for (int k = 0; k < 2 * width; ++k) nodes.push_back(motion.add_shared(all + k / width));
  Eigen::MatrixXd map =
      Eigen::MatrixXd::Zero(static_cast<Index>(motion.number.size()), motion.count);
  for (std::size_t s = 0; s < motion.number.size(); ++s) {
    if (motion.number[s] >= 0) map(static_cast<Index>(s), motion.number[s]) = 1.0;
  }
  for (Index i = 7; i < 11; ++i) {
    for (int a = 0; a < width; ++a) {
      const double part = 0.2 * (i - 6);
      std::vector<Unknowns::Share> shares = {
          {nodes[static_cast<std::size_t>(a)], part},
          {nodes[static_cast<std::size_t>(width + a)], 1 - part}};
      if (i == 10) shares.push_back({motion.at(20, a), 0.5});
      motion.carry(slot(body, i, a), shares);
      for (const auto& share : shares) {
        map(static_cast<Index>(slot(body, i, a)), share.unknown) = share.weight;
      }
    }
  }
  std::vector<double> secants = intact(network);
  secants[5] = 0.5;
  Eigen::MatrixXd free = dense_stiffness(network, secants);
  const auto spring = static_cast<Index>(slot(body, 8, 1));
  free(spring, spring) += 3.0;
  const Eigen::MatrixXd expected = map.transpose() * free * map;
  const SparseMatrix lower = assemble_embedded(network, secants, motion);
  const Eigen::MatrixXd found = Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>();
  EXPECT_LT((found - expected).norm(), 1e-12 * expected.norm());
}

INSTANTIATE_TEST_SUITE_P(Bonds, EmbeddedStiffness, testing::Bool());

}  // namespace
}  // namespace perilink

#include "analysis/quasistatic/equilibrium/body/removal.hpp"

#include <gtest/gtest.h>

#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

Eigen::MatrixXd dense_columns(const Removal& removal, Index size) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(size, removal.rank);
  for (int m = 0; m < removal.rank; ++m) {
    for (int k = 0; k < removal.x[m].size(); ++k) {
      columns(removal.x[m].rows[k], m) = removal.x[m].values[k];
    }
  }
  return columns;
}

/// A bond that lost a part of its axial stiffness before takes the rest of it and all else along.
TEST(Removal, HasAPartOfItsOwnOfTheAxialMode) {
  const AnalysisBody body = make_block({rectangular, true, false, 5, 0.1, true});
  for (Index e = 0; e < body.network.num_elements(); e += 7) {
    const auto lost = [&](const Removal& removal) -> Eigen::MatrixXd {
      const Eigen::MatrixXd columns = dense_columns(removal, body.unknowns.count);
      return columns * columns.transpose();
    };
    const Eigen::MatrixXd expected = lost(make_removal(body.network, body.unknowns, e, 0.5)) -
                                     lost(make_axial_removal(body.network, body.unknowns, e, 0.3));
    const Removal removal = make_removal(body.network, body.unknowns, e, 0.5, 0.2);
    EXPECT_LT((lost(removal) - expected).cwiseAbs().maxCoeff(), 1e-13 * body.network.stiffness[e]);
    const Removal axial = make_axial_removal(body.network, body.unknowns, e, 0.2);
    EXPECT_NEAR(removal.prescribed[0], axial.prescribed[0], 1e-13);
  }
}

class MicropolarRemoval : public testing::TestWithParam<BlockCase> {};

/// Every bond of a body with fixed and displacement-controlled ends.
TEST_P(MicropolarRemoval, DecoupledModesAreTheSameRemovalAndDoNotInteract) {
  const AnalysisBody body = make_block(GetParam());
  const Network& network = body.network;
  const Eigen::MatrixXd all = dense_stiffness(network, intact(network));
  Eigen::MatrixXd stiffness(body.unknowns.count, body.unknowns.count);
  for (std::size_t row = 0; row < body.unknowns.number.size(); ++row) {
    for (std::size_t col = 0; col < body.unknowns.number.size(); ++col) {
      const Index r = body.unknowns.number[row], c = body.unknowns.number[col];
      if (r != no_index && c != no_index) stiffness(r, c) = all(row, col);
    }
  }
  const Eigen::MatrixXd inverse = stiffness.inverse();
  const auto solution = random_vector(static_cast<std::size_t>(body.unknowns.count), 1);
  const double determinant = stiffness.ldlt().vectorD().array().log().sum();
  for (Index e = 0; e < network.num_elements(); e += 5) {
    const Removal modes = make_removal(network, body.unknowns, e, 1.0);
    const Eigen::MatrixXd before = dense_columns(modes, body.unknowns.count);
    const Eigen::Matrix<double, -1, -1, Eigen::RowMajor> compliance =
        before.transpose() * inverse * before;
    Removal removal = modes;
    decouple(removal, {compliance.data(), static_cast<std::size_t>(compliance.size())});
    const Eigen::MatrixXd after = dense_columns(removal, body.unknowns.count);
    const Eigen::MatrixXd lost = before * before.transpose();
    EXPECT_LT((after * after.transpose() - lost).cwiseAbs().maxCoeff(),
              1e-13 * network.stiffness[e]);
    const Eigen::MatrixXd rest =
        Eigen::MatrixXd::Identity(removal.rank, removal.rank) - after.transpose() * inverse * after;
    double energy_before = 0.0, energy_after = 0.0, product = 0.0;
    for (int m = 0; m < removal.rank; ++m) {
      EXPECT_NEAR(rest(m, m), removal.pivot[m], 1e-13);
      EXPECT_LE(removal.pivot[std::max(m - 1, 0)], removal.pivot[m]);
      for (int n = 0; n < m; ++n) EXPECT_NEAR(rest(m, n), 0.0, 1e-13);
      product += std::log(removal.pivot[m]);
      energy_before += std::pow(modes.deformation(m, solution), 2);
      energy_after += std::pow(removal.deformation(m, solution), 2);
    }
    EXPECT_NEAR(energy_after, energy_before, 1e-12 * energy_before);
    const Eigen::MatrixXd changed = stiffness - lost;
    EXPECT_NEAR(changed.ldlt().vectorD().array().log().sum() - determinant, product, 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Bodies, MicropolarRemoval,
                         testing::Values(BlockCase{rectangular, false, true, 5, 0.1, true},
                                         BlockCase{rectangular, true, true, 5, 0.1, true},
                                         BlockCase{cubic, true, false, 2, 0.1, true}),
                         [](const auto& test) { return to_string(test.param); });

}  // namespace
}  // namespace perilink

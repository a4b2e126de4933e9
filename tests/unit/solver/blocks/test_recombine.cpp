#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <vector>

#include "solver/blocks/block_gradients.hpp"

namespace perilink {
namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, block_width, Eigen::RowMajor>;
using Eigen::MatrixXd;

TEST(Recombine, ColumnsGoOverToFewerCombinations) {
  constexpr int rows = 1100;  // more than are worked on at once
  const Rows first = Rows::Random(rows, block_width), second = Rows::Random(rows, block_width);
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> shares =
      MatrixXd::Random(2 * block_width, block_width);
  const auto numbers = [](const Rows& of) {
    return BlockVector<double>(of.data(), of.data() + of.size());
  };
  std::vector<BlockVector<double>> blocks = {numbers(first), numbers(second)};
  recombine(blocks, {shares.data(), std::size_t(shares.size())});
  ASSERT_EQ(blocks.size(), 1u);
  const Rows expected =
      first * shares.topRows(block_width) + second * shares.bottomRows(block_width);
  const Eigen::Map<const Rows> found(blocks[0].data(), rows, block_width);
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-13);
}

}  // namespace
}  // namespace perilink

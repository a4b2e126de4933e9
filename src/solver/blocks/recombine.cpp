// Combines many columns by BLAS. This file is separate from the block kernels, because Eigen's
// matrices have another layout in files compiled for this processor only.

#include <Eigen/Core>
#include <algorithm>

#include "solver/blocks/block_gradients.hpp"
#include "solver/dense/dense_kernels.hpp"

namespace perilink {

void recombine(std::vector<BlockVector<double>>& blocks, std::span<const double> shares) {
  constexpr std::size_t together = 512;  // rows
  const std::size_t old = blocks.size() * block_width, fewer = shares.size() / old;
  const std::size_t rows = blocks.front().size() / block_width;
  const Eigen::Map<const Eigen::MatrixXd> transposed(
      shares.data(), static_cast<Eigen::Index>(fewer), static_cast<Eigen::Index>(old));
  const Eigen::MatrixXd weights = transposed;
  for (std::size_t begin = 0; begin < rows; begin += together) {
    const auto count = static_cast<Eigen::Index>(std::min(together, rows - begin));
    using Rows = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, block_width, Eigen::RowMajor>>;
    const auto rows_of = [&](std::size_t block) {
      return Rows(blocks[block].data() + begin * block_width, count, block_width);
    };
    Eigen::MatrixXd columns(count, weights.cols());
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      columns.middleCols<block_width>(static_cast<Eigen::Index>(b) * block_width) = rows_of(b);
    }
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(count, weights.rows());
    add_product(columns, weights, sums);
    for (std::size_t b = 0; b < fewer / block_width; ++b) {
      rows_of(b) = sums.middleCols<block_width>(static_cast<Eigen::Index>(b) * block_width);
    }
  }
  blocks.resize(fewer / block_width);
}

}  // namespace perilink

#include "assembly/lower_triangle.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <utility>
#include <vector>

namespace perilink {
namespace {

/// A plane of particles with made-up blocks, each in as many parts as it is listed.
struct ListedBlocks {
  static constexpr int width = 2;

  Index num_particles() const { return static_cast<Index>(others.size()); }

  void visit(Index i, auto&& sink) const {
    for (const Index j : others[i]) {
      sink(j, [&](int row, int col) { return entry(i * width + col, j * width + row); });
    }
  }

  static double entry(Index a, Index b) { return 1.0 + std::min(a, b) + 0.01 * std::max(a, b); }

  std::vector<std::vector<Index>> others;
};

// The blocks of the upper triangle, (1, 0) and (3, 1), are not asked for.
const ListedBlocks blocks{{{0, 3, 1, 3}, {0, 3, 1}, {}, {3, 1, 3, 3}}};
const std::vector<std::pair<Index, Index>> parts = {{0, 0}, {3, 0}, {1, 0}, {3, 0}, {3, 1},
                                                    {1, 1}, {3, 3}, {3, 3}, {3, 3}};

Unknowns unknowns_of(const std::vector<std::uint8_t>& held) {
  return number_unknowns(2, held, std::vector<double>(held.size(), 0.0));
}

TEST(LowerTriangle, AddsBlocksUpBetweenUnknownsAndSortsItsRows) {
  for (const std::vector<std::uint8_t>& held :
       {std::vector<std::uint8_t>(8, 0), std::vector<std::uint8_t>{0, 1, 0, 0, 0, 0, 1, 0},
        std::vector<std::uint8_t>{1, 1, 1, 0, 0, 0, 0, 0}}) {
    const Unknowns unknowns = unknowns_of(held);
    const SparseMatrix matrix = LowerTriangle(blocks, unknowns).build();
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(unknowns.count, unknowns.count);
    for (const auto& [j, i] : parts) {
      for (int row = 0; row < 2; ++row) {
        for (int col = 0; col < 2; ++col) {
          const Index r = unknowns.at(j, row), c = unknowns.at(i, col);
          if (c == no_index || r < c) continue;
          expected(r, c) += ListedBlocks::entry(i * 2 + col, j * 2 + row);
        }
      }
    }
    EXPECT_EQ(Eigen::MatrixXd(matrix), expected);
    for (Index column = 0; column < matrix.cols(); ++column) {
      Index before = column - 1;  // the diagonal comes first, there or not
      for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry) {
        EXPECT_GT(entry.row(), before);
        before = static_cast<Index>(entry.row());
      }
    }
  }
}

TEST(LowerTriangle, KeepsThePlacesOfZeros) {
  const Unknowns unknowns = unknowns_of(std::vector<std::uint8_t>(8, 0));
  // Three entries of each particle's own block, four of each of (1, 0), (3, 0) and (3, 1).
  EXPECT_EQ(LowerTriangle(blocks, unknowns).build().nonZeros(), 4 * 3 + 3 * 4);
}

}  // namespace
}  // namespace perilink

#include "calibration/bounded_least_squares/symmetry_reduced/reduced_equations.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace perilink {
namespace {

/// Three points of two rows: the first column is that of points 0 and 2, the second of 0 alone, the
/// third of 0 and 2 again.
ReducedEquations::Matrix three_columns() {
  ReducedEquations::Matrix columns(3, 6);
  columns.insert(0, 0) = 1.0;
  columns.insert(0, 1) = 1.0;
  columns.insert(0, 5) = 1.0;
  columns.insert(1, 1) = 1.0;
  columns.insert(2, 0) = 1.0;
  columns.insert(2, 4) = 1.0;
  columns.makeCompressed();
  return columns;
}

TEST(ReducedEquations, TellWhichPointsShareVariables) {
  using Pairs = std::vector<std::pair<Index, Index>>;
  EXPECT_EQ(shared_variables(three_columns(), 2),
            (Pairs{{0, 0}, {0, 0}, {0, 0}, {0, 2}, {0, 2}, {2, 2}, {2, 2}}));
}

TEST(ReducedEquations, AreReadPointByPoint) {
  std::vector<std::pair<int, int>> parts;
  for_each_point(three_columns(), 0, 2,
                 [&](int first, int last) { parts.emplace_back(first, last); });
  EXPECT_EQ(parts, (std::vector<std::pair<int, int>>{{0, 2}, {2, 3}}));
}

/// An unknown of n variables stands for sqrt(n) times their change.
TEST(ReducedEquations, GiveEveryVariableItsWeight) {
  ReducedEquations reduced;
  reduced.unknown_of = {0, 1, 0, 0, 0};
  reduced.root = {2.0, 1.0};
  EXPECT_EQ(reduced.weights(std::vector<double>{1.5, 1.5}),
            (std::vector<double>{1.25, 1.5, 1.25, 1.25, 1.25}));
}

}  // namespace
}  // namespace perilink

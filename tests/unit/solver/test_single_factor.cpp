#include "solver/single_factor.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

#include "solver/factor_routes.hpp"

namespace perilink {
namespace {

/// A chain whose unknowns also depend on those `far` places behind: supernodes of many widths, and
/// one that is dense where far is as large as the chain.
SparseMatrix chain(Index size, Index far) {
  std::vector<Eigen::Triplet<double, Index>> entries;
  for (Index k = 0; k < size; ++k) {
    entries.emplace_back(k, k, 10.0 * far + std::sin(3.0 * k));
    for (Index step = 1; step <= far && k + step < size; ++step) {
      if (step < 4 || step % 5 == 0 || far == size) {
        entries.emplace_back(k + step, k, std::cos(7.0 * k + step));
      }
    }
  }
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

TEST(SingleFactor, SolvesAsTheFactorItIsCopiedFrom) {
  for (const auto& [size, far] : {std::pair(1, 1), {7, 7}, {37, 37}, {120, 11}, {90, 40}}) {
    const auto factor = make_factor(FactorRoute::refactorize, 1);
    std::vector<Index> groups;
    for (Index k = 0; k < size; ++k) groups.push_back(k);
    factor->factorize(chain(size, far), groups);
    constexpr double unit = 3.0;
    const SingleFactor single = factor->in_single(unit);
    Eigen::MatrixXd sides(size, block_width);
    for (Index k = 0; k < size; ++k) {
      for (int c = 0; c < block_width; ++c) sides(k, c) = std::sin(2.0 + 5.0 * k + 11.0 * c);
    }
    std::vector<float> found(static_cast<std::size_t>(size) * block_width);
    const auto at = [&](Index k, int c) -> float& {
      return found[static_cast<std::size_t>(single.place[k]) * block_width + c];
    };
    for (Index k = 0; k < size; ++k) {
      for (int c = 0; c < block_width; ++c) at(k, c) = static_cast<float>(sides(k, c));
    }
    single.solve(found);
    factor->solve_all({sides.data(), static_cast<std::size_t>(sides.size())});
    const double largest = unit * sides.cwiseAbs().maxCoeff();
    for (Index k = 0; k < size; ++k) {  // a few units of single precision
      for (int c = 0; c < block_width; ++c) {
        ASSERT_NEAR(at(k, c), unit * sides(k, c), 3e-6 * largest) << size << ' ' << k << ' ' << c;
      }
    }
  }
}

TEST(SingleFactor, IsNotMadeOfOtherRoutes) {
  EXPECT_THROW(make_factor(FactorRoute::in_place, 1)->in_single(1.0), std::logic_error);
}

}  // namespace
}  // namespace perilink

#include <gtest/gtest.h>

#include "solver/factor_routes.hpp"
#include "support/spring_lattice.hpp"

namespace perilink {
namespace {

using test::make_spring_lattice;
using test::random_vector;

/// Large enough that the factor has more numbers than the smallest that is solved in parallel.
test::SpringLattice large_lattice() { return make_spring_lattice(75, 75, 3.0); }

TEST(InPlaceFactor, GivesTheSameBytesForAnyNumberOfThreads) {
  const auto lattice = large_lattice();
  const auto load = random_vector(lattice.size, 1);
  std::vector<std::vector<double>> solutions;
  for (const int threads : {1, 2, 3}) {
    const auto factor = make_factor(FactorRoute::in_place, threads);
    factor->factorize(lattice.lower, lattice.groups);
    EXPECT_GT(factor->statistics().entries, 2e6) << "too small to be solved in parallel";
    std::vector<double> solution(load.size());
    factor->solve(load, solution);
    for (std::size_t k = 0; k < 20; ++k) {
      const SparseVector& x = lattice.springs[100 * k];
      const double pivot = factor->pivot(x), load_change = 0.0;
      factor->downdate({&x, 1}, {&load_change, 1}, {&pivot, 1}, solution);
    }
    solutions.push_back(solution);
  }
  EXPECT_EQ(solutions[0], solutions[1]);
  EXPECT_EQ(solutions[0], solutions[2]);
}

TEST(InPlaceFactor, AnIndefiniteRemovalShowsInThePivotOnly) {
  const auto lattice = make_spring_lattice(7, 7, 1.5);
  const auto factor = make_factor(FactorRoute::in_place, 1);
  factor->factorize(lattice.lower, lattice.groups);
  SparseVector twice = lattice.springs[10];
  for (int k = 0; k < twice.size(); ++k) twice.values[k] *= 2.0;

  EXPECT_LT(factor->pivot(twice), 0.0);
  EXPECT_GT(factor->pivot(lattice.springs[10]), 0.0);
}

TEST(InPlaceFactor, CountsItsFactorizations) {
  const auto lattice = make_spring_lattice(7, 7, 1.5);
  const auto factor = make_factor(FactorRoute::in_place, 1);
  factor->factorize(lattice.lower, lattice.groups);
  factor->refactorize(lattice.lower);
  EXPECT_EQ(factor->statistics().factorizations, 2);
  EXPECT_EQ(factor->statistics().size, lattice.size);
}

}  // namespace
}  // namespace perilink

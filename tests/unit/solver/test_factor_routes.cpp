#include "solver/factor_routes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "base/error.hpp"
#include "io/case/case_words.hpp"
#include "solver/ordering.hpp"
#include "support/spring_lattice.hpp"

namespace perilink {
namespace {

using test::make_spring_lattice;
using test::random_vector;
using test::relative_difference;

/// Condition numbers here stay below 1e5, so solutions agree to 1e-10 (1e5 times round-off, with
/// two digits of margin).
constexpr double tolerance = 1e-10;

std::vector<double> dense_solution(const Eigen::MatrixXd& matrix, const std::vector<double>& rhs) {
  const Eigen::VectorXd solution =
      matrix.ldlt().solve(Eigen::Map<const Eigen::VectorXd>(rhs.data(), rhs.size()));
  return {solution.begin(), solution.end()};
}

Eigen::VectorXd dense_vector(const SparseVector& x, Index size) {
  Eigen::VectorXd dense = Eigen::VectorXd::Zero(size);
  for (int k = 0; k < x.size(); ++k) dense[x.rows[k]] = x.values[k];
  return dense;
}

/// Removes one vector, whose load grows by `load_change` x.
void remove(Factor& factor, const SparseVector& x, double load_change, std::span<double> solution) {
  const double pivot = factor.pivot(x);
  factor.downdate({&x, 1}, {&load_change, 1}, {&pivot, 1}, solution);
}

class EveryRoute : public testing::TestWithParam<std::pair<FactorRoute, int>> {
 protected:
  std::unique_ptr<Factor> make() const { return make_factor(GetParam().first, GetParam().second); }
};

TEST_P(EveryRoute, SolvesLikeADenseFactor) {
  const auto lattice = make_spring_lattice(13, 17, 3.0);
  const auto rhs = random_vector(lattice.size, 1);
  std::vector<double> solution(rhs.size());
  const auto factor = make();

  factor->factorize(lattice.lower, lattice.groups);
  factor->solve(rhs, solution);

  EXPECT_LT(relative_difference(solution, dense_solution(lattice.dense(), rhs)), tolerance);
}

TEST_P(EveryRoute, PivotIsTheRatioOfDeterminants) {
  const auto lattice = make_spring_lattice(9, 9, 2.3);
  const auto factor = make();
  factor->factorize(lattice.lower, lattice.groups);

  for (std::size_t k = 0; k < lattice.springs.size(); k += 37) {
    const Eigen::VectorXd x = dense_vector(lattice.springs[k], lattice.size);
    const double expected = 1.0 - x.dot(lattice.dense().ldlt().solve(x));
    EXPECT_NEAR(factor->pivot(lattice.springs[k]), expected, tolerance);
  }
}

TEST_P(EveryRoute, FollowsRemovalsAndTheirLoadChanges) {
  const auto lattice = make_spring_lattice(13, 17, 3.0);
  auto load = random_vector(lattice.size, 3);
  std::vector<double> solution(load.size());
  const auto factor = make();
  factor->factorize(lattice.lower, lattice.groups);
  factor->solve(load, solution);
  Eigen::MatrixXd expected = lattice.dense();

  for (std::size_t k = 5; k < lattice.springs.size(); k += 11) {
    const SparseVector& x = lattice.springs[k];
    const double load_change = k % 2 == 0 ? 0.0 : 0.25;
    remove(*factor, x, load_change, solution);
    const Eigen::VectorXd dense = dense_vector(x, lattice.size);
    expected -= dense * dense.transpose();
    for (int a = 0; a < x.size(); ++a) load[x.rows[a]] += load_change * x.values[a];
  }

  EXPECT_LT(relative_difference(solution, dense_solution(expected, load)), tolerance);
  const auto other = random_vector(lattice.size, 4);
  factor->solve(other, solution);
  EXPECT_LT(relative_difference(solution, dense_solution(expected, other)), tolerance);
}

TEST_P(EveryRoute, LookingChangesNothing) {
  const auto lattice = make_spring_lattice(8, 8, 2.3);
  const auto rhs = random_vector(lattice.size, 5);
  std::vector<double> before(rhs.size()), after(rhs.size());
  const auto factor = make();
  factor->factorize(lattice.lower, lattice.groups);
  factor->solve(rhs, before);

  std::vector<double> compliance(4);
  for (std::size_t k = 1; k < lattice.springs.size(); ++k) {
    factor->pivot(lattice.springs[k]);
    factor->compliance(std::span(lattice.springs).subspan(k, 1), compliance);
    factor->columns(std::span(lattice.springs).subspan(k - 1, 2));
  }
  factor->solve(rhs, after);

  EXPECT_LT(relative_difference(after, before), 1e-14);
}

TEST_P(EveryRoute, UpdateAddsASpringAndTheNextDowndateUndoesIt) {
  const auto lattice = make_spring_lattice(8, 8, 2.3);
  const auto load = random_vector(lattice.size, 6);
  std::vector<double> solution(load.size());
  const auto factor = make();
  factor->factorize(lattice.lower, lattice.groups);
  factor->solve(load, solution);
  const auto before = solution;
  SparseVector spring;
  spring.add(17, 2.0);

  factor->update(spring);
  auto grown = load;  // by the force of the spring: the solution stays
  grown[17] += 2.0 * 2.0 * before[17];
  std::vector<double> with_spring(load.size());
  factor->solve(grown, with_spring);
  EXPECT_LT(relative_difference(with_spring, before), tolerance);
  remove(*factor, spring, -2.0 * solution[17], solution);

  EXPECT_LT(relative_difference(solution, before), tolerance);
  factor->solve(load, solution);
  EXPECT_LT(relative_difference(solution, before), tolerance);
}

TEST_P(EveryRoute, RefactorizeForgetsTheRemovals) {
  const auto lattice = make_spring_lattice(8, 8, 2.3);
  const auto load = random_vector(lattice.size, 7);
  std::vector<double> before(load.size()), after(load.size());
  const auto factor = make();
  factor->factorize(lattice.lower, lattice.groups);
  factor->solve(load, before);
  remove(*factor, lattice.springs[3], 0.0, after = before);

  factor->refactorize(lattice.lower);
  factor->solve(load, after);

  EXPECT_LT(relative_difference(after, before), 1e-14);
}

TEST_P(EveryRoute, NamesTheUnknownOfAMatrixThatIsNotPositiveDefinite) {
  auto lattice = make_spring_lattice(6, 6, 1.5);
  lattice.lower.coeffRef(20, 20) = -1.0;
  const auto factor = make();
  try {
    factor->factorize(lattice.lower, lattice.groups);
    FAIL() << "an indefinite matrix was factorised";
  } catch (const SolverError& error) {
    EXPECT_NE(std::string(error.what()).find("not positive definite"), std::string::npos);
  }
}

/// Vectors on the unknowns of one spring, as the modes of a frame are.
std::vector<SparseVector> several_vectors(const SparseVector& spring, int count) {
  std::vector<SparseVector> vectors(static_cast<std::size_t>(count), spring);
  for (int a = 0; a < count; ++a) {
    const auto values = random_vector(spring.size(), 50 + a);
    for (int k = 0; k < spring.size(); ++k) vectors[a].values[k] = 0.2 * values[k];
  }
  vectors.back().rows.pop_back();  // a held unknown
  vectors.back().values.pop_back();
  return vectors;
}

TEST_P(EveryRoute, ComplianceOfSeveralVectorsIsThatOfADenseFactor) {
  const auto lattice = make_spring_lattice(9, 9, 2.3);
  const auto factor = make();
  factor->factorize(lattice.lower, lattice.groups);
  const Eigen::MatrixXd inverse = lattice.dense().inverse();
  for (std::size_t s = 0; s < lattice.springs.size(); s += 37) {
    const auto vectors = several_vectors(lattice.springs[s], 3);
    std::vector<double> compliance(9);
    factor->compliance(vectors, compliance);
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        const double expected = dense_vector(vectors[a], lattice.size)
                                    .dot(inverse * dense_vector(vectors[b], lattice.size));
        EXPECT_NEAR(compliance[3 * a + b], expected, tolerance);
      }
    }
  }
}

TEST_P(EveryRoute, DowndatesOfSeveralVectorsFollowTheLoad) {
  const auto lattice = make_spring_lattice(9, 9, 2.3, 1.0);  // the ground can spare them
  const auto factor = make();
  factor->factorize(lattice.lower, lattice.groups);
  std::vector<double> load = random_vector(lattice.size, 2);
  std::vector<double> solution(load.size());
  factor->solve(load, solution);
  Eigen::MatrixXd matrix = lattice.dense();
  for (std::size_t s = 0; s < lattice.springs.size(); s += 37) {
    // Vectors that do not interact: the second less its share of the first.
    auto vectors = several_vectors(lattice.springs[s], 2);
    vectors[1].add(vectors[0].rows.back(), 0.1);
    std::vector<double> compliance(4);
    factor->compliance(vectors, compliance);
    for (int k = 0; k < vectors[0].size(); ++k) {
      vectors[1].values[k] -= compliance[1] / compliance[0] * vectors[0].values[k];
    }
    factor->compliance(vectors, compliance);
    const std::vector<double> changes = {0.3, -0.2};
    const std::vector<double> pivots = {1.0 - compliance[0], 1.0 - compliance[3]};
    factor->downdate(vectors, changes, pivots, solution);
    for (int a = 0; a < 2; ++a) {
      const Eigen::VectorXd x = dense_vector(vectors[a], lattice.size);
      matrix -= x * x.transpose();
      for (Index k = 0; k < lattice.size; ++k) load[k] += changes[a] * x[k];
    }
    EXPECT_LT(relative_difference(solution, dense_solution(matrix, load)), tolerance);
    std::vector<double> other(load.size());
    factor->solve(load, other);
    EXPECT_LT(relative_difference(other, dense_solution(matrix, load)), tolerance);
  }
}

TEST_P(EveryRoute, ColumnsOfManyBondsAreThoseOfTheDenseInverse) {
  const auto lattice = make_spring_lattice(9, 9, 2.3);
  const auto factor = make();
  factor->factorize(lattice.lower, lattice.groups);
  const auto size = static_cast<std::size_t>(lattice.size);
  std::vector<double> solution(size);
  remove(*factor, lattice.springs[5], 0.0, solution);  // the columns are those of the changed K
  const Eigen::VectorXd gone = dense_vector(lattice.springs[5], lattice.size);
  const Eigen::MatrixXd inverse = (lattice.dense() - gone * gone.transpose()).inverse();
  std::vector<SparseVector> x;  // from all over the lattice, on different paths
  for (std::size_t s = 0; s < lattice.springs.size(); s += 37) x.push_back(lattice.springs[s]);
  x.emplace_back();  // none of its unknowns moves

  const std::vector<double> columns = factor->columns(x);

  ASSERT_EQ(columns.size(), x.size() * size);
  for (std::size_t c = 0; c < x.size(); ++c) {
    const Eigen::VectorXd expected = inverse * dense_vector(x[c], lattice.size);
    for (std::size_t k = 0; k < size; ++k) {
      EXPECT_NEAR(columns[c * size + k], expected[k], tolerance * inverse.norm());
    }
  }
}

TEST_P(EveryRoute, DowndatesWithoutASolutionChangeTheFactorAlone) {
  const auto lattice = make_spring_lattice(9, 9, 2.3);
  const auto rhs = random_vector(lattice.size, 8);
  const auto factor = make();
  factor->factorize(lattice.lower, lattice.groups);
  Eigen::MatrixXd matrix = lattice.dense();
  for (const std::size_t k : {3, 50, 51}) {
    remove(*factor, lattice.springs[k], 0.0, {});
    const Eigen::VectorXd x = dense_vector(lattice.springs[k], lattice.size);
    matrix -= x * x.transpose();
  }

  std::vector<double> solution(rhs.size());
  factor->solve(rhs, solution);
  EXPECT_LT(relative_difference(solution, dense_solution(matrix, rhs)), tolerance);
}

TEST_P(EveryRoute, KeepsWhatIsWantedCurrent) {
  const auto lattice = make_spring_lattice(13, 17, 3.0);
  const auto load = random_vector(lattice.size, 9);
  std::vector<double> solution(load.size());
  const auto factor = make();
  factor->factorize(lattice.lower, lattice.groups);
  factor->solve(load, solution);
  const SparseVector& x = lattice.springs[40];
  std::vector<std::uint8_t> wanted(load.size(), 0);
  for (const Index row : x.rows) wanted[row] = 1;
  factor->keep_current(wanted);

  remove(*factor, x, 0.0, solution);

  const Eigen::VectorXd dense = dense_vector(x, lattice.size);
  const auto expected = dense_solution(lattice.dense() - dense * dense.transpose(), load);
  const double size =
      std::abs(*std::ranges::max_element(expected, {}, [](double u) { return std::abs(u); }));
  for (const Index row : x.rows) EXPECT_NEAR(solution[row], expected[row], tolerance * size);
}

INSTANTIATE_TEST_SUITE_P(Routes, EveryRoute,
                         testing::Values(std::pair{FactorRoute::in_place, 1},
                                         std::pair{FactorRoute::in_place, 2},
                                         std::pair{FactorRoute::cholmod_updown, 1},
                                         std::pair{FactorRoute::refactorize, 1}),
                         [](const auto& parameter) {
                           return std::string(word_of(parameter.param.first)) +
                                  std::to_string(parameter.param.second);
                         });

}  // namespace
}  // namespace perilink

// Both updates follow changes of K as one interface: K^-1 is compared with a dense inverse.

#include "analysis/quasistatic/equilibrium/update/make_update.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

class Updates : public testing::TestWithParam<LinearSolver> {
 protected:
  Updates()
      : problem_(make_block({cubic, false, false, 4, 0.1, false, true})),
        body_(problem_, problem_.unknowns, nullptr) {
    options_.solver = GetParam();
    options_.subdomains.tolerance = 1e-12;
    options_.event_tolerance = 0.02;
    update_ = make_update(body_, problem_, options_);
    update_->begin(false);
    while (!problem_.network.has_limit(bond_)) ++bond_;
    load_ = problem_.unknowns.restrict(problem_.loads.forces);
  }

  Eigen::VectorXd expected() const {
    const Eigen::MatrixXd lower(body_.stiffness());
    const Eigen::MatrixXd whole = lower.selfadjointView<Eigen::Lower>();
    return whole.llt().solve(
        Eigen::Map<const Eigen::VectorXd>(load_.data(), static_cast<Index>(load_.size())));
  }

  /// 1e-9: conjugate gradients of 1e-12 in the energy norm, and the condition number.
  void expect_solution(const std::vector<double>& solution, double tolerance = 1e-9) const {
    const Eigen::VectorXd exact = expected();
    const Eigen::Map<const Eigen::VectorXd> found(solution.data(), exact.size());
    EXPECT_LT((found - exact).norm(), tolerance * exact.norm());
  }

  AnalysisBody problem_;
  DamagedBody body_;
  EquilibriumOptions options_;
  std::unique_ptr<Update> update_;
  std::vector<double> load_;
  Index bond_ = 0;
};

TEST_P(Updates, FollowTheirBody) {
  std::vector<double> solution(load_.size(), 0.0);
  update_->inverse().solve(load_, solution);
  expect_solution(solution);

  Removal removal = body_.removal(body_.unknowns(), bond_, 0.4);
  removal.pivot[0] = update_->inverse().pivot(removal.x[0]);
  update_->announce(removal.vectors());
  body_.weaken(bond_, 0.4);
  update_->inverse().downdate(removal.vectors(), removal.load_changes(), removal.pivots(),
                              solution);
  expect_solution(solution);
  EXPECT_FALSE(update_->lags());

  body_.weaken(bond_ + 1, 0.5);
  update_->renew();
  update_->inverse().solve(load_, solution);
  expect_solution(solution);
}

TEST_P(Updates, SearchFromTheLastSolution) {
  std::vector<double> solution(load_.size(), 0.0), forces(load_.size()), residual = load_;
  update_->inverse().solve(load_, solution);
  for (Index e = bond_; e < bond_ + 5; ++e) body_.weaken(e, 0.5);
  body_.multiply(solution, forces);
  double energy = 0.0;
  for (std::size_t k = 0; k < load_.size(); ++k) {
    residual[k] -= forces[k];
    energy += solution[k] * forces[k];
  }
  ASSERT_TRUE(update_->search(residual, solution, energy, LoadSet::growing));
  expect_solution(solution);
  EXPECT_TRUE(update_->searches());

  std::vector<double> rough = load_;
  update_->solve_roughly(rough, energy);
  expect_solution(rough, 0.1);
}

INSTANTIATE_TEST_SUITE_P(All, Updates,
                         testing::Values(LinearSolver::direct, LinearSolver::iterative),
                         [](const auto& test) {
                           return std::string(test.param == LinearSolver::direct ? "factor"
                                                                                 : "columns");
                         });

/// A change of few entries of the factor is the cheapest way, one of very many the dearest.
TEST(FactorUpdates, ChooseTheCheapestWay) {
  const AnalysisBody problem = make_block({cubic, false, false, 5, 0.1, false, true});
  DamagedBody body(problem, problem.unknowns, nullptr);
  const auto update = make_update(body, problem, {.solver = LinearSolver::direct});
  update->begin(false);
  EXPECT_EQ(update->cheapest_way(1.0), Way::change);
  EXPECT_NE(update->cheapest_way(1e15), Way::change);
  EXPECT_FALSE(update->is_cheaper_anew(1));
  EXPECT_TRUE(update->is_cheaper_anew(1000000));
  EXPECT_FALSE(update->drift().has_value());
}

TEST(ColumnUpdates, RefuseEmbeddedParticles) {
  AnalysisBody problem = make_block({cubic, false, false, 4, 0.1, false, true});
  DamagedBody body(problem, problem.unknowns, nullptr);
  problem.embedded.emplace();
  EXPECT_THROW(make_update(body, problem, {.solver = LinearSolver::iterative}),
               std::invalid_argument);
}

}  // namespace
}  // namespace perilink

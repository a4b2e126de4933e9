#include "model/from_case/analysis_options.hpp"

#include <gtest/gtest.h>

#include "support/strip_case.hpp"

namespace perilink {
namespace {

using test::strip_case;

TEST(AnalysisOptions, OfDamageFollowTheCase) {
  CaseFile input = strip_case();
  input.analysis.load_factors = {0.5, 1.0};
  input.stop.broken_bonds = 7;
  input.stop.load_fraction = 0.25;
  input.stop.displacement = 0.5;
  DamageOptions options = damage_options(input, 3);
  EXPECT_EQ(options.engine.threads, 3);
  EXPECT_EQ(options.engine.route, FactorRoute::in_place);
  EXPECT_TRUE(options.load_factors.empty()) << "control is by events";
  EXPECT_EQ(options.stop.broken_bonds, 7);
  EXPECT_EQ(options.stop.load_fraction, 0.25);
  EXPECT_EQ(options.stop.displacement, 0.5);
  input.analysis.control = LoadControl::steps;
  input.analysis.factor = FactorRoute::refactorize;
  options = damage_options(input, 1);
  EXPECT_EQ(options.load_factors, (std::vector<double>{0.5, 1.0}));
  EXPECT_EQ(options.engine.route, FactorRoute::refactorize);
  EXPECT_EQ(options.engine.solver, LinearSolver::automatic);
  EXPECT_EQ(options.engine.subdomains.edge, 0);
  input.analysis.solver = LinearSolver::iterative;
  input.analysis.coarse_box = 5;
  EXPECT_EQ(damage_options(input, 1).engine.solver, LinearSolver::iterative);
  EXPECT_EQ(damage_options(input, 1).engine.subdomains.edge, 5);
  input.analysis.factor = FactorRoute::cholmod_updown;
  EXPECT_EQ(damage_options(input, 1).engine.route, FactorRoute::cholmod_updown);
}

TEST(AnalysisOptions, StagesFollowTheCase) {
  CaseFile input = strip_case();
  input.stages.resize(3);
  input.stages[0].name = input.stages[0].loads = input.stages[2].loads = "weight";
  input.stages[0].to = 1.0;
  input.stages[1].name = input.stages[1].loads = "push";
  input.stages[1].stop.displacement = 0.5;
  input.stages[2].name = "less";
  input.stages[2].to = 0.5;
  const std::vector<StageRules> stages = damage_options(input, 1).stages;
  ASSERT_EQ(stages.size(), 3u);
  EXPECT_EQ(stages[0].set, 0u);
  EXPECT_EQ(stages[0].to, 1.0);
  EXPECT_EQ(stages[1].set, 1u);
  EXPECT_FALSE(stages[1].to);
  EXPECT_EQ(stages[1].stop.displacement, 0.5);
  EXPECT_EQ(stages[2].set, 0u);
}

TEST(AnalysisOptions, OfElasticAnswersFollowTheCase) {
  CaseFile input = strip_case();
  EXPECT_EQ(elastic_options(input, 2).threads, 2);
  EXPECT_EQ(elastic_options(input, 1).subdomains.tolerance, 1e-10);
  EXPECT_EQ(elastic_options(input, 1).subdomains.edge, 0);
  input.analysis.solver = LinearSolver::iterative;
  input.analysis.tolerance = 1e-6;
  input.analysis.coarse_box = 5;
  const ElasticOptions options = elastic_options(input, 1);
  EXPECT_EQ(options.solver, LinearSolver::iterative);
  EXPECT_EQ(options.subdomains.tolerance, 1e-6);
  EXPECT_EQ(options.subdomains.edge, 5);
}

}  // namespace
}  // namespace perilink

#include "analysis/quasistatic/boxes/box_solver.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

TEST(BoxSolver, CountsIterationsAndTheErrorItLeaves) {
  const AnalysisBody body = make_block({cubic});
  const std::vector<double> secants = intact(body.network);
  BoxSolver solver(body.network, body.unknowns, secants, {.tolerance = 1e-8, .edge = 2});
  EXPECT_GT(solver.num_boxes(), 8);
  EXPECT_EQ(solver.coarse().size, 6 * solver.num_boxes());
  const std::vector<double> load = body.unknowns.restrict(body.loads.forces);
  std::vector<double> solution = load;
  solver.solve(solution, solution);  // may be the same memory
  EXPECT_GT(solver.iterations(), 5);
  EXPECT_LE(solver.error(), 1e-8);
  const Eigen::VectorXd expected = dense_displacement(body, secants);
  EXPECT_LT(difference(body.unknowns.expand(solution), expected), 1e-6);
}

/// What is left of a solution is small already: the second search ends at once.
TEST(BoxSolver, ACorrectionCountsByTheSolutionThatItCorrects) {
  const AnalysisBody body = make_block({cubic});
  const std::vector<double> secants = intact(body.network);
  BoxSolver solver(body.network, body.unknowns, secants, {.tolerance = 1e-8, .edge = 2});
  std::vector<double> load = body.unknowns.restrict(body.loads.forces), solution = load;
  solver.solve(load, solution);
  const int first = solver.iterations();
  for (double& force : load) force *= 1e-9;
  solver.solve(load, solution);
  EXPECT_EQ(solver.iterations(), first);
}

/// Springs so soft that the body turns ten million times as far as it is strained: bonds in single
/// precision see no strain, and the network has the last word.
TEST(BoxSolver, SolvesForBodiesThatTurnFarOnSoftSprings) {
  AnalysisBody body = make_block({cubic});
  number(body, [](Index, int) { return false; });
  body.network.support_stiffness.assign(body.loads.forces.size(), 1e-7 * body.network.stiffness[0]);
  body.loads.forces[0] += 0.3;  // off the axis
  const std::vector<double> secants = intact(body.network);
  BoxSolver solver(body.network, body.unknowns, secants, {.edge = 2});
  const std::vector<double> load = body.unknowns.restrict(body.loads.forces);
  std::vector<double> solution(load.size());
  solver.solve(load, solution);
  const InternalForce internal =
      internal_force(body.network, secants, body.unknowns.expand(solution));
  double missing = 0.0, size = 0.0;
  for (std::size_t k = 0; k < load.size(); ++k) {
    missing = std::max(missing, std::abs(load[k] - internal.forces[k]));
    size = std::max(size, std::abs(load[k]));
  }
  EXPECT_LT(missing, 1e-7 * size) << "sixteen digits of motions less seven";
}

TEST(BoxSolver, RefusesABodyThatNothingHolds) {
  AnalysisBody body = make_block({cubic});
  number(body, [](Index, int) { return false; });
  const std::vector<double> secants = intact(body.network);
  EXPECT_THROW(
      {
        BoxSolver solver(body.network, body.unknowns, secants, {.edge = 2});
        std::vector<double> solution = body.unknowns.restrict(body.loads.forces);
        solver.solve(solution, solution);
      },
      SolverError);
}

TEST(BoxSolver, RefusesParticlesThatSomethingCarries) {
  AnalysisBody body = make_block({cubic});
  std::size_t held = 0;
  while (body.unknowns.number[held] != no_index) ++held;
  const Unknowns::Share half[] = {{0, 0.5}};
  body.unknowns.carry(held, half);
  const std::vector<double> secants = intact(body.network);
  EXPECT_THROW(BoxSolver(body.network, body.unknowns, secants, {}), std::invalid_argument);
}

}  // namespace
}  // namespace perilink

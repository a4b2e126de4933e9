#include "analysis/quasistatic/subdomains/subdomain_solver.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include "assembly/internal_force.hpp"
#include "base/error.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

TEST(SubdomainSolver, CountsIterationsAndTheErrorItLeaves) {
  const AnalysisBody body = make_block({cubic});
  const std::vector<double> secants = intact(body.network);
  SubdomainSolver solver(body.network, body.unknowns, secants, {.tolerance = 1e-8, .edge = 2});
  EXPECT_GT(solver.num_subdomains(), 8);
  EXPECT_EQ(solver.coarse().size, 6 * solver.num_subdomains());
  const std::vector<double> load = body.unknowns.restrict(body.loads.forces);
  std::vector<double> solution = load;
  solver.solve(solution, solution);  // may be the same memory
  EXPECT_GT(solver.iterations(), 5);
  EXPECT_LE(solver.error(), 1e-8);
  const Eigen::VectorXd expected = dense_displacement(body, secants);
  EXPECT_LT(difference(body.unknowns.expand(solution), expected), 1e-6);
}

/// The remaining correction is small: the second solve ends at once.
TEST(SubdomainSolver, ACorrectionCountsByTheSolutionThatItCorrects) {
  const AnalysisBody body = make_block({cubic});
  const std::vector<double> secants = intact(body.network);
  SubdomainSolver solver(body.network, body.unknowns, secants, {.tolerance = 1e-8, .edge = 2});
  std::vector<double> load = body.unknowns.restrict(body.loads.forces), solution = load;
  solver.solve(load, solution);
  const int first = solver.iterations();
  for (double& force : load) force *= 1e-9;
  solver.solve(load, solution);
  EXPECT_EQ(solver.iterations(), first);
}

/// Largest force that is out of balance, over the largest load.
double imbalance(const AnalysisBody& body, Secants secants, std::span<const double> load,
                 std::span<const double> solution) {
  const std::vector<double> held = body.unknowns.restrict(
      internal_force(body.network, secants, body.unknowns.expand(solution)).forces);
  double missing = 0.0, size = 0.0;
  for (std::size_t k = 0; k < load.size(); ++k) {
    missing = std::max(missing, std::abs(load[k] - held[k]));
    size = std::max(size, std::abs(load[k]));
  }
  return missing / size;
}

/// Motions of a cantilever of 1 by 1500 spacings are 1e9 times its strains: seven digits of bonds
/// are too few there, and the network goes on. Sixteen of motions less nine are left.
TEST(SubdomainSolver, GoesOnByTheNetworkInSlenderBodies) {
  LatticeInput input = body_input({"", Pattern::rectangular, Surface::none}, 4);
  input.horizon = 1.5 * input.spacing;
  input.solid[0].upper = {1500.0 * input.spacing, input.spacing, 0.0};
  AnalysisBody body = free_body(build_network(make_body(input), network_input(input)));
  body.loads.forces[slot(body, body.network.particles.size() - 1, 1)] = 1.0;
  number(body,
         [&](Index p, int) { return body.network.particles.position(p)[0] < 0.5 * input.spacing; });
  const std::vector<double> secants = intact(body.network);
  SubdomainSolver solver(body.network, body.unknowns, secants, {.tolerance = 1e-13});
  const std::vector<double> load = body.unknowns.restrict(body.loads.forces);
  std::vector<double> solution(load.size());
  solver.solve(load, solution);
  EXPECT_LT(imbalance(body, secants, load, solution), 1e-3);
}

TEST(SubdomainSolver, ThreadsChangeNothing) {
  const AnalysisBody body = make_block({.lattice = cubic, .columns = 16});
  ASSERT_GT(body.network.particles.size(), 4000) << "taken in parts";
  const std::vector<double> secants = intact(body.network);
  const std::vector<double> load = body.unknowns.restrict(body.loads.forces);
  const int before = omp_get_max_threads();
  std::vector<std::vector<double>> solutions;
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    SubdomainSolver solver(body.network, body.unknowns, secants, {});
    solutions.emplace_back(load.size());
    solver.solve(load, solutions.back());
  }
  omp_set_num_threads(before);
  EXPECT_LT(imbalance(body, secants, load, solutions[0]), 1e-7);
  EXPECT_EQ(solutions[1], solutions[0]);
  EXPECT_EQ(solutions[2], solutions[0]);
}

TEST(SubdomainSolver, RefusesABodyThatNothingHolds) {
  AnalysisBody body = make_block({cubic});
  number(body, [](Index, int) { return false; });
  const std::vector<double> secants = intact(body.network);
  EXPECT_THROW(
      {
        SubdomainSolver solver(body.network, body.unknowns, secants, {.edge = 2});
        std::vector<double> solution = body.unknowns.restrict(body.loads.forces);
        solver.solve(solution, solution);
      },
      SolverError);
}

TEST(SubdomainSolver, RefusesParticlesThatSomethingCarries) {
  AnalysisBody body = make_block({cubic});
  std::size_t held = 0;
  while (body.unknowns.number[held] != no_index) ++held;
  const Unknowns::Share half[] = {{0, 0.5}};
  body.unknowns.carry(held, half);
  const std::vector<double> secants = intact(body.network);
  EXPECT_THROW(SubdomainSolver(body.network, body.unknowns, secants, {}), std::invalid_argument);
}

}  // namespace
}  // namespace perilink

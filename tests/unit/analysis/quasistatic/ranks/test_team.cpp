#include "analysis/quasistatic/ranks/team.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "analysis/quasistatic/subdomains/subdomain_solver.hpp"
#include "app/process/serve.hpp"
#include "assembly/stiffness.hpp"
#include "base/error.hpp"
#include "support/analysis_bodies.hpp"
#include "support/thread_ranks.hpp"

namespace perilink {
namespace {

using namespace test;

/// A block with a spring.
AnalysisBody block_on_spring(const BlockCase& block) {
  AnalysisBody body = make_block(block);
  body.network.support_stiffness.assign(body.unknowns.number.size(), 0.0);
  body.network.support_stiffness.back() = 10.0;
  return body;
}

std::vector<double> solve(const AnalysisBody& body, Secants secants, Ranks* ranks) {
  SubdomainSolver solver(body.network, body.unknowns, secants,
                         {.tolerance = 1e-12, .edge = 2, .ranks = ranks});
  std::vector<double> solution =
      assemble_right_hand_side(body.network, secants, body.unknowns, body.loads);
  solver.solve(solution, solution);
  return body.unknowns.expand(solution);
}

/// Eight columns of the inverse and the answer to loads, one after the other, by a solver that was
/// made before elements failed, one shed its stiffness against shear, and springs were added.
std::vector<double> solve_after_changes(const AnalysisBody& body, Ranks* ranks) {
  std::vector<double> axial = intact(body.network), other = axial, ground;
  SubdomainSolver solver(body.network, body.unknowns, {other, axial},
                         {.tolerance = 1e-12, .edge = 2, .blocks = true, .ranks = ranks}, &ground);
  EXPECT_EQ(solver.num_ranks(), ranks == nullptr ? 1 : ranks->count());
  std::vector<double> results, load = body.unknowns.restrict(body.loads.forces);
  const std::vector<std::size_t> slots = body.unknowns.slots();
  const auto solve_for_all = [&] {
    std::vector<double> right(body.unknowns.number.size() * block_width, 0.0),
        columns(right.size());
    for (int c = 0; c < block_width; ++c)
      right[slots[(7 * c + 1) % slots.size()] * block_width + c] = 1.0 + c;
    solver.solve_block(right, columns, 1e-12);
    results.insert(results.end(), columns.begin(), columns.end());
    std::vector<double> solution(load.size());
    solver.solve(load, solution);
    results.insert(results.end(), solution.begin(), solution.end());
  };
  solve_for_all();
  for (std::size_t e = 5; e < axial.size(); e += 6) axial[e] = other[e] = e % 4 == 0 ? 0.0 : 0.4;
  other[3] = 0.5;
  solve_for_all();
  ground.assign(load.size(), 0.0);
  ground[2] = ground[11] = 100.0;
  solve_for_all();
  return results;
}

class TeamTest : public testing::TestWithParam<std::tuple<BlockCase, int>> {};

TEST_P(TeamTest, FindsTheEquilibriumOfTheWholeBody) {
  const auto& [block, count] = GetParam();
  const AnalysisBody body = block_on_spring(block);
  std::vector<double> secants = intact(body.network);
  secants[secants.size() / 2] = 0.5;
  const std::vector<double> alone = solve(body, secants, nullptr);
  with_thread_ranks(
      count,
      [&](Ranks& ranks) {
        const std::vector<double> shared = solve(body, secants, &ranks);
        dismiss(ranks);
        // Both searches end at 1e-12 in the norm of energy.
        EXPECT_LT(difference_of(alone, shared), 1e-10);
      },
      serve);
}

TEST_P(TeamTest, FollowsWhatChanges) {
  const auto& [block, count] = GetParam();
  const AnalysisBody body = block_on_spring(block);
  const std::vector<double> alone = solve_after_changes(body, nullptr);
  with_thread_ranks(
      count,
      [&](Ranks& ranks) {
        const std::vector<double> shared = solve_after_changes(body, &ranks);
        dismiss(ranks);
        EXPECT_EQ(shared.size(), alone.size());
        EXPECT_LT(difference_of(alone, shared), 1e-10);
      },
      serve);
}

const LatticeCase square_lattice{"square", Pattern::rectangular, Surface::none};

INSTANTIATE_TEST_SUITE_P(
    Bodies, TeamTest,
    testing::Combine(testing::Values(BlockCase{square_lattice}, BlockCase{square_lattice, true},
                                     BlockCase{cubic},
                                     BlockCase{.lattice = cubic, .driven = true, .bar = true},
                                     BlockCase{.lattice = square_lattice, .micropolar = true},
                                     BlockCase{.lattice = cubic, .micropolar = true}),
                     testing::Values(2, 3, 5)),
    [](const auto& instance) {
      return to_string(std::get<0>(instance.param)) + "_" +
             std::to_string(std::get<1>(instance.param));
    });

TEST(Team, ABodyThatNothingHoldsIsRefusedByAllRanks) {
  AnalysisBody body = make_block({cubic});
  number(body, [](Index, int) { return false; });
  const std::vector<double> secants = intact(body.network);
  with_thread_ranks(
      2,
      [&](Ranks& ranks) {
        EXPECT_THROW(solve(body, secants, &ranks), SolverError);
        dismiss(ranks);
      },
      serve);
}

}  // namespace
}  // namespace perilink

#include "analysis/quasistatic/ranks/team.hpp"

#include <gtest/gtest.h>

#include "analysis/quasistatic/boxes/box_solver.hpp"
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
  BoxSolver solver(body.network, body.unknowns, secants,
                   {.tolerance = 1e-12, .edge = 2, .ranks = ranks});
  std::vector<double> solution =
      assemble_right_hand_side(body.network, secants, body.unknowns, body.loads);
  solver.solve(solution, solution);
  return body.unknowns.expand(solution);
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
        double size = 0.0, difference = 0.0;
        for (std::size_t k = 0; k < alone.size(); ++k) {
          size = std::max(size, std::abs(alone[k]));
          difference = std::max(difference, std::abs(alone[k] - shared[k]));
        }
        // Both searches end at 1e-12 in the norm of energy.
        EXPECT_LT(difference, 1e-10 * size);
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

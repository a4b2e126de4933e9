#include "analysis/dynamics/fundamental_period.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "base/error.hpp"
#include "network/rigid_modes.hpp"
#include "support/dense_vibration.hpp"

namespace perilink {
namespace {

using namespace test;

double period_of(const AnalysisBody& body, const Inertia& inertia) {
  return fundamental_period(body.network, body.unknowns, inertia);
}

/// N equal masses m in series on springs k, the first spring fixed: the slowest vibration is 2
/// sqrt(k/m) sin(pi / (2 (2 N + 1))).
TEST(FundamentalPeriod, OfAChainIsTheClosedForm) {
  const double stiffness = 3.0, mass = 0.7;
  // Three equal chains have a triple eigenvalue, which does not disturb the quotient. The long ones
  // have many particles in a subdomain.
  for (const auto& [columns, tolerance] : {std::pair{12, 1e-7}, std::pair{900, 6e-7}}) {
    const AnalysisBody body = make_chains(columns, 3, false, stiffness, INFINITY);
    Inertia inertia;
    inertia.mass.assign(body.unknowns.number.size(), mass);
    const double frequency = 2.0 * std::sqrt(stiffness / mass) *
                             std::sin(std::numbers::pi / (2.0 * (2.0 * columns + 1.0)));
    EXPECT_NEAR(period_of(body, inertia), 2.0 * std::numbers::pi / frequency,
                tolerance / frequency);
  }
}

class Periods : public testing::TestWithParam<BlockCase> {};

/// To ten times the tolerance of the iteration.
TEST_P(Periods, AreThoseOfTheDenseMatrix) {
  AnalysisBody body = make_block(GetParam());
  const Inertia inertia = lumped_inertia(body.network, std::vector{1.0, 1.0});
  const double exact = dense_period(body, inertia);
  EXPECT_NEAR(period_of(body, inertia), exact, 1e-7 * exact);
  body.network.support_stiffness.assign(body.unknowns.number.size(), 2.0);
  const double on_springs = dense_period(body, inertia);
  EXPECT_LT(on_springs, 0.99 * exact);
  EXPECT_NEAR(period_of(body, inertia), on_springs, 1e-7 * on_springs);
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, Periods,
    testing::Values(BlockCase{{"plane", Pattern::rectangular, Surface::none}, false, false, 12},
                    BlockCase{{"plane", Pattern::hexagonal, Surface::none}, true, true, 8},
                    BlockCase{{"space", Pattern::cubic, Surface::none}, true, false, 5},
                    BlockCase{
                        {"plane", Pattern::rectangular, Surface::none}, true, false, 9, 0.1, true},
                    BlockCase{{"space", Pattern::cubic, Surface::none}, true, false, 3, 0.1, true}),
    [](const auto& body) { return to_string(body.param) + std::to_string(body.index); });

/// Bends a hundred thousand times more easily than it stretches.
TEST(FundamentalPeriod, OfASlenderBeamIsThatOfTheDenseMatrix) {
  const AnalysisBody body = cantilever(130, 2);
  const Inertia inertia = lumped_inertia(body.network, std::vector{1.0});
  const double exact = dense_period(body, inertia);
  EXPECT_NEAR(period_of(body, inertia), exact, 1e-7 * exact);
}

/// Period of a cantilever of two rows over the square of its length.
double period_over_square(int length) {
  const AnalysisBody body = cantilever(length, 2);
  return period_of(body, lumped_inertia(body.network, std::vector{1.0})) / length / length;
}

/// Bends 1e12 times more easily than bonds stretch; rounded forces keep four digits of that. Beams
/// of a length L take a + b / L times L^2: particles next to the held end are softer.
TEST(FundamentalPeriod, OfABeamTwoThousandTimesAsLongAsItsSpacingHasThreeDigits) {
  const double at_250 = period_over_square(250), at_500 = period_over_square(500);
  const double a = 2.0 * at_500 - at_250, b = 500.0 * (at_250 - at_500);
  for (const int length : {1500, 2200}) {
    const double expected = a + b / length;
    EXPECT_NEAR(period_over_square(length), expected, 2e-4 * expected) << length;
  }
}

/// Its period would be found 0.2 % too short.
TEST(FundamentalPeriod, OfABeamThatRoundOffHoldsIsRefused) {
  EXPECT_THROW(period_over_square(3000), SolverError);
}

TEST(FundamentalPeriod, FreeBodiesHaveNone) {
  AnalysisBody body = make_block({{"plane", Pattern::rectangular, Surface::none}});
  body = free_body(body.network);
  number(body, [](Index, int) { return false; });
  const Inertia inertia = lumped_inertia(body.network, std::vector{1.0});
  EXPECT_THROW(period_of(body, inertia), SolverError);
  // Three rigid motions are excluded.
  const std::vector<std::uint8_t> held(body.unknowns.number.size(), 0);
  const std::vector<Fragment> parts = find_fragments(body.network, held);
  ASSERT_EQ(parts.size(), 1U);
  const double exact = dense_period(body, inertia, 3);
  EXPECT_NEAR(fundamental_period(body.network, body.unknowns, inertia,
                                 free_motions(body.network, parts[0], held)),
              exact, 1e-7 * exact);
}

TEST(FundamentalPeriod, IsInfiniteWhereNothingIsFree) {
  AnalysisBody body = make_block({{"plane", Pattern::rectangular, Surface::none}});
  number(body, [](Index, int) { return true; });
  EXPECT_TRUE(std::isinf(period_of(body, lumped_inertia(body.network, std::vector{1.0}))));
}

}  // namespace
}  // namespace perilink

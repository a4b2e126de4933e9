#include "analysis/fundamental_period.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "base/error.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// N equal masses m behind one another on springs k, the first spring held: the slowest vibration
/// is 2 sqrt(k/m) sin(pi / (2 (2 N + 1))).
TEST(FundamentalPeriod, OfAChainIsTheClosedForm) {
  const int columns = 12;
  const double stiffness = 3.0, mass = 0.7;
  const AnalysisBody body = make_chains(columns, 3, false, stiffness, INFINITY);
  Inertia inertia;
  inertia.mass.assign(body.unknowns.number.size(), mass);
  const double frequency = 2.0 * std::sqrt(stiffness / mass) *
                           std::sin(std::numbers::pi / (2.0 * (2.0 * columns + 1.0)));
  // Three equal chains: the eigenvalue comes three times, which the quotient does not mind.
  EXPECT_NEAR(fundamental_period(body.network, body.unknowns, inertia, 1),
              2.0 * std::numbers::pi / frequency, 1e-7 / frequency);
}

TEST(FundamentalPeriod, FreeBodiesHaveNone) {
  AnalysisBody body = make_block({{"plane", Pattern::rectangular, Surface::none}});
  body = free_body(body.network);
  number(body, [](Index, int) { return false; });
  const Inertia inertia = lumped_inertia(body.network, std::vector{1.0});
  EXPECT_THROW(fundamental_period(body.network, body.unknowns, inertia, 1), SolverError);
}

}  // namespace
}  // namespace perilink

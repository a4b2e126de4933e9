#include "analysis/quasistatic/events/single_event_engine.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// A spring of stiffness 1 and a bar of stiffness 2, both of unit length, in parallel between a
/// fixed particle and a free one. A spring of stiffness 1 joins the free particle to one moved by
/// 1.
AnalysisBody make_yielding_bar(double yield_strain) {
  const BarMaterial bar{2.0, 1.0, 2.0 * yield_strain, false};
  return make_chains(2, 2, true, 1.0, infinity, {{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}}, bar);
}

/// With secant a the free particle moves by 1 / (2 + 2 a). Segment k ends at s_k = s_y sqrt(r) r^k,
/// where the bar carries sqrt(r) times its yield force; there the secant falls to r^-(k+1).
TEST(SingleEventEngine, BarYieldsAlongTheSawTooth) {
  constexpr double strain = 0.01, r = 1.05;
  const AnalysisBody body = make_yielding_bar(strain);
  const Index bar = body.network.first_bar_element;
  ASSERT_EQ(body.network.num_elements(), bar + 1);
  for (const FactorRoute route : routes) {
    SingleEventEngine engine(body, with_route(route));
    for (int k = 0; k < 60; ++k) {
      const double secant = std::pow(r, -k), limit = strain * std::sqrt(r) * std::pow(r, k);
      EXPECT_NEAR(engine.secants()[bar], secant, 1e-13 * secant);
      const Event event = engine.next_event();
      ASSERT_EQ(event.element, bar);
      EXPECT_NEAR(event.load_factor, limit * (2.0 + 2.0 * secant), 1e-12);
      const EventOutcome outcome = engine.apply(event);
      EXPECT_NEAR(outcome.pivot, (2.0 + 2.0 * secant / r) / (2.0 + 2.0 * secant), 1e-13);
      const double force = 2.0 * engine.secants()[bar] * event.load_factor *
                           stretch(body.network, engine.displacement(), bar);
      EXPECT_LT(force, 2.0 * strain * std::sqrt(r));
      EXPECT_GT(force, 2.0 * strain / std::sqrt(r));
    }
  }
}

/// Two bonds of unit stiffness and length in series, parallel to an elastic row, whose end is moved
/// by lambda. With secants a of the first and 1 of the second, the first stretches by lambda / (1 +
/// a). Its segments end at 0.01, 0.014 and 0.03 (lambda = 0.02, 0.0224, 0.036) before the second
/// reaches 0.01.
TEST(SingleEventEngine, BondsLoseTheirStiffnessToothByTooth) {
  AnalysisBody body = make_chains(2, 2, true, 1.0, 0.01);
  for (const Index e : bonds_of_row(body.network, 1.0)) body.network.critical_stretch[e] = infinity;
  body.network.laws.front() = three_segments();
  for (const FactorRoute route : routes) {
    SingleEventEngine engine(body, with_route(route));
    const Index first = engine.next_event().element;
    const double segments[] = {1.0, 0.6, 0.2, 0.0}, factors[] = {0.02, 0.0224, 0.036};
    for (int k = 0; k < 3; ++k) {
      const Event event = engine.next_event();
      EXPECT_EQ(event.element, first);
      EXPECT_NEAR(event.load_factor, factors[k], 1e-15);
      const EventOutcome outcome = engine.apply(event);
      EXPECT_FALSE(outcome.mechanism);
      EXPECT_EQ(outcome.secant, segments[k + 1]);
      EXPECT_EQ(outcome.broke(), k == 2);
      EXPECT_NEAR(outcome.pivot, (1.0 + segments[k + 1]) / (1.0 + segments[k]), 1e-14);
      EXPECT_EQ(engine.secants()[first], segments[k + 1]);
    }
  }
}

TEST(SingleEventEngine, BarYieldsInCompressionToo) {
  AnalysisBody body = make_yielding_bar(0.01);
  for (double& value : body.unknowns.prescribed) value = -value;
  SingleEventEngine engine(body, {});
  const Event event = engine.next_event();
  EXPECT_EQ(event.element, body.network.first_bar_element);
  EXPECT_NEAR(event.load_factor, 0.04 * std::sqrt(1.05), 1e-15);
}

TEST(SingleEventEngine, BarThatWasCutDoesNotYield) {
  const AnalysisBody body = make_yielding_bar(0.01);
  SingleEventEngine engine(body, {});
  const std::vector<Index> bar{body.network.first_bar_element};
  EXPECT_EQ(engine.cut(bar), 0);
  EXPECT_EQ(engine.next_event().element, no_index);
}

/// In a rigid motion the stretches of bonds are round-off and give no event. On weak springs
/// round-off must not hide the bond that breaks. (Springs followed by a factor are compared with
/// the motion of their ends.)
TEST(SingleEventEngine, TellsNoEventOfWhatOnlyMoves) {
  for (const bool micropolar : {false, true}) {
    for (const LinearSolver solver : {LinearSolver::direct, LinearSolver::iterative}) {
      if (!micropolar && solver == LinearSolver::direct) continue;
      AnalysisBody body =
          make_block({{"cubic", Pattern::cubic, Surface::none}, true, false, 4, 0.1, micropolar});
      const auto width = static_cast<std::size_t>(body.network.width());
      for (std::size_t slot = 0; slot < body.unknowns.number.size(); slot += width) {
        if (body.unknowns.number[slot] == no_index) body.unknowns.prescribed[slot] = 1.0;
      }
      EquilibriumOptions options;
      options.solver = solver;
      options.subdomains.edge = 3;
      SingleEventEngine engine(body, options);
      EXPECT_NEAR(engine.displacement()[0], 1.0, 1e-9);
      EXPECT_THROW(engine.next_event(), SolverError) << micropolar;
    }
  }
}

/// Bodies under pure compression have no event, and the search returns that.
TEST(SingleEventEngine, TellsThatNothingIsInTension) {
  AnalysisBody body = make_chains(2, 3, true, 1.0, 0.1);
  for (double& motion : body.unknowns.prescribed) motion = -motion;
  SingleEventEngine engine(body, {});
  EXPECT_LT(engine.displacement()[body.network.width()], 0.0);
  EXPECT_EQ(engine.next_event().element, no_index);
}

}  // namespace
}  // namespace perilink

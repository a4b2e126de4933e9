#include "analysis/quasistatic/events/event_engine.hpp"

#include <gtest/gtest.h>

#include "io/case/case_words.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

std::unique_ptr<EventEngine> engine_for(const AnalysisBody& body,
                                        FactorRoute route = FactorRoute::in_place) {
  EquilibriumOptions options;
  options.route = route;
  return make_event_engine(body, options);
}

/// The figures of make_square(): all come out to round-off.
TEST(EventEngine, TwoEventsByHand) {
  const AnalysisBody body = make_square();
  for (const FactorRoute route : routes) {
    const auto engine = engine_for(body, route);
    EXPECT_NEAR(engine->load_work().forces, 4.0 / 3.0, 1e-14);
    const Event first = engine->next_event();
    EXPECT_EQ(first.element, bond_between(body.network, {0, 0}, {1, 0}))
        << "of two equal bonds the lower number";
    EXPECT_NEAR(first.load_factor, 0.015, 1e-16);
    const EventOutcome outcome = engine->apply(first);
    EXPECT_FALSE(outcome.mechanism);
    EXPECT_NEAR(outcome.pivot, 1.0 / 3.0, 1e-14);              // (1/2) / (1 + 1/2)
    EXPECT_NEAR(outcome.released, 0.5 * 4.0 / 9.0, 1e-14);     // k e^2 / 2
    EXPECT_NEAR(outcome.compliance_growth, 4.0 / 3.0, 1e-14);  // 2 - 2/3
    EXPECT_NEAR(engine->load_work().forces, 8.0 / 3.0, 1e-14);

    const Event second = engine->next_event();
    EXPECT_EQ(second.element, bond_between(body.network, {0, 1}, {1, 0}));
    EXPECT_NEAR(second.load_factor, 0.01, 1e-16);  // stretch (2 / sqrt 2) / sqrt 2 = 1
    const EventOutcome last = engine->apply(second);
    EXPECT_TRUE(last.mechanism);
    EXPECT_LT(std::abs(last.pivot), 1e-14);
    EXPECT_EQ(engine->secants()[second.element], 1.0) << "nothing was changed";
    EXPECT_NEAR(engine->load_work().forces, 8.0 / 3.0, 1e-14);
  }
}

/// Two bonds in series between a fixed and a displaced particle. When one breaks, the particle
/// between them stays with the other.
TEST(EventEngine, BrokenBondToADrivenParticleChangesTheLoad) {
  for (const FactorRoute route : routes) {
    for (const int broken : {0, 1}) {
      AnalysisBody body = make_chains(2, 2, true, 3.0, 0.01);
      const Index element = bonds_of_row(body.network, 0.0)[broken];
      const Index middle = body.network.bonds.second[bonds_of_row(body.network, 0.0)[0]];
      body.network.critical_stretch[element] = 0.005;
      const auto engine = engine_for(body, route);
      EXPECT_NEAR(engine->load_work().supports, 2 * 1.5, 1e-14);
      const Event event = engine->next_event();
      EXPECT_EQ(event.element, element);
      EXPECT_NEAR(event.load_factor, 0.01, 1e-16);
      const EventOutcome outcome = engine->apply(event);
      EXPECT_NEAR(outcome.pivot, 0.5, 1e-15);
      EXPECT_NEAR(outcome.compliance_growth, 1.5, 1e-14);
      EXPECT_NEAR(engine->displacement()[slot(body, middle, 0)], broken == 0 ? 1.0 : 0.0, 1e-15);
      EXPECT_NEAR(engine->load_work().supports, 1.5, 1e-14);
    }
  }
}

/// A bond between two prescribed particles holds no unknown: it breaks without motion.
TEST(EventEngine, BondBetweenPrescribedParticles) {
  AnalysisBody body = make_chains(1, 2, true, 3.0, 0.01);
  number(body, [&](Index i, int axis) { return axis == 0 || i != 0; });  // one idle unknown
  body.network.stiffness[bond_between(body.network, {0, 0}, {0, 1})] = 1.0;
  const auto engine = engine_for(body);
  const EventOutcome outcome = engine->apply(engine->next_event());
  EXPECT_EQ(outcome.pivot, 1.0);
  EXPECT_NEAR(outcome.compliance_growth, 3.0, 1e-14);
  EXPECT_NEAR(engine->load_work().supports, 3.0, 1e-14);
  EXPECT_EQ(engine->next_event().element, bonds_of_row(body.network, 1.0)[0]);
}

TEST(EventEngine, NothingBreaksInCompression) {
  AnalysisBody body = make_square();
  for (double& force : body.loads.forces) force = -force;
  EXPECT_EQ(engine_for(body)->next_event().element, no_index);
}

class FollowedBlock : public testing::TestWithParam<BlockCase> {
 protected:
  void expect_equilibrium(EventEngine& engine) const {
    const Eigen::VectorXd expected = dense_displacement(body_, engine.secants());
    EXPECT_LT(difference(engine.displacement(), expected), tolerance);
    const Eigen::MatrixXd stiffness = dense_stiffness(body_.network, engine.secants());
    const auto slots = static_cast<Index>(body_.loads.forces.size());
    const double forces =
        Eigen::Map<const Eigen::VectorXd>(body_.loads.forces.data(), slots).dot(expected);
    // Reactions K u on the prescribed displacements.
    const double supports =
        Eigen::Map<const Eigen::VectorXd>(body_.unknowns.prescribed.data(), slots)
            .dot(stiffness * expected);
    const LoadWork work = engine.load_work();
    EXPECT_NEAR(work.forces, forces, tolerance * forces);
    EXPECT_NEAR(work.supports, supports, tolerance * initial_work_);
  }

  /// Load factor at which the first bond breaks, bond by bond.
  double brute_force(EventEngine& engine) const {
    const Eigen::VectorXd u = dense_displacement(body_, engine.secants());
    double largest = 0.0;
    for (Index e = 0; e < body_.network.first_bar_element; ++e) {
      if (engine.secants()[e] == 0.0) continue;
      largest = std::max(largest, stretch(body_.network, {u.data(), u.data() + u.size()}, e) /
                                      body_.network.critical_stretch[e]);
    }
    return 1.0 / largest;
  }

  /// The condition number of these bodies grows to some 1e5 while they come apart.
  static constexpr double tolerance = 1e-10;
  AnalysisBody body_ = make_block(GetParam());
  double initial_work_ = 0.0;
};

TEST_P(FollowedBlock, FollowsADenseSolutionThroughTheEvents) {
  // Bonds to displacement-controlled particles break among the first, so that the load changes with
  // them.
  const Bonds& bonds = body_.network.bonds;
  for (Index e = 0; e < body_.network.first_slip_spring; e += 7) {
    const bool driven = body_.unknowns.prescribed[slot(body_, bonds.first[e], 0)] != 0.0 ||
                        body_.unknowns.prescribed[slot(body_, bonds.second[e], 0)] != 0.0;
    if (driven) body_.network.critical_stretch[e] = 0.005;
  }
  for (const FactorRoute route : routes) {
    SCOPED_TRACE(word_of(route));
    const auto engine = engine_for(body_, route);
    LoadWork work = engine->load_work();
    initial_work_ = work.forces + work.supports;
    expect_equilibrium(*engine);
    for (int k = 0; k < 40; ++k) {
      const Event event = engine->next_event();
      if (event.element == no_index) break;
      const double first_bond = brute_force(*engine);
      if (body_.network.is_segment(event.element)) {
        EXPECT_LT(event.load_factor, first_bond * (1.0 + tolerance));
      } else {
        EXPECT_NEAR(event.load_factor, first_bond, tolerance * first_bond);
      }
      const std::vector<double> before(engine->secants().begin(), engine->secants().end());
      const EventOutcome outcome = engine->apply(event);
      if (outcome.mechanism) break;
      EXPECT_LT(engine->secants()[event.element], before[event.element]);
      expect_equilibrium(*engine);
      const LoadWork after = engine->load_work();
      EXPECT_NEAR((after.forces - after.supports) - (work.forces - work.supports),
                  outcome.compliance_growth, tolerance * (after.forces + initial_work_));
      work = after;
      if (work.forces + work.supports < 1e-3 * initial_work_) break;  // in two
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EventEngine, FollowedBlock,
                         testing::Values(BlockCase{rectangular}, BlockCase{rectangular, true, true},
                                         BlockCase{hexagonal_ghost, false, true},
                                         BlockCase{hexagonal_ghost, true},
                                         BlockCase{cubic, false, false, 3},
                                         BlockCase{cubic, true, true, 3},
                                         BlockCase{rectangular, false, true, 6, 0.1, true},
                                         BlockCase{hexagonal_ghost, true, true, 6, 0.1, true},
                                         BlockCase{cubic, false, false, 3, 0.1, true},
                                         BlockCase{cubic, true, true, 3, 0.1, true}),
                         [](const auto& test) { return to_string(test.param); });

}  // namespace
}  // namespace perilink

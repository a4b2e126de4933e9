// src/analysis/quasistatic/equilibrium/separation.cpp: what holds the ends of an element once
// it is gone.

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/quasistatic/events/single_event_engine.hpp"
#include "io/case/case_words.hpp"
#include "support/slender_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

SingleEventEngine make_engine(const AnalysisBody& body, FactorRoute route) {
  EquilibriumOptions options;
  options.route = route;
  return {body, options};
}

/// Particle 0 at the origin, pulled by 1 along x and held by a bond of stiffness 1 that can break
/// and one of stiffness `rest` that cannot; it keeps its y. With `bending`, the bonds are
/// micropolar and it keeps its rotation too.
AnalysisBody make_pair(double rest, double bending = 0.0) {
  Network network;
  network.particles.dim = network.bonds.dim = 2;
  network.particles.positions = {0, 0, -1, 0, -2, 0};
  network.particles.volumes.assign(3, 1.0);
  network.particles.material.assign(3, 0);
  network.particles.kind.assign(3, ParticleKind::solid);
  network.bonds.append(network.particles, 0, 1);
  network.bonds.append(network.particles, 0, 2);
  network.stiffness = {1.0, rest};
  if (bending > 0.0) network.bending = {bending, bending * rest};
  network.critical_stretch = {1e-3, infinity};
  network.first_slip_spring = network.first_bar_element = 2;
  AnalysisBody body = free_body(std::move(network));
  body.loads.forces[0] = 1.0;
  number(body, [](Index i, int axis) { return i > 0 || axis > 0; });
  body.reference = {false, 1.0};
  return body;
}

/// A bond whose removal needs a new factor closes as others do.
TEST(Separation, ABondRemovedWithANewFactorMayClose) {
  AnalysisBody body = make_pair(1e-20);
  body.network.laws = {BondLaw::brittle().closing()};
  Equilibrium equilibrium(body, {});
  ASSERT_FALSE(equilibrium.weaken(0, 0.0).mechanism);
  EXPECT_EQ(equilibrium.state().damaged, std::vector<Index>{0});
}

/// The pivot is rest / (1 + rest), however small: what remains carries the load at u = 1 / rest.
TEST(Separation, WhatIsWeakStillHolds) {
  for (const double bending : {0.0, 2.0}) {
    for (const double rest : {1e-3, 1e-8, 1e-13, 1e-20}) {
      for (const FactorRoute route : routes) {
        SCOPED_TRACE(std::string(word_of(route)) + " " + std::to_string(std::log10(rest)));
        const AnalysisBody body = make_pair(rest, bending);
        SingleEventEngine engine = make_engine(body, route);
        const Event event = engine.next_event();
        ASSERT_EQ(event.element, 0);
        const EventOutcome outcome = engine.apply(event);
        ASSERT_FALSE(outcome.mechanism);
        EXPECT_NEAR(outcome.pivot, rest / (1.0 + rest), 1e-14 * rest);
        // The analysis checks the equilibrium after every pivot this small.
        const Balance balance = engine.check_equilibrium();
        EXPECT_NEAR(balance.stored_energy, 0.5 / rest, 1e-9 / rest);  // the tolerance is 1e-10
        EXPECT_NEAR(engine.displacement()[0], 1.0 / rest, 1e-9 / rest);
        EXPECT_NEAR(engine.load_work().forces, 1.0 / rest, 1e-9 / rest);
        EXPECT_NEAR(outcome.compliance_growth, 1.0 / rest - 1.0 / (1.0 + rest), 1e-9 / rest);
      }
    }
  }
}

TEST(Separation, WhatIsNotThereHoldsNothing) {
  for (const double bending : {0.0, 2.0}) {
    for (const FactorRoute route : routes) {
      AnalysisBody body = make_pair(0.0, bending);
      SingleEventEngine engine = make_engine(body, route);
      const EventOutcome outcome = engine.apply(engine.next_event());
      EXPECT_TRUE(outcome.mechanism);
      EXPECT_EQ(outcome.pivot, 0.0);
      EXPECT_EQ(engine.secants()[0], 1.0);  // nothing was changed
      EXPECT_NEAR(engine.displacement()[0], 1.0, 1e-15);
    }
  }
}

/// Particle 0 at the origin is pulled or displaced by 1 along x and held by a bond of stiffness 1.
/// Two bonds across it, as along a row of a mesh, are parallel except for `tilt` and hold it by
/// twice the square of that. Displaced, it moves no free particle.
AnalysisBody make_row(double tilt, bool driven) {
  Network network;
  network.particles.dim = network.bonds.dim = 2;
  network.particles.positions = {0, 0, -1, 0, tilt, -1, -tilt, -1};
  network.particles.volumes.assign(4, 1.0);
  network.particles.material.assign(4, 0);
  network.particles.kind.assign(4, ParticleKind::solid);
  for (const Index end : {1, 2, 3}) network.bonds.append(network.particles, 0, end);
  network.stiffness = {1.0, 1.0, 1.0};
  network.critical_stretch = {1e-3, 1e-3, 1e-3};
  network.first_slip_spring = network.first_bar_element = 3;
  AnalysisBody body = free_body(std::move(network));
  (driven ? body.unknowns.prescribed : body.loads.forces)[0] = 1.0;
  number(body, [&](Index i, int axis) { return i > 0 || (driven && axis == 0); });
  body.reference = {driven, 1.0};
  return body;
}

/// The next bond would break at a motion of 1e8, and the straight line to that row of the history
/// would have done work without end.
TEST(Separation, WhatTheLastDigitsOfAMeshHoldHasSeparated) {
  for (const bool driven : {false, true}) {
    const AnalysisBody body = make_row(1e-11, driven);
    Recorder recorder;
    const DamageResult result = run(body, {}, recorder);
    EXPECT_EQ(result.termination, Termination::collapsed) << result.reason;
    EXPECT_EQ(result.broken_bonds, 1);
    EXPECT_LE(recorder.rows.back().displacement, 1.01e-3);
    EXPECT_LE(recorder.rows.back().external_work, 0.51e-6);
  }
}

TEST(Separation, WhatHoldsByATiltStillHolds) {
  for (const bool driven : {false, true}) {
    const AnalysisBody body = make_row(1e-4, driven);
    Recorder recorder;
    const DamageResult result = run(body, {}, recorder);
    ASSERT_GE(recorder.rows.size(), 2U);
    EXPECT_NEAR(recorder.rows[1].displacement, 1e-3 / 1e-4, 1e-3) << "both are stretched by 1e-3";
    EXPECT_EQ(result.termination, Termination::collapsed);
  }
}

/// Elastic supports alone must have at least a thousandth of the stiffness that held the particle.
TEST(Separation, WeakSupportsHoldNothing) {
  for (const double bending : {0.0, 2.0}) {
    for (const double spring : {1e-10, 0.9e-3, 1.1e-3, 1.0}) {
      AnalysisBody body = make_pair(0.0, bending);
      body.network.support_stiffness.assign(body.unknowns.number.size(), 0.0);
      body.network.support_stiffness[0] = spring;
      SingleEventEngine engine = make_engine(body, FactorRoute::in_place);
      const EventOutcome outcome = engine.apply(engine.next_event());
      EXPECT_EQ(outcome.mechanism, spring < 1e-3) << spring;
      if (outcome.mechanism) continue;
      EXPECT_NEAR(engine.displacement()[0], 1.0 / spring, 1e-12 / spring);
    }
  }
}

/// Round-off of reactions in a displacement-controlled body is 1e-16 times stiffness times
/// displacement.
TEST(Separation, DrivenBodiesThatNothingHoldsDoNoWork) {
  AnalysisBody body = make_slender({150, 3, SlenderLoad::driven_across});
  SingleEventEngine engine = make_engine(body, FactorRoute::in_place);
  LoadWork work = engine.load_work();
  EXPECT_FALSE(work.separated);
  EXPECT_GT(work.supports, 0.0);
  for (int k = 0; k < 2000 && !work.separated; ++k) {
    ASSERT_FALSE(engine.apply(engine.next_event()).mechanism);
    work = engine.load_work();
  }
  EXPECT_TRUE(work.separated);
  EXPECT_TRUE(engine.load_work().separated) << "whoever asks again hears the same";
  EXPECT_EQ(work.forces, 0.0);
  EXPECT_EQ(work.supports, 0.0);
}

TEST(Separation, RefinedDisplacementsOfSlenderBodiesBalance) {
  const AnalysisBody body = make_slender({600, 2, SlenderLoad::force_across});
  SingleEventEngine engine = make_engine(body, FactorRoute::in_place);
  // Double precision leaves 1e-16 times stiffness times deflection: 1e-6 of the load.
  const Balance balance = engine.check_equilibrium();
  EXPECT_LT(balance.residual, 1e-10);
  EXPECT_NEAR(2.0 * balance.stored_energy, engine.load_work().forces,
              1e-10 * engine.load_work().forces);
}

}  // namespace
}  // namespace perilink

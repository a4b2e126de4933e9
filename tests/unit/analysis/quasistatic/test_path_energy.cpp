#include "analysis/quasistatic/path_energy.hpp"

#include <gtest/gtest.h>

namespace perilink {
namespace {

EventOutcome event(double growth, double released) {
  EventOutcome outcome;
  outcome.compliance_growth = growth;
  outcome.released = released;
  return outcome;
}

/// Springs of stiffness 1, 1 and 2 in parallel under a force of 1: f'u is 1/4, then 1/3 without the
/// first spring, then 1/2 without the second. Rows at load factors 2, 3 (still rising) and 1. All
/// numbers are multiples of 1/12 and come out to round-off.
TEST(PathEnergy, TwoEventsUnderAForce) {
  PathEnergy energy;
  energy.advance(2.0, {0.25, 0.0});
  EXPECT_DOUBLE_EQ(energy.external_work(), 0.5 * 2.0 * 0.5);  // triangle: force 2, displacement 1/2
  EXPECT_DOUBLE_EQ(energy.stored(), 0.5);
  EXPECT_EQ(energy.dissipated(), 0.0);

  energy.add_event(event(1.0 / 3.0 - 0.25, 0.5 * 0.25 * 0.25));  // k e^2 / 2 at e = 1/4
  EXPECT_EQ(energy.dissipated(), 0.0) << "known when the path reaches the next row";
  energy.advance(3.0, {1.0 / 3.0, 0.0});
  // Trapezoid from (displacement 1/2, force 2) to (1, 3).
  EXPECT_DOUBLE_EQ(energy.external_work(), 0.5 + 0.5 * (2.0 + 3.0) * 0.5);
  EXPECT_DOUBLE_EQ(energy.stored(), 0.5 * 3.0 * 1.0);
  EXPECT_DOUBLE_EQ(energy.dissipated(), 0.5 * 2.0 * 3.0 / 12.0);
  EXPECT_DOUBLE_EQ(energy.released(), 4.0 * 0.03125);

  energy.add_event(event(0.5 - 1.0 / 3.0, 0.5 / 9.0));
  energy.advance(1.0, {0.5, 0.0});
  // Back from (1, 3) to (1/2, 1).
  EXPECT_DOUBLE_EQ(energy.external_work(), 1.75 - 0.5 * (3.0 + 1.0) * 0.5);
  EXPECT_DOUBLE_EQ(energy.stored(), 0.25);
  EXPECT_DOUBLE_EQ(energy.dissipated(), 0.25 + 0.5 * 3.0 * 1.0 / 6.0);
  EXPECT_DOUBLE_EQ(energy.released(), 0.125 + 9.0 * 0.5 / 9.0);
  EXPECT_DOUBLE_EQ(energy.external_work(), energy.stored() + energy.dissipated());
}

/// Springs moved by 1: R'd is 4, then 3, then 2, and f'u - R'd grows by 1 each time.
TEST(PathEnergy, TwoEventsUnderADisplacement) {
  PathEnergy energy;
  energy.advance(2.0, {0.0, 4.0});
  EXPECT_DOUBLE_EQ(energy.external_work(), 0.5 * 2.0 * 8.0);
  EXPECT_DOUBLE_EQ(energy.stored(), 8.0);

  energy.add_event(event(1.0, 0.5));
  energy.advance(3.0, {0.0, 3.0});
  EXPECT_DOUBLE_EQ(energy.external_work(), 8.0 + 0.5 * (8.0 + 9.0) * 1.0);
  EXPECT_DOUBLE_EQ(energy.stored(), 0.5 * 9.0 * 3.0);
  EXPECT_DOUBLE_EQ(energy.dissipated(), 0.5 * 2.0 * 3.0);

  energy.add_event(event(1.0, 0.5));
  energy.advance(1.0, {0.0, 2.0});
  EXPECT_DOUBLE_EQ(energy.external_work(), 16.5 - 0.5 * (9.0 + 2.0) * 2.0);
  EXPECT_DOUBLE_EQ(energy.stored(), 1.0);
  EXPECT_DOUBLE_EQ(energy.dissipated(), 3.0 + 0.5 * 3.0 * 1.0);
  EXPECT_DOUBLE_EQ(energy.released(), 4.0 * 0.5 + 9.0 * 0.5);
  EXPECT_DOUBLE_EQ(energy.external_work(), energy.stored() + energy.dissipated());
}

/// At a constant load the whole jump of the displacement works against the full force: half of it
/// is stored, half dissipated.
TEST(PathEnergy, EventsAtOneLoadFactor) {
  PathEnergy energy;
  energy.advance(2.0, {0.25, 0.0});
  energy.add_event(event(0.25, 0.0));
  energy.add_event(event(0.5, 0.0));
  energy.advance(2.0, {1.0, 0.0});
  EXPECT_DOUBLE_EQ(energy.external_work(), 0.5 + 2.0 * 1.5);
  EXPECT_DOUBLE_EQ(energy.stored(), 2.0);
  EXPECT_DOUBLE_EQ(energy.dissipated(), 1.5);
}

TEST(PathEnergy, ForcesAndDisplacementsTogether) {
  PathEnergy energy;
  energy.advance(1.5, {0.7, 0.2});
  energy.add_event(event((0.9 - 0.1) - (0.7 - 0.2), 0.0));  // growth of f'u - R'd
  energy.advance(0.5, {0.9, 0.1});
  // Round-off of a handful of operations.
  EXPECT_NEAR(energy.external_work(), energy.stored() + energy.dissipated(), 1e-15);
}

/// Springs of stiffness 1 and 1 in parallel under a constant force of 2 and a growing one of 1. One
/// breaks at load factor 4 (extension 3); at load factor 3 the other one is at 5.
TEST(PathEnergy, AnEventBesideAConstantForce) {
  const auto work = [](double compliance) {
    return LoadWork{
        compliance, 0.0, false, {4.0 * compliance, 2.0 * compliance, 0.0, 2.0 * compliance, 0.0}};
  };
  PathEnergy energy;
  energy.begin_stage(0.0, work(0.0));
  energy.advance(4.0, work(0.5));
  EXPECT_DOUBLE_EQ(energy.stored(), 9.0);
  EXPECT_DOUBLE_EQ(energy.external_work(), 2.0 * 3.0 + 0.5 * 4.0 * 3.0);
  EventOutcome outcome = event(0.5, 0.5 * 0.25);  // f'u is 1/2, then 1
  outcome.permanent_growth = {2.0 * 1.0, 2.0};    // twice f_c'u_p, and f_c'u_c
  outcome.released_by_permanent = {0.5, 0.5};     // e = 1 + lambda / 2
  energy.add_event(outcome);
  EXPECT_DOUBLE_EQ(energy.released(), 0.5 * 3.0 * 3.0);
  const double before = energy.external_work();
  energy.advance(3.0, work(1.0));
  EXPECT_DOUBLE_EQ(energy.external_work() - before, 2.0 * 2.0 + 0.5 * (4.0 + 3.0) * 2.0);
  EXPECT_DOUBLE_EQ(energy.stored(), 12.5);
  EXPECT_DOUBLE_EQ(energy.dissipated(), 0.5 * 3.0 * 5.0);
}

/// A body of compliance 1/2 becomes freer, 1, under a constant force of 2 and a growing one of 3:
/// no energy dissipates, and the loss of stored energy is reported separately.
TEST(PathEnergy, FreedomBesideAConstantForce) {
  const ConstantWork held{4.0 / 2.0, 2.0 / 2.0, 0.0, 2.0 / 2.0, 0.0};
  const ConstantWork freed{4.0 / 1.0, 2.0 / 1.0, 0.0, 2.0 / 1.0, 0.0};
  PathEnergy energy;
  energy.begin_stage(0.0, {0.0, 0.0, false, {}});
  energy.advance(3.0, {0.5, 0.0, false, held});
  const double left = energy.external_work() - energy.stored();
  energy.add_freedom({0.5, permanent_growth(held, freed)});
  energy.advance(3.0, {1.0, 0.0, false, freed});
  EXPECT_DOUBLE_EQ(energy.dissipated(), 0.0);
  EXPECT_DOUBLE_EQ(energy.freed(), energy.external_work() - energy.stored() - left);
  // (f_c + lambda f_p)^2 / 2 times the growth of the compliance from 1/2 to 1.
  EXPECT_DOUBLE_EQ(energy.freed(), 0.5 * 5.0 * 5.0 * 0.5);
}

}  // namespace
}  // namespace perilink

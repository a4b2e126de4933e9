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

/// Products of a body beside permanent loads, with no special values, as a part of a batch has
/// failed. The batch held an energy of 1.5 at load factor 2.
LoadWork work_within(double part) {
  return {
      0.7 + 0.4 * part,
      0.3 - 0.1 * part,
      false,
      {2.0 + 0.6 * part, 0.5 + 0.3 * part, 0.9 - 0.2 * part, 0.5 + 0.2 * part, 0.4 - 0.1 * part}};
}
EventOutcome part_of_batch(double from, double to, Index events) {
  const LoadWork before = work_within(from), after = work_within(to);
  EventOutcome outcome = event(after.compliance() - before.compliance(), 0.25 * (to - from));
  outcome.permanent_growth = permanent_growth(before.constant, after.constant);
  outcome.released_by_permanent = {0.2 * (to - from), 0.1 * (to - from)};
  outcome.yielded = events;
  return outcome;
}

/// Goes to load factor 2, where elements fail in some steps, and on to the next row.
PathEnergy path_of(int steps, Index events_each, double next) {
  PathEnergy energy;
  energy.begin_stage(0.0, work_within(0.0));
  energy.advance(2.0, work_within(0.0));
  for (int k = 0; k < steps; ++k) {
    const double to = (k + 1.0) / steps;
    energy.add_event(part_of_batch(static_cast<double>(k) / steps, to, events_each));
    energy.add_freedom({0.3 / steps, {0.2 / steps, 0.1 / steps}});
    energy.advance(k + 1 < steps ? 2.0 : next, work_within(to));
  }
  return energy;
}

/// Where the load rises, four of five elements fail at the load of their row.
TEST(PathEnergy, ABatchDissipatesNoMoreThanAtOneLoad) {
  const PathEnergy batch = path_of(1, 5, 3.0), single = path_of(5, 1, 3.0);
  EXPECT_NEAR(batch.dissipated(), single.dissipated(), 1e-14);
  EXPECT_LT(batch.dissipated(), path_of(1, 1, 3.0).dissipated() - 0.1) << "the line";
}

/// Where the load falls, four of five elements dissipate what they held.
TEST(PathEnergy, ABatchDissipatesNoLessThanItHeld) {
  for (const double next : {0.5, 0.0, -1.0}) {
    const double line = path_of(1, 1, next).dissipated();
    EXPECT_NEAR(path_of(1, 5, next).dissipated(), 0.2 * line + 0.8 * 1.5, 1e-14) << next;
  }
}

/// The work changes as the dissipated energy: both balance as along the line.
TEST(PathEnergy, ABatchKeepsTheBalance) {
  for (const double next : {3.0, 2.0, 1.9, 0.5, -1.0}) {
    const PathEnergy batch = path_of(1, 5, next), line = path_of(1, 1, next);
    const auto lost = [](const PathEnergy& energy) {
      return energy.external_work() - energy.stored() - energy.dissipated() - energy.freed();
    };
    EXPECT_NEAR(lost(batch), lost(line), 1e-13) << next;
    EXPECT_EQ(batch.released(), line.released());
  }
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

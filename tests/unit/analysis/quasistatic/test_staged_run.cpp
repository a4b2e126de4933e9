#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/analysis_bodies.hpp"
#include "support/staged_bodies.hpp"

namespace perilink {
namespace {

using namespace test;
using testing::HasSubstr;

/// Two rows of bonds in series from the held left end to x = 5, all of stiffness 2 and limit 0.01,
/// under their weight to the right (1 per particle at load factor 1), then pulled at the end by P
/// each: the first bonds carry 5 w + P.
TEST(StagedRun, PullsABarUnderItsWeight) {
  AnalysisBody body = make_chains(5, 2, false, 2.0, 0.01);
  LoadCase weight = set_of(body), pull = set_of(body);
  for (Index i = 0; i < body.network.particles.size(); ++i) {
    weight.loads.forces[slot(body, i, 0)] = 1.0;
  }
  weight.reference.value = 12.0;
  body.sets = {weight, pull};
  const double w = 0.001;
  Recorder recorder;
  const DamageResult result = run(body, in_stages({{0, w, {}}, {1, {}, {}}}), recorder);
  EXPECT_EQ(result.termination, Termination::collapsed);
  ASSERT_EQ(recorder.rows.size(), 2u);
  const StepRecord &heavy = recorder.rows[0], &pulled = recorder.rows[1];
  EXPECT_EQ(heavy.stage, 1);
  EXPECT_EQ(heavy.element, no_index);
  EXPECT_EQ(heavy.load_factor, w);
  EXPECT_NEAR(heavy.load, 12.0 * w, 1e-16);
  EXPECT_EQ(pulled.stage, 2);
  EXPECT_NEAR(pulled.load_factor, 2.0 * 0.01 - 5.0 * w, 1e-15);
  EXPECT_NEAR(pulled.load, 2.0 * pulled.load_factor, 1e-15);
  // The weight moves the end by (5 + 4 + 3 + 2 + 1) w / 2.
  EXPECT_NEAR(pulled.displacement, (15.0 * w + 5.0 * pulled.load_factor) / 2.0, 1e-15);
  double stored = 0.0;
  for (int bond = 1; bond <= 5; ++bond) stored += std::pow(bond * w + pulled.load_factor, 2) / 2.0;
  EXPECT_NEAR(pulled.strain_energy, stored, 1e-15);
  EXPECT_NEAR(pulled.external_work, stored, 1e-15);
  EXPECT_LT(result.energy_error, 1e-12);
  ASSERT_EQ(result.stages.size(), 2u);
  EXPECT_THAT(result.stages[0].reason, HasSubstr("0.001"));
  EXPECT_EQ(result.stages[1].termination, Termination::collapsed);
}

/// Chains of two bonds of stiffness 2 and limit 0.01, stretched by 0.01, whose middles a force F
/// moves by F / 4 each: the left bond is at its limit at F = 4 (0.01 - 0.005), the right one goes
/// slack.
TEST(StagedRun, LoadsAPrestressedTruss) {
  AnalysisBody body = make_chains(2, 2, true, 2.0, 0.01);
  LoadCase stretched = set_of(body), pushed = set_of(body);
  std::fill(pushed.unknowns.prescribed.begin(), pushed.unknowns.prescribed.end(), 0.0);
  for (Index i = 0; i < body.network.particles.size(); ++i) {
    if (std::abs(body.network.particles.position(i)[0] - 1.0) > 0.1) continue;
    pushed.loads.forces[slot(body, i, 0)] = 1.0;
  }
  pushed.reference = {false, 2.0};
  body.sets = {stretched, pushed};
  Recorder recorder;
  const DamageResult result = run(body, in_stages({{0, 0.01, {}}, {1, {}, {}}}), recorder);
  EXPECT_EQ(result.termination, Termination::nothing_breaks);
  ASSERT_EQ(recorder.rows.size(), 3u);
  EXPECT_NEAR(recorder.rows[0].load, 2.0 * 0.01, 1e-15) << "the reaction of two rows";
  EXPECT_NEAR(recorder.rows[0].displacement, 0.01, 1e-17);
  EXPECT_NEAR(recorder.rows[1].load_factor, 0.02, 1e-15);
  EXPECT_NEAR(recorder.rows[1].load, 0.04, 1e-15);
  EXPECT_NEAR(recorder.rows[1].displacement, 0.01, 1e-15);
  // Rows are independent: the other one breaks at an equal force. The rest of the first carries F =
  // 0.02 by a right bond that is shortened by 0.01.
  EXPECT_NEAR(recorder.rows[2].load_factor, 0.02, 1e-15);
  EXPECT_NEAR(recorder.rows[2].strain_energy, 2.0 * 0.01 * 0.01, 1e-15);
  // 2 (0.01) (0.02) / 2: half the stiffness times the stretch before and that of the gap after.
  EXPECT_NEAR(recorder.rows[2].dissipated_energy, 0.0002, 1e-15);
  EXPECT_LT(result.energy_error, 1e-12);
}

/// Chains of two bonds of stiffness 2 and limit 0.01 whose ends carry 0.01 each. The ends are
/// clamped in that position and displaced: bonds reach their limits after another 0.01.
TEST(StagedRun, GripsABodyWhereItIs) {
  AnalysisBody body = make_chains(2, 2, false, 2.0, 0.01);
  const LoadCase dead = set_of(body);
  body.sets = {dead, set_of(make_chains(2, 2, true, 2.0, 0.01))};
  Recorder recorder;
  const DamageResult result = run(body, in_stages({{0, 0.01, {}}, {1, {}, {}}}), recorder);
  ASSERT_GE(recorder.rows.size(), 3u);
  const StepRecord& gripped = recorder.rows[1];
  EXPECT_NEAR(recorder.rows[0].displacement, 0.01, 1e-16);
  EXPECT_NEAR(gripped.displacement, 0.01, 1e-15);
  EXPECT_NEAR(gripped.load, 2.0 * (2.0 * 0.01 - 0.01), 1e-15) << "the dead load bears its part";
  EXPECT_NEAR(gripped.strain_energy, 4.0 * 0.01 * 0.01, 1e-15);
  EXPECT_NEAR(gripped.external_work, gripped.strain_energy, 1e-15);
  // The other row reaches its limit at an equal displacement, and then no resistance remains.
  EXPECT_NEAR(recorder.rows[2].displacement, 0.01, 1e-15);
  EXPECT_NEAR(recorder.rows[2].load, 2.0 * 0.01 - 2.0 * 0.01, 1e-15);
  EXPECT_EQ(result.termination, Termination::collapsed);
  EXPECT_LT(result.energy_error, 1e-12);
}

/// make_square() under a dead load of up to 0.03 each: a horizontal bond breaks at 0.015; then its
/// end would move by 0.03, three halves of what the diagonal carries.
TEST(StagedRun, AConstantLoadThatIsTooBigMakesAnAvalanche) {
  AnalysisBody body = make_square();
  body.sets = {set_of(body)};
  Recorder recorder;
  const DamageResult result = run(body, in_stages({{0, 0.03, {}}}), recorder);
  EXPECT_EQ(result.termination, Termination::collapsed);
  ASSERT_EQ(recorder.rows.size(), 2u);
  EXPECT_EQ(recorder.rows[0].at_constant_load, 0);
  EXPECT_EQ(recorder.rows[1].at_constant_load, 1);
  EXPECT_NEAR(recorder.rows[1].load_factor, 0.015, 1e-15);
  EXPECT_EQ(recorder.rows[1].load_factor, recorder.rows[0].load_factor);
  EXPECT_NEAR(recorder.rows[1].external_work - recorder.rows[0].external_work, 0.015 * 0.02, 1e-15);
  EXPECT_NEAR(recorder.rows[1].dissipated_energy, 0.5 * 0.01 * 0.03, 1e-15);
  EXPECT_LT(result.energy_error, 1e-12);
}

/// Joint under dead loads relieved by the growing ones: the lower end carries 0.014 - lambda, the
/// upper one 0.012 + lambda / 10. At lambda = 0.03 the upper bond breaks; its diagonal would need
/// lambda <= -0.02, the lower bond lambda >= -0.001.
TEST(StagedRun, WithoutAnAdmissibleLoadFactorElementsBreakAtTheLastOne) {
  AnalysisBody body = make_square();
  LoadCase dead = set_of(body), growing = set_of(body);
  for (Index i = 0; i < 4; ++i) {
    if (body.loads.forces[slot(body, i, 0)] == 0.0) continue;
    const bool upper = body.network.particles.position(i)[1] > 0.5;
    dead.loads.forces[slot(body, i, 0)] = upper ? 0.012 : 0.014;
    growing.loads.forces[slot(body, i, 0)] = upper ? 0.1 : -1.0;
  }
  body.sets = {dead, growing};
  Recorder recorder;
  const DamageResult result = run(body, in_stages({{0, 1.0, {}}, {1, {}, {}}}), recorder);
  EXPECT_EQ(result.termination, Termination::collapsed);
  ASSERT_EQ(recorder.rows.size(), 3u);
  EXPECT_EQ(recorder.rows[1].element, bond_between(body.network, {0.0, 1.0}, {1.0, 1.0}));
  EXPECT_NEAR(recorder.rows[1].load_factor, 0.03, 1e-15);
  EXPECT_EQ(recorder.rows[1].at_constant_load, 0);
  EXPECT_EQ(recorder.rows[2].element, bond_between(body.network, {0.0, 0.0}, {1.0, 1.0}));
  EXPECT_EQ(recorder.rows[2].load_factor, recorder.rows[1].load_factor);
  EXPECT_EQ(recorder.rows[2].at_constant_load, 1);
  EXPECT_LT(result.energy_error, 1e-12);
}

TEST(StagedRun, EndsAStageByItsOwnRules) {
  AnalysisBody body = make_chains(2, 5, true, 1.0, infinity);
  const double limits[] = {0.03, 0.01, 0.05, 0.02, 0.04};
  for (int row = 0; row < 5; ++row) {
    body.network.critical_stretch[bonds_of_row(body.network, row)[0]] = limits[row];
  }
  body.sets = {set_of(body)};
  StopRules two, far;
  two.broken_bonds = 2;
  far.displacement = 0.08;
  Recorder recorder;
  const DamageResult result =
      run(body, in_stages({{0, {}, two}, {0, -0.5, {}}, {0, 0.0, {}}, {0, {}, far}}), recorder);
  EXPECT_EQ(result.termination, Termination::completed);
  EXPECT_EQ(result.reason, "the displacement reached 0.08");
  std::vector<double> displacements;
  std::vector<Index> stages;
  for (const StepRecord& row : recorder.rows) {
    displacements.push_back(row.displacement);
    stages.push_back(row.stage);
  }
  // Three rows of two bonds in series resist 1/2 each, also while unloading.
  EXPECT_THAT(displacements, testing::Pointwise(testing::DoubleNear(1e-15),
                                                {0.02, 0.04, 0.06, -0.5, 0.0, 0.06, 0.08}));
  EXPECT_THAT(stages, testing::ElementsAre(1, 1, 1, 2, 3, 4, 4));
  EXPECT_NEAR(recorder.rows[3].load, -0.5 * 3 * 0.5, 1e-15);
  EXPECT_NEAR(recorder.rows[4].external_work, recorder.rows[4].dissipated_energy, 1e-12);
  ASSERT_EQ(result.stages.size(), 4u);
  EXPECT_EQ(result.stages[0].reason, "2 bonds are broken");
  EXPECT_EQ(result.stages[1].last.load_factor, -0.5);
  EXPECT_LT(result.energy_error, 1e-12);
}

}  // namespace
}  // namespace perilink

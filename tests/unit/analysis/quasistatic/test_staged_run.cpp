#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/analysis_bodies.hpp"
#include "support/staged_bodies.hpp"

namespace perilink {
namespace {

using namespace test;
using testing::HasSubstr;

/// Two rows of bonds in series from the held left end to x = 5, all of stiffness 2 and limit 0.01, under their
/// weight to the right (1 per particle at load factor 1), then pulled at the end by P
/// each: the first bonds carry 5 w + P.
TEST(StagedRun, PullsABarUnderItsWeight) {
  AnalysisBody body = make_chains(5, 2, false, 2.0, 0.01);
  LoadSet weight = set_of(body), pull = set_of(body);
  for (Index i = 0; i < body.network.particles.size(); ++i) {
    weight.loads.forces[slot(body, i, 0)] = 1.0;
  }
  weight.reference.value = 12.0;
  body.sets = {weight, pull};
  const double w = 0.001;
  Recorder recorder;
  const DamageResult result = run(body, in_stages({{0, w, {}}, {1, {}, {}}}), recorder);
  EXPECT_EQ(result.ending, Ending::collapsed);
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
  EXPECT_EQ(result.stages[1].ending, Ending::collapsed);
}

}  // namespace
}  // namespace perilink

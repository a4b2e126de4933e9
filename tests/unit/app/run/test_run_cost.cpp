#include "app/run/run_cost.hpp"

#include <gtest/gtest.h>

#include "support/strip_case.hpp"

namespace perilink {
namespace {

/// Times are not tested: a draft has what is counted, and its estimate grows with the factor.
TEST(RunCost, GrowsWithTheFactorAndTheMomentsOfBonds) {
  const Model draft = draft_model(test::strip_case());
  FactorStatistics small, large;
  small.bytes = 1e6, large.bytes = 1e9;
  small.flops = 1e8, large.flops = 1e12;
  const ExpectedCost less = expected_cost(draft.network, small, false);
  const ExpectedCost more = expected_cost(draft.network, large, false);
  EXPECT_GT(more.broken_bond, less.broken_bond);
  EXPECT_GT(more.factorization, less.factorization);
  EXPECT_GE(more.memory, large.bytes);
}

/// Under forces alone events leave out what cannot break.
TEST(RunCost, GrowsWithWhatCanBreakUnderForces) {
  Model draft = draft_model(test::strip_case());
  FactorStatistics factor;
  factor.bytes = 1e9;
  const double all = expected_cost(draft.network, factor, true).broken_bond;
  EXPECT_EQ(all, expected_cost(draft.network, factor, false).broken_bond);
  Network& network = draft.network;
  for (Index e = 0; e < network.num_bonds(); ++e) {
    if (network.bonds.first[e] < network.particles.size() / 2)
      network.critical_stretch[e] = infinity;
  }
  EXPECT_LT(expected_cost(network, factor, true).broken_bond, 0.9 * all);
  EXPECT_EQ(expected_cost(network, factor, false).broken_bond, all);
}

/// Long calibrations are told as expected, short ones are tried.
TEST(RunCost, CountsTheFieldFilesOfARun) {
  OutputSection output;
  EXPECT_EQ(field_files(output, 150), 2);
  output.fields_at = {10, 50, 150, 400};
  EXPECT_EQ(field_files(output, 150), 4) << "the last row has the one at 150";
  output.fields_every = 40;
  EXPECT_EQ(field_files(output, 150), 7);
}

TEST(RunCost, ShortCalibrationsAreTried) {
  Model draft = draft_model(test::strip_case());
  ASSERT_TRUE(draft.network.calibration.has_value());
  draft.network.calibration->seconds = 3.0;
  EXPECT_EQ(time_of_calibration(test::strip_case(), draft), 3.0);
  EXPECT_EQ((ExpectedSetUp{0.5, 3.0}.seconds()), 3.5);
  draft.network.calibration->seconds = 1e-9;
  EXPECT_GT(time_of_calibration(test::strip_case(), draft), 1e-9);
  draft.network.calibration->iterations = 1;  // a model that has been calibrated
  EXPECT_EQ(time_of_calibration(test::strip_case(), draft), 1e-9);
  draft.network.calibration.reset();
  EXPECT_EQ(time_of_calibration(test::strip_case(), draft), 0.0);
}

/// A draft answers what does not depend on the calibration as the model does.
TEST(RunCost, ADraftHasTheSizesOfTheModel) {
  const Model draft = draft_model(test::strip_case());
  const Model model = build_model(test::strip_case());
  EXPECT_EQ(draft.network.bonds.size(), model.network.bonds.size());
  EXPECT_EQ(draft.unknowns.count, model.unknowns.count);
  EXPECT_EQ(draft.network.critical_stretch, model.network.critical_stretch);
  EXPECT_EQ(draft.network.calibration->free_bonds, model.network.calibration->free_bonds);
  EXPECT_EQ(draft.network.calibration->iterations, 0);
  EXPECT_NE(draft.network.stiffness, model.network.stiffness);
}

/// Bonds that share their directions take 28 bytes less each.
TEST(RunCost, CountsTheMemoryOfParticlesAndBonds) {
  Model draft = draft_model(test::strip_case());
  Network& network = draft.network;
  const double single = expected_cost_of_subdomains(network, false).memory;
  EXPECT_GT(single, 800.0 * network.particles.size() + 60.0 * network.num_elements());
  share_directions(network.bonds);
  ASSERT_FALSE(network.bonds.kind.empty());
  EXPECT_NEAR(single - expected_cost_of_subdomains(network, false).memory,
              28.0 * network.num_elements(), 1.0);
}

TEST(RunCost, CalibrationsHaveTheBondsInMemory) {
  const Model draft = draft_model(test::strip_case());
  ASSERT_TRUE(draft.network.calibration.has_value());
  EXPECT_GE(draft.network.calibration->bytes, 100.0 * draft.network.num_elements());
}

}  // namespace
}  // namespace perilink

// Bodies of any slenderness and in any units break completely. The run ends collapsed with the peak
// of beam theory and balanced energies.

#include <gtest/gtest.h>

#include "support/slender_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

class SlenderBody : public testing::TestWithParam<SlenderCase> {};

DamageResult collapse(const SlenderCase& bar, Recorder& recorder) {
  return run(make_slender(bar), {}, recorder);
}

TEST_P(SlenderBody, EndsInTwoAndItsEnergiesBalance) {
  Recorder recorder;
  const DamageResult result = collapse(GetParam(), recorder);
  EXPECT_EQ(result.termination, Termination::collapsed) << result.reason;
  EXPECT_LT(result.energy_error, 1e-6);
  EXPECT_LT(result.largest_residual, 1e-6);
  const bool bare = GetParam().driven() && GetParam().weak_springs == 0.0;
  EXPECT_TRUE(!bare || recorder.rows.back().load == 0.0);
  double largest = 0.0;
  for (const StepRecord& row : recorder.rows) {
    largest = std::max(largest, std::abs(row.displacement));
  }
  // Beam theory: the peak is at 2 L^2 s_c / 3 h; the last hinge does not rotate farther.
  EXPECT_LT(largest, 1.5 * std::abs(result.peaks.highest().displacement));
}

/// The section breaks at one bending moment or force for any length. Shear and the few end columns
/// contribute 3 % at 200 columns.
TEST_P(SlenderBody, PeaksWhereAShortOneDoes) {
  SlenderCase shorter = GetParam();
  shorter.columns = 200;
  shorter.weak_springs = 0.0;
  Recorder first, second;
  const double expected = collapse(shorter, first).peaks.highest().load;
  const double peak = collapse(GetParam(), second).peaks.highest().load;
  const double lever = GetParam().axis() == 1 ? GetParam().lever() / shorter.lever() : 1.0;
  EXPECT_NEAR(peak * lever, expected, 0.03 * expected);
}

INSTANTIATE_TEST_SUITE_P(
    Property, SlenderBody,
    testing::Values(SlenderCase{3000, 2, SlenderLoad::driven_across},
                    SlenderCase{3000, 2, SlenderLoad::force_across},
                    SlenderCase{800, 3, SlenderLoad::driven_across},
                    SlenderCase{800, 3, SlenderLoad::force_across},
                    SlenderCase{600, 2, SlenderLoad::force_across},
                    SlenderCase{600, 3, SlenderLoad::driven_along},
                    SlenderCase{600, 2, SlenderLoad::force_along},
                    SlenderCase{400, 3, SlenderLoad::driven_along, true},
                    SlenderCase{400, 3, SlenderLoad::force_along, true},
                    SlenderCase{400, 3, SlenderLoad::driven_across, false, 1e6, 1e-6},
                    SlenderCase{400, 3, SlenderLoad::force_across, false, 1e-6, 1e6},
                    SlenderCase{250, 3, SlenderLoad::driven_across, false, 1.0, 1.0, 1e-10},
                    SlenderCase{250, 3, SlenderLoad::force_across, false, 1.0, 1.0, 1e-10}),
    [](const auto& test) {
      std::ostringstream name;
      name << test.param << "_" << test.index;
      return name.str();
    });

}  // namespace
}  // namespace perilink

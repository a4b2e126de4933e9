// Loads that exceed a first peak after a part of the body has failed. Summaries distinguish the
// first peak from the residual strength, by events and by stages.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "support/whole_run.hpp"

namespace perilink {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// Returns two strips between common clamps, `weak` and `strong` wide, with strengths 3 and
/// `strength` and the modulus 30 000, in tension. Between the unbreakable bonds of the clamps there
/// is at least one particle.
std::string two_strips(double weak, double strong, double strength, const std::string& more) {
  const double left = weak + 40.0, right = left + strong;
  return fmt::format(R"([body]
spacing = 10
horizon = 31
[[regions]]
name = "weak"
x = [0, {0}]
y = [0, 120]
[[regions]]
name = "strong"
x = [{1}, {2}]
y = [0, 120]
[[regions]]
name = "lower grip"
x = [0, {2}]
y = [0, 20]
[[regions]]
name = "upper grip"
x = [0, {2}]
y = [100, 120]
[[regions]]
name = "lower end"
x = [0, {2}]
y = [0, 0]
[[regions]]
name = "upper end"
x = [0, {2}]
y = [120, 120]
[[materials]]
region = "weak"
youngs_modulus = 30000
fracture_energy = 0.02
tensile_strength = 3
[[materials]]
region = "strong"
youngs_modulus = 30000
fracture_energy = 0.4
tensile_strength = {4}
[[materials]]
regions = ["lower grip", "upper grip"]
youngs_modulus = 30000
fracture_energy = "infinite"
[[supports]]
region = "lower end"
fix = ["x", "y"]
[[displacements]]
region = "upper end"
y = 1
{3})",
                     weak, left, right, more, strength);
}

/// The weak strip breaks at 3 (weak + strong) in one snap, because it softens faster than the
/// strong one takes its load. The strong strip then carries its strength times its width.
TEST(ResidualStrength, IsNotThePeak) {
  for (const auto& [weak, strong, strength] :
       {std::array{80.0, 40.0, 12.0}, std::array{120.0, 60.0, 12.0},
        std::array{120.0, 40.0, 14.0}}) {
    const std::string single_events = "[analysis]\nevent_tolerance = 0\n";
    const test::WholeRun run(
        two_strips(weak, strong, strength, single_events + "[stop]\nload_fraction = 0.1\n"));
    const auto told = [&](const char* key) { return run.summary.json.at(key).get<double>(); };
    const double first = 3.0 * (weak + strong), later = strength * strong;
    EXPECT_NEAR(told("peak_load"), first, 0.05 * first);
    EXPECT_NEAR(told("smoothed_peak_load"), first, 0.05 * first);
    EXPECT_EQ(told("first_peak_load"), told("peak_load"));
    EXPECT_NEAR(told("largest_load"), later, 0.05 * later);
    EXPECT_THAT(run.summary.warnings, Contains(HasSubstr("residual strength")));
    EXPECT_THAT(run.summary.text, HasSubstr("residual strength"));

    const test::WholeRun stages(
        two_strips(weak, strong, strength,
                   single_events + "[[stages]]\nname = \"pull\"\nload_fraction = 0.1\n"));
    const auto& stage = stages.summary.json.at("stages").at(0);
    for (const char* key : {"peak_load", "largest_load", "smoothed_peak_load"}) {
      EXPECT_NEAR(stage.at(key).get<double>(), told(key), 1e-6 * told(key)) << key;
      EXPECT_EQ(stages.summary.json.at(key), stage.at(key)) << key;
    }
    EXPECT_THAT(stages.summary.warnings, Contains(HasSubstr("residual strength")));
  }
}

/// Returns two halves, 36 wide and 2 thick, glued by an interface of the strength 4. A traction
/// pulls at one end, then its displacement in a second stage.
std::string glued_halves(double traction, double tolerance) {
  return fmt::format(R"([body]
thickness = 2
spacing = 4
horizon_ratio = 3
[[regions]]
name = "left"
x = [0, 24]
y = [0, 36]
[[regions]]
name = "right"
x = [24, 48]
y = [0, 36]
[[regions]]
name = "fixed"
x = [0, 0]
y = [0, 36]
[[regions]]
name = "pulled"
x = [48, 48]
y = [0, 36]
[[materials]]
regions = ["left", "right"]
youngs_modulus = 20000
fracture_energy = "infinite"
[[interfaces]]
between = ["left", "right"]
tensile_strength = 4
fracture_energy = 0.2
softening = "linear"
[[supports]]
region = "fixed"
fix = ["x", "y"]
[[supports]]
region = "pulled"
fix = ["y"]
[[tractions]]
region = "pulled"
traction = [{}, 0]
stage = "hold"
[[displacements]]
region = "pulled"
x = 1
stage = "pull"
[[stages]]
name = "hold"
to = 1
[[stages]]
name = "pull"
[analysis]
event_tolerance = {}
)",
                     traction, tolerance);
}

/// The interface carries 4 x 36 x 2 = 288, of which the traction takes a part. Behind separation
/// the moved end holds the traction back, which is no load of the body.
TEST(ResidualStrength, IsNoneWhereAnEarlierLoadIsHeldBack) {
  for (const double traction : {1.5, 2.0, 3.2, 3.6}) {
    for (const double tolerance : {0.0, 0.01, 0.02}) {
      const test::WholeRun run(glued_halves(traction, tolerance));
      const auto told = [&](const char* key) { return run.summary.json.at(key).get<double>(); };
      const double left = 288.0 - traction * 72.0;
      EXPECT_NEAR(told("peak_load"), left, 0.05 * 288.0) << traction << ", " << tolerance;
      EXPECT_EQ(told("first_peak_load"), told("peak_load"));
      EXPECT_EQ(told("largest_load"), told("peak_load"));
      EXPECT_NEAR(told("smoothed_peak_load"), left, 0.08 * 288.0);
      EXPECT_THAT(run.summary.warnings, Not(Contains(HasSubstr("residual strength"))));
    }
  }
}

/// The weaker strip is a fifth of the load below the other, so the load never exceeds its peak.
TEST(ResidualStrength, IsNoneWhereTheLoadStaysBelowItsPeak) {
  const test::WholeRun run(two_strips(160.0, 60.0, 6.0, "[stop]\nload_fraction = 0.1\n"));
  EXPECT_EQ(run.summary.json.at("peak_load"), run.summary.json.at("largest_load"));
  EXPECT_THAT(run.summary.warnings, Not(Contains(HasSubstr("residual strength"))));
}

}  // namespace
}  // namespace perilink

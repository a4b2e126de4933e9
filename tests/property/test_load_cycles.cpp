// Stages that unload a body, reload it or turn its load: they change neither its strength nor the
// rule that ends a test.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/notched_beams.hpp"
#include "support/replaced.hpp"
#include "support/softening_strips.hpp"
#include "support/whole_run.hpp"

namespace perilink {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// Two strips with an elastic limit of about 0.01 and a strength of 3 over their width.
std::vector<test::SofteningStrip> cycled_strips() {
  test::SofteningStrip lattice;
  lattice.width = 30.0;
  lattice.pull = 1.0;
  test::SofteningStrip cloud = lattice;
  cloud.model = "micropolar";
  cloud.pattern = "unstructured";
  cloud.softening = "softening = \"bilinear\"";
  return {lattice, cloud};
}

/// Returns stages with one load case: the ends of the first ones, then the rule of the last.
std::string in_stages(const std::vector<std::string>& ends) {
  std::string text;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    text += fmt::format("[[stages]]\nname = \"{}\"\n{}{}\n", k, k > 0 ? "loads = \"0\"\n" : "",
                        ends[k]);
  }
  return text;
}

/// Run of a strip with stages.
class StagedStrip : public test::WholeRun {
 public:
  StagedStrip(test::SofteningStrip strip, const std::vector<std::string>& ends, bool force = false)
      : test::WholeRun(text_of(std::move(strip), ends, force)) {}
  double told(const char* key) const { return summary.json.at(key).get<double>(); }

 private:
  static std::string text_of(test::SofteningStrip strip, const std::vector<std::string>& ends,
                             bool force) {
    strip.more = in_stages(ends);
    const std::string text = test::softening_case(strip);
    return force ? replaced(text, "[[displacements]]\nregion = \"right\"\nx = 1",
                            "[[loads]]\nregion = \"right\"\nforce = [1, 0]")
                 : text;
  }
};

void expect_no_residual_strength(const StagedStrip& run) {
  EXPECT_EQ(run.told("largest_load"), run.told("peak_load"));
  EXPECT_EQ(run.told("first_peak_load"), run.told("peak_load"));
  EXPECT_THAT(run.summary.warnings, Not(Contains(HasSubstr("residual strength"))));
}

TEST(LoadCycles, LeaveThePeakOfADrivenBody) {
  for (const test::SofteningStrip& strip : cycled_strips()) {
    const double peak = StagedStrip(strip, {"load_fraction = 0.3"}).told("peak_load");
    EXPECT_NEAR(peak, 3.0 * strip.width, 0.3 * strip.width);
    for (const std::vector<std::string>& cycle : {
             std::vector<std::string>{"to = 0.003", "to = 0.0005"},
             {"to = 0.003", "to = -0.0029"},
             {"to = 0.0095", "to = 0.001", "to = 0.0098", "to = 0"},
             {"to_load = 40", "to_load = -60", "to_load = 0"},
         }) {
      std::vector<std::string> ends = cycle;
      ends.emplace_back("load_fraction = 0.3");
      const StagedStrip run(strip, ends);
      EXPECT_NEAR(run.told("peak_load"), peak, 0.01 * peak) << strip.model << ", " << ends[0];
      EXPECT_NEAR(run.told("smoothed_peak_load"), peak, 0.05 * peak);
      expect_no_residual_strength(run);
    }
  }
}

TEST(LoadCycles, LeaveThePeakUnderForces) {
  for (const test::SofteningStrip& strip : cycled_strips()) {
    const double last = 2.6 * strip.width;
    const StagedStrip run(strip, {"to = 30", "to = -28", "to = 40", fmt::format("to = {}", last)},
                          true);
    EXPECT_EQ(run.told("peak_load"), last);
    expect_no_residual_strength(run);
  }
}

/// A beam turned upwards, then unloaded twice on its way down.
TEST(LoadCycles, LeaveThePeakOfANotchedBeam) {
  const auto peak_of = [](const std::vector<std::string>& ends) {
    test::NotchedBeam beam;
    beam.spacing = 5.0;
    beam.stop = in_stages(ends);
    const test::WholeRun run(test::notched_beam_case(beam));
    EXPECT_THAT(run.summary.warnings, Not(Contains(HasSubstr("residual strength"))));
    return run.summary.json.at("peak_load").get<double>();
  };
  const double peak = peak_of({"load_fraction = 0.3"});
  for (const char* end : {"0.01", "-0.09"}) {
    EXPECT_NEAR(
        peak_of({"to = -0.1", "to = 0.08", fmt::format("to = {}", end), "load_fraction = 0.3"}),
        peak, 0.01 * peak)
        << end;
  }
}

/// Compression to four times the strength leaves the strip whole.
TEST(LoadCycles, EndByTheLargestLoadOfTheSameSign) {
  for (const test::SofteningStrip& strip : cycled_strips()) {
    const StagedStrip alone(strip, {"load_fraction = 0.3"});
    const double peak = alone.told("peak_load");
    const StagedStrip run(strip, {fmt::format("to_load = {}", -4.0 * peak), "load_fraction = 0.3"});
    EXPECT_NEAR(run.told("peak_load"), -4.0 * peak, 1e-6 * peak);
    EXPECT_NEAR(run.told("peak_load_other_sign"), peak, 0.01 * peak);
    EXPECT_NEAR(run.told("peak_displacement_other_sign"), alone.told("peak_displacement"),
                0.1 * alone.told("peak_displacement"));
    EXPECT_THAT(run.summary.text, HasSubstr("is the largest load of the other sign"));
    expect_no_residual_strength(run);
    const double last = run.summary.json.at("stages").at(1).at("load").get<double>();
    EXPECT_LT(last, 0.3 * peak);
    EXPECT_FALSE(alone.summary.json.contains("peak_load_other_sign"));
  }
}

/// Load steps that unload the body to a tenth and to nothing, and load it again.
TEST(LoadCycles, OfLoadStepsAreNoFall) {
  for (test::SofteningStrip strip : cycled_strips()) {
    strip.more =
        "control = \"steps\"\nload_factors = [0.004, 0.0004, 0.008, 0, 0.009, 1]\n"
        "[stop]\nload_fraction = 0.5\n";
    const test::WholeRun run(test::softening_case(strip));
    EXPECT_EQ(run.history("load_factor").size(), 6u) << strip.model;
    EXPECT_EQ(run.summary.json.at("peak_displacement"), 0.009) << strip.model;
    EXPECT_THAT(run.summary.warnings, Not(Contains(HasSubstr("residual strength"))));
  }
}

}  // namespace
}  // namespace perilink

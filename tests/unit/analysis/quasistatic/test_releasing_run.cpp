#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/quasistatic/event_run.hpp"
#include "model/from_case/configure.hpp"
#include "support/strip_case.hpp"

namespace perilink {
namespace {

struct Rows final : StepObserver {
  std::vector<StepRecord> rows;
  void on_step(const StepRecord& row, StateSource&) override { rows.push_back(row); }
};

/// The first events of a strip in elements of four spacings.
DamageResult run_strip(const std::string& elements, Rows& rows) {
  std::string text = test::strip_text;
  text.replace(text.find("spacing = 10.0"), 14, "spacing = 2.5");
  text.replace(text.find("horizon = 31.0"), 14, "horizon = 7.6");
  const CaseFile input = parse_case(text + elements, "strip.toml");
  const Model model = build_model(input);
  DamageOptions options = damage_options(input, 1);
  options.stop = {};
  options.stop.broken_bonds = 10;
  return run_damage_analysis(model, options, rows);
}

/// Elements with bonds that can fail are converted before the first of these does, all of them
/// where hardly any strain is enough: then events are those of free particles.
TEST(ReleasingRun, StrainsConvertElementsBeforeTheBondsInThemFail) {
  Rows free, embedded;
  run_strip("", free);
  const DamageResult result =
      run_strip("[elements]\nspacings = 4\norder = 1\nalert_strain = 1e-9\n", embedded);
  EXPECT_GE(result.conversions, 1);
  EXPECT_EQ(result.missed_releases, 0);
  ASSERT_EQ(embedded.rows.size(), free.rows.size());
  for (std::size_t k = 0; k < free.rows.size(); ++k) {
    EXPECT_EQ(embedded.rows[k].element, free.rows[k].element);
    EXPECT_NEAR(embedded.rows[k].load, free.rows[k].load, 0.02 * free.rows[k].load);
  }
}

/// Bonds at their limits trigger release where no strain reaches the threshold.
TEST(ReleasingRun, BondsAtTheirLimitsConvertElementsThatNoStrainHas) {
  Rows free, embedded;
  run_strip("", free);
  run_strip("[elements]\nspacings = 4\norder = 1\nalert_strain = 1e9\n", embedded);
  ASSERT_EQ(embedded.rows.size(), free.rows.size());
  EXPECT_NEAR(embedded.rows.back().load, free.rows.back().load, 0.1 * free.rows.back().load);
}

/// Under pure compression no bond fails and no strain is large: the run ends.
TEST(ReleasingRun, EndsWhereNothingCanFailAndNoElementIsStrained) {
  CaseFile input = parse_case(R"([body]
spacing = 1
horizon_ratio = 3
[[regions]]
name = "bar"
x = [0, 16]
y = [0, 8]
[[regions]]
name = "end"
x = [16, 16]
y = [0, 8]
[[regions]]
name = "start"
x = [0, 0]
y = [0, 8]
[[materials]]
region = "bar"
youngs_modulus = 1000
fracture_energy = 0.01
[[supports]]
region = "body"
fix = ["y"]
[[supports]]
region = "start"
fix = ["x"]
[[displacements]]
region = "end"
x = -0.1
[elements]
spacings = 4
alert_strain = 1e-3
)",
                              "bar.toml");
  const Model model = build_model(input);
  Rows rows;
  const DamageResult result = run_damage_analysis(model, damage_options(input, 1), rows);
  EXPECT_EQ(result.termination, Termination::nothing_breaks);
  EXPECT_EQ(result.conversions, 0);
}

}  // namespace
}  // namespace perilink

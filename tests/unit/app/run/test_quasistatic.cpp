#include "app/run/quasistatic.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "results/calibration_text.hpp"
#include "support/strip_case.hpp"

namespace perilink {
namespace {

DamageResult some_result() {
  DamageResult result;
  result.termination = Termination::collapsed;
  result.reason = "the body \"separated\"";
  result.last.step = 9;
  result.last.yield_events = 2;
  result.last.external_work = 7.5;
  result.last.strain_energy = 3.0;
  result.last.dissipated_energy = 4.5;
  result.broken_bonds = 8;
  result.peak_load = 1.0 / 3.0;
  result.peak_displacement = 0.125;
  for (const CurvePoint row : {CurvePoint{0.0625, 0.25}, {0.09, 0.1}, {0.125, 1.0 / 3.0}}) {
    result.peaks.add(row);
  }
  result.smoothed_peak_load = 0.1875;
  result.initial_stiffness = 64.0;
  result.largest_residual = 1e-14;
  result.energy_error = 2e-13;
  result.factor.factorizations = 2;
  result.factor.bytes = 1024.0;
  return result;
}

Equilibria with_places(const DamageResult& result) {
  Equilibria found(result);
  found.places = {{"upper platen", {0.0, -0.25}}, {"lower platen", {0.0, 0.25}}};
  return found;
}

TEST(Equilibria, TellEveryFigureUnderItsKey) {
  const CaseFile input = test::strip_case();
  const Model model = build_model(input);
  const DamageResult result = some_result();
  Summary summary;
  summary.notes = {"mind the gap"};
  tell_quasistatic(summary, input, model, with_places(result), 0.5);
  const nlohmann::ordered_json& json = summary.json;
  const nlohmann::ordered_json expected = {
      {"peak_load", 0.25},
      {"peak_displacement", 0.0625},
      {"first_peak_load", 0.25},
      {"first_peak_displacement", 0.0625},
      {"largest_load", 1.0 / 3.0},
      {"largest_load_displacement", 0.125},
      {"smoothed_peak_load", 0.1875},
      {"places",
       {{{"name", "upper platen"}, {"force", {0.0, -0.25}}},
        {{"name", "lower platen"}, {"force", {0.0, 0.25}}}}},
      {"initial_stiffness", 64.0},
      {"steps", 9},
      {"broken_bonds", 8},
      {"yield_events", 2},
      {"external_work", 7.5},
      {"strain_energy", 3.0},
      {"dissipated_energy", 4.5},
      {"energy_error", 2e-13},
      {"largest_residual", 1e-14},
      {"warnings", nlohmann::json::array()},
      {"particles", 45},
      {"bonds", model.network.num_elements()},
      {"unknowns", 60},
      {"calibration", calibration_json(model.network.report.calibration.value())},
      {"spacing", 10.0},
      {"horizon", 31.0},
      {"notes", std::vector<std::string>{"mind the gap"}},
      {"factorizations", 2},
      {"factor_bytes", 1024.0}};
  for (const auto& [key, value] : expected.items()) {
    ASSERT_TRUE(json.contains(key)) << key;
    EXPECT_EQ(json[key], value) << key;
  }
  EXPECT_EQ(json.size(), expected.size()) << "a key that no test knows";
}

TEST(Equilibria, AreToldToPeople) {
  const CaseFile input = test::strip_case();
  DamageResult result = some_result();
  result.energy_error = 0.5;
  Summary summary;
  tell_quasistatic(summary, input, build_model(input), with_places(result), 0.5);
  for (const char* part : {"0.333333 at 0.125 is the largest load", "[kip, in]",
                           "8 broken bonds, 2 yield or softening events, 9 rows", "45 particles",
                           "0.1875 is the smoothed peak load", "(0, -0.25) by upper platen"}) {
    EXPECT_THAT(summary.text, testing::HasSubstr(part));
  }
  EXPECT_THAT(summary.warnings, testing::ElementsAre(testing::HasSubstr("up to 0.5 of the work")));
  EXPECT_EQ(summary.outcome, "8 broken bonds, 2 factorisations, largest residual 1.00e-14");
}

TEST(Equilibria, OfAnElasticAnswerAreOneRowWithoutBreaks) {
  CaseFile input = test::strip_case();
  const ElasticAnswer answer = solve_elastic(build_model(input), {});
  EXPECT_EQ(answer.termination, Termination::completed);
  const Equilibria found(answer);
  EXPECT_EQ(found.last.step, 1);
  EXPECT_EQ(found.peaks.highest().load, 12.0);
  EXPECT_EQ(found.broken_bonds, 0);
  EXPECT_EQ(found.largest_residual, answer.solution.residual);
  EXPECT_EQ(found.initial_stiffness, 12.0 / answer.row.displacement);
}

/// The work is that of the loads, not the energy under another name.
TEST(Equilibria, OfAnElasticAnswerTellWhatIsMissing) {
  ElasticAnswer answer;
  answer.row.external_work = 2.0;
  answer.row.strain_energy = 1.5;
  EXPECT_EQ(Equilibria(answer).energy_error, 0.25);
}

TEST(RegionForces, OfLoadsAreTheirForcesAtTheLoadFactor) {
  const Model model = build_model(test::free_strip_case());
  EXPECT_TRUE(has_several_places(model));
  const std::vector<RegionForce> places = region_forces(model, 0.5, {}, {});
  ASSERT_EQ(places.size(), 2u);
  EXPECT_EQ(places[0].force, (std::vector<double>{0.0, 6.0}));
  EXPECT_EQ(places[1].force, (std::vector<double>{0.0, -6.0}));
}

/// Round-off across the pull is shown as zero.
TEST(RegionForces, OfDrivenPlacesHaveNoRoundOffAcrossThePull) {
  const Model model = build_model(parse_case(R"(
regions = [
  {name = "block", x = [0, 10], y = [0, 20]},
  {name = "lower", x = [0, 10], y = [0, 0]},
  {name = "upper", x = [0, 10], y = [20, 20]},
]
[body]
spacing = 1
horizon_ratio = 3
[[materials]]
region = "block"
youngs_modulus = 3
fracture_energy = 1
[[supports]]
region = "lower"
fix = ["x"]
[[displacements]]
region = "lower"
y = -0.7
[[displacements]]
region = "upper"
x = 0
y = 0.3
[analysis]
type = "elastic"
)",
                                             ""));
  const ElasticAnswer answer = solve_elastic(model, {});
  const std::vector<RegionForce> places = region_forces(
      model, 1.0, std::vector<double>(static_cast<std::size_t>(model.network.num_elements()), 1.0),
      answer.solution.displacement);
  ASSERT_EQ(places.size(), 2u);
  EXPECT_EQ(places[0].force[0], 0.0);
  EXPECT_EQ(places[1].force[0], 0.0);
  EXPECT_GT(places[1].force[1], 0.1);
  // The residual of the equilibrium bounds it.
  EXPECT_NEAR(places[0].force[1], -places[1].force[1], 1e-9 * places[1].force[1]);
}

}  // namespace
}  // namespace perilink

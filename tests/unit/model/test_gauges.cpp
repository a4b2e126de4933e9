#include "model/gauges.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "model/from_case/configure.hpp"
#include "support/strip_case.hpp"

namespace perilink {
namespace {

using test::expect_refused;
using test::strip_case;

GaugeSection gauge_of(const std::string& name, std::optional<int> axis) {
  GaugeSection gauge;
  gauge.name = name;
  gauge.axis = axis;
  return gauge;
}

/// Points of the strip, the mean of a region, and stresses.
CaseFile strip_with_gauges() {
  CaseFile input = strip_case();
  input.analysis.type = AnalysisType::elastic;
  GaugeSection between = gauge_of("between", std::nullopt);
  between.between = {{0.0, 20.0, 0.0}, {30.0, 60.0, 0.0}};
  GaugeSection across = gauge_of("across", 0);
  across.between = between.between;
  GaugeSection at = gauge_of("point", 1);
  at.at = {30.0, 60.0, 0.0};
  GaugeSection mean = gauge_of("mean", 1);
  mean.region = "upper end";
  GaugeSection shear = gauge_of("shear", std::nullopt);
  shear.at = {20.0, 40.0, 0.0};
  shear.stress = {0, 1};
  GaugeSection stress = gauge_of("stress", std::nullopt);
  stress.region = "middle";
  stress.stress = {1, 1};
  input.gauges = {between, across, at, mean, shear, stress};
  return input;
}

/// u = 0.003 x + 0.001 y, v = 0.002 x - 0.004 y.
std::vector<double> linear_displacement(const Model& model) {
  std::vector<double> displacement;
  for (Index i = 0; i < model.network.particles.size(); ++i) {
    const std::span<const double> x = model.network.particles.position(i);
    displacement.push_back(0.003 * x[0] + 0.001 * x[1]);
    displacement.push_back(0.002 * x[0] - 0.004 * x[1]);
    if (model.network.width() == 3) displacement.push_back(7.0);
  }
  return displacement;
}

void expect_values_of_linear_displacement(const CaseFile& input) {
  const Model model = build_model(input);
  const std::vector<double> displacement = linear_displacement(model);
  Csr neighbourhoods;
  const std::vector<double> values = gauge_values(model, {{}, displacement, 2.0}, neighbourhoods);
  ASSERT_EQ(values.size(), 6u);
  const double du = 0.003 * 30.0 + 0.001 * 40.0, dv = 0.002 * 30.0 - 0.004 * 40.0;
  EXPECT_NEAR(values[0], 2.0 * (du * 0.6 + dv * 0.8), 1e-14);
  EXPECT_NEAR(values[1], 2.0 * du, 1e-14);
  EXPECT_NEAR(values[2], 2.0 * (0.002 * 30.0 - 0.004 * 60.0), 1e-14);
  // Rows at 60, 70 and 80, the last with half cells; across the width x averages to 20.
  const double mean_y = (60.0 + 70.0 + 0.5 * 80.0) / 2.5;
  EXPECT_NEAR(values[3], 2.0 * (0.002 * 20.0 - 0.004 * mean_y), 1e-14);
  const double e = 3000.0, nu = input.materials[0].poissons_ratio.value_or(1.0 / 3.0);
  EXPECT_NEAR(values[4], 2.0 * e / (2.0 * (1.0 + nu)) * 0.003, 1e-11);
  EXPECT_NEAR(values[5], 2.0 * e / (1.0 - nu * nu) * (-0.004 + nu * 0.003), 1e-11);
}

TEST(Gauges, MeasureLinearDisplacementsExactly) {
  expect_values_of_linear_displacement(strip_with_gauges());
}

/// Between particles, on a line of them, and outside the body, where its nearest place counts.
TEST(Gauges, AreLinearBetweenParticles) {
  for (const BodyMethod method : {BodyMethod::bonds, BodyMethod::linear_elements}) {
    CaseFile input = strip_with_gauges();
    input.body.method = method;
    input.gauges.clear();
    const std::vector<Vector3> points = {
        {13.0, 47.0, 0.0}, {15.0, 45.0, 0.0}, {20.0, 33.0, 0.0}, {41.0, 53.0, 0.0}};
    for (std::size_t k = 0; k < points.size(); ++k) {
      GaugeSection gauge = gauge_of(std::string(1, "abcd"[k]), 1);
      gauge.at = points[k];
      input.gauges.push_back(gauge);
    }
    GaugeSection between = gauge_of("between", std::nullopt);
    between.between = {{3.0, 21.0, 0.0}, {27.0, 53.0, 0.0}};
    input.gauges.push_back(between);
    const Model model = build_model(input);
    Csr neighbourhoods;
    const std::vector<double> values =
        gauge_values(model, {{}, linear_displacement(model), 2.0}, neighbourhoods);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double x = std::min(points[k][0], 40.0), y = std::min(points[k][1], 80.0);
      EXPECT_NEAR(values[k], 2.0 * (0.002 * x - 0.004 * y), 1e-14);
    }
    const double du = 0.003 * 24.0 + 0.001 * 32.0, dv = 0.002 * 24.0 - 0.004 * 32.0;
    EXPECT_NEAR(values[4], 2.0 * (du * 0.6 + dv * 0.8), 1e-14);
    EXPECT_EQ(model.gauges[0].place, "at (13, 47)");
    EXPECT_EQ(model.gauges[3].place, "at (40, 53)");
    EXPECT_EQ(model.gauges[2].terms.size(), 2u) << "on a line between two";
    const auto notes = std::count_if(model.notes.begin(), model.notes.end(), [](const auto& note) {
      return note.find("does not lie between particles: it measures at (") != std::string::npos;
    });
    EXPECT_EQ(notes, 1);
  }
}

/// Flanks of a pre-crack along y = 45 move apart: points next to it follow their own flank.
TEST(Gauges, StayOnTheirSideOfACrack) {
  CaseFile input = strip_with_gauges();
  CrackSection crack;
  crack.points = {{-1.0, 45.0, 0.0}, {22.0, 45.0, 0.0}};
  input.cracks.push_back(crack);
  GaugeSection mouth = gauge_of("mouth", 1);
  mouth.between = {{1.0, 43.0, 0.0}, {1.0, 47.0, 0.0}};
  input.gauges = {mouth};
  const Model model = build_model(input);
  std::vector<double> displacement;
  for (Index i = 0; i < model.network.particles.size(); ++i) {
    const bool above = model.network.particles.position(i)[1] > 45.0;
    displacement.insert(displacement.end(), {0.0, above ? 1.0 : 0.0});
  }
  Csr neighbourhoods;
  EXPECT_NEAR(gauge_values(model, {{}, displacement}, neighbourhoods)[0], 1.0, 1e-14);
}

/// Beside a stiff patch the particles of the soft material around a point are far away.
TEST(Gauges, MeasureStressesNearTheirPoints) {
  const CaseFile input = parse_case(std::string(test::strip_text) + R"([[regions]]
name = "patch"
x = [10, 30]
y = [50, 70]
[[materials]]
region = "patch"
youngs_modulus = 9000
fracture_energy = 0.001
[[gauges]]
name = "below"
at = [24, 44]
stress = "xx"
[analysis]
type = "elastic"
)",
                                    "strip.toml");
  const Model model = build_model(input);
  EXPECT_EQ(model.gauges[0].place, "at (24, 40)");
}

TEST(Gauges, LookPastTheRotationsOfMicropolarParticles) {
  CaseFile input = strip_with_gauges();
  input.body.model = BodyModel::micropolar;
  input.materials[0].poissons_ratio = 0.2;
  expect_values_of_linear_displacement(input);
}

TEST(Gauges, MeasureForcesAndMoments) {
  CaseFile input = strip_case();
  GaugeSection pull = gauge_of("pull", 1);
  pull.reaction = "upper end";
  GaugeSection hold = gauge_of("hold", 1);
  hold.reaction = "lower end";
  GaugeSection moment = gauge_of("moment", std::nullopt);
  moment.reaction = "upper end";
  moment.about = {-30.0, 5.0, 0.0};
  input.gauges = {pull, hold, moment};
  const Model model = build_model(input);
  ModelState state{{}, {}, 1.0, 0.5};
  const std::vector<double> still(model.loads.forces.size(), 0.0);
  state.motion = still;
  Csr neighbourhoods;
  std::vector<double> values = gauge_values(model, state, neighbourhoods);
  EXPECT_NEAR(values[0], 6.0, 1e-12) << "half of the load";
  EXPECT_EQ(values[1], 0.0);
  EXPECT_NEAR(values[2], 6.0 * (20.0 + 30.0), 1e-10) << "spread evenly about x = 20";
  std::vector<double> holding(still.size(), 0.0);
  for (std::size_t slot = 1; slot < 10; slot += 2) holding[slot] = -2.0;  // the lowest row
  values = gauge_values(model, state, neighbourhoods, holding);
  EXPECT_NEAR(values[1], -10.0, 1e-12);
  EXPECT_TRUE(measures_reactions(model.gauges));
  EXPECT_EQ(model.gauges[1].place.substr(0, 8), "reaction");

  // A support across the axis of a load, as of a symmetry plane, beside the moment about a point.
  SupportSection across;
  across.region = "upper end";
  across.fix[0] = true;
  input.supports.push_back(across);
  const Model both = build_model(input);
  EXPECT_EQ(both.gauges[0].place.substr(0, 4), "load");
  EXPECT_EQ(both.gauges[2].place.substr(0, 8), "reaction");
  EXPECT_NE(both.notes.back().find("has supports and loads"), std::string::npos);
  input.supports.pop_back();

  input.gauges[0].reaction = "middle";
  expect_refused(input, "gauges[1].reaction", "whose particles have neither supports nor loads");
}

TEST(Gauges, EndARunAtAValue) {
  CaseFile input = strip_with_gauges();
  StopSection stop;
  const std::vector<double> values = {0.0, 0.0, 0.25, 0.0, 0.0, 0.0};
  EXPECT_EQ(met_rule(input, stop, values), std::nullopt);
  stop.gauge = "point";
  stop.above = 0.3;
  EXPECT_EQ(met_rule(input, stop, values), std::nullopt);
  stop.above = 0.25;
  EXPECT_EQ(met_rule(input, stop, values), "the gauge \"point\" is 0.25, above 0.25");
  stop.above.reset();
  stop.below = 0.5;
  EXPECT_EQ(met_rule(input, stop, values), "the gauge \"point\" is 0.25, below 0.5");
  EXPECT_EQ(met_rule(input, stop, {}), std::nullopt) << "before the first row";
}

TEST(Gauges, KnowTheirPlaces) {
  CaseFile input = strip_with_gauges();
  EXPECT_EQ(build_model(input).gauges[3].name, "mean");
  input.gauges[2].at = {30.0, 91.0, 0.0};
  expect_refused(input, "gauges[3].at", "is 11 from the nearest particle");
  input = strip_with_gauges();
  input.gauges[0].between[1] = {2.0, 21.0, 0.0};
  expect_refused(input, "gauges[1].between", "the same nearest particle");
  input = strip_with_gauges();
  input.gauges[0].name = "load_factor";
  expect_refused(input, "gauges[1].name", "a column of every history");
  input.gauges[0].name = "kinetic_energy";
  build_model(input);  // which only runs over time have
  input.analysis.type = AnalysisType::relaxation;
  expect_refused(input, "gauges[1].name", "a column of every history");
}

/// Collects the gauges of all rows, as the history does.
struct Collector final : StepObserver {
  explicit Collector(const Model& watched) : model(watched) {}
  void on_step(const StepRecord& record, StateSource& source) override {
    rows.push_back(record);
    const StepState state = source.state();
    gauges.push_back(gauge_values(model, {state.secants, state.displacement, record.load_factor},
                                  neighbourhoods));
  }
  const Model& model;
  Csr neighbourhoods;
  std::vector<StepRecord> rows;
  std::vector<std::vector<double>> gauges;
};

/// In a damage analysis the displacement of the history is the work-conjugate one: the mean of the
/// region that a force is shared over.
TEST(Gauges, FollowABodyThatBreaks) {
  CaseFile input = strip_case();
  GaugeSection mean = gauge_of("mean", 1);
  mean.region = "upper end";
  input.gauges = {mean};
  input.stop.broken_bonds = 20;
  const Model model = build_model(input);
  Collector collector(model);
  run_damage_analysis(model, damage_options(input, 1), collector);
  ASSERT_GE(collector.rows.size(), 20u);
  for (std::size_t k = 0; k < collector.rows.size(); ++k) {
    const double expected = collector.rows[k].displacement;
    EXPECT_NEAR(collector.gauges[k][0], expected, 1e-9 * expected);  // the bar of every history
  }
}

/// The mean stress of a whole body is what its loads ask for, whatever bonds are broken: the sum of
/// forces times places (Clausius). Rows of bonds from the support to the loads carry 12 over the
/// strip of 40 by 2; away from the surface, whose particles miss neighbours.
TEST(Gauges, MeasureStressesOfABodyThatBreaks) {
  CaseFile input = strip_case();
  GaugeSection stress = gauge_of("stress", std::nullopt);
  stress.region = "middle";
  stress.stress = {1, 1};
  input.gauges = {stress};
  input.stop.broken_bonds = 60;
  const Model model = build_model(input);
  Collector collector(model);
  run_damage_analysis(model, damage_options(input, 1), collector);
  ASSERT_GE(collector.rows.size(), 20u);
  const double intact = collector.gauges.front()[0] / collector.rows.front().load;
  EXPECT_GT(intact, 0.0);
  const double broken = collector.gauges.back()[0] / collector.rows.back().load;
  EXPECT_TRUE(std::isfinite(broken));
  EXPECT_NE(intact, broken);
}

}  // namespace
}  // namespace perilink

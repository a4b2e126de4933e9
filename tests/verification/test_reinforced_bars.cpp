// Reinforcing bars against closed forms: verification/studies/reinforced_bars in small.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "analysis/quasistatic/elastic_analysis.hpp"
#include "material/model_code_bond.hpp"
#include "network/builder/network_builder.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

constexpr double concrete = 30e3;  // N, mm
constexpr double steel = 200e3;
constexpr double diameter = 16.0;
constexpr double area = 0.25 * std::numbers::pi * diameter * diameter;
constexpr double perimeter = std::numbers::pi * diameter;

struct Strip {
  double length = 400.0, height = 100.0, spacing = 10.0, thickness = 100.0;
  RebarLine bar = {{0.0, 50.0, 0.0}, {400.0, 50.0, 0.0}};
  BarMaterial material = {steel, area};
};

/// A strip of unbreakable concrete with a bar, free.
AnalysisBody make_strip(Strip strip) {
  LatticeInput input;
  input.pattern = Pattern::rectangular;
  input.surface = Surface::calibrated;
  input.spacing = strip.spacing;
  input.horizon = 3.0 * strip.spacing;
  input.thickness = strip.thickness;
  input.solid = {{{0.0, 0.0, 0.0}, {strip.length, strip.height, 0.0}}};
  input.material = {0};
  NetworkInput constants;
  constants.problem = Problem::plane_stress;
  constants.horizon = input.horizon;
  constants.thickness = strip.thickness;
  constants.materials = {SolidMaterial{concrete}};
  strip.bar.embedded = true;
  strip.material.bond.perimeter = perimeter;
  constants.bars = {strip.bar};
  constants.bar_materials = {strip.material};
  return free_body(build_network(make_body(input), constants));
}

double x_of(const AnalysisBody& body, Index i) { return body.network.particles.position(i)[0]; }

bool is_bar(const AnalysisBody& body, Index i) {
  return body.network.particles.kind[i] == ParticleKind::rebar;
}

/// The solid is held, the last node of the bar moves by one.
void pull_out(AnalysisBody& body, double end, bool solid_held = true) {
  const auto last = [&](Index i) {
    return is_bar(body, i) && std::abs(x_of(body, i) - end) < 1e-6;
  };
  for (Index i = 0; i < body.network.particles.size(); ++i) {
    if (last(i)) body.unknowns.prescribed[slot(body, i, 0)] = 1.0;
  }
  number(body, [&](Index i, int axis) {
    if (is_bar(body, i)) return axis == 1 || last(i);
    return solid_held;
  });
  body.reference = {true, 1.0};
}

class Rows final : public StepObserver {
 public:
  void on_step(const StepRecord& row, StateSource&) override { rows.push_back(row); }
  std::vector<StepRecord> rows;
};

double force_of_unit_motion(const AnalysisBody& body) {
  return 2.0 * run_elastic_analysis(body).strain_energy;
}

/// Both ends are displaced as planes: concrete and steel share the strain.
TEST(ReinforcedBars, ACompositeStripIsAsStiffAsItsParts) {
  for (const double y : {50.0, 34.0, 61.7}) {
    Strip strip;
    strip.bar = {{0.0, y, 0.0}, {400.0, y, 0.0}};
    AnalysisBody body = make_strip(strip);
    const auto at = [&](Index i, double x) { return std::abs(x_of(body, i) - x) < 1e-6; };
    for (Index i = 0; i < body.network.first_embedded_point(); ++i) {
      if (at(i, 400.0)) body.unknowns.prescribed[slot(body, i, 0)] = 1.0;
    }
    number(body, [&](Index i, int axis) {
      const bool corner = i == 0;
      return (axis == 0 && (at(i, 0.0) || at(i, 400.0))) || (axis == 1 && corner);
    });
    const double exact = (concrete * 100.0 * 100.0 + steel * area) / 400.0;
    EXPECT_NEAR(force_of_unit_motion(body), exact, 1e-9 * exact) << y;
  }
}

/// In a rigid solid F = E A beta tanh(beta L) u, beta^2 = k p / (E A): order two in the spacing.
TEST(ReinforcedBars, LinearBondHandsTheForceOverAsTheHyperbolicTangent) {
  const double stiffness = 20.0;  // N/mm^3
  const double beta = std::sqrt(stiffness * perimeter / (steel * area));
  std::vector<double> errors;
  for (const double spacing : {20.0, 10.0}) {
    Strip strip;
    strip.spacing = spacing;
    strip.bar = {{100.0, 50.0, 0.0}, {300.0, 50.0, 0.0}};
    strip.material.bond.curve = ForceCurve{{{1.0, stiffness}}};
    strip.material.bond.elastic = true;
    AnalysisBody body = make_strip(strip);
    pull_out(body, 300.0);
    const double exact = steel * area * beta * std::tanh(beta * 200.0);
    errors.push_back(std::abs(force_of_unit_motion(body) / exact - 1.0));
  }
  EXPECT_LT(errors[1], 0.002);
  EXPECT_GT(std::log2(errors[0] / errors[1]), 1.9);
}

/// Returns the stretch of a bar in the middle of a square by opposite forces at its ends.
double extension_of_inclined(double angle, double shift_x, double shift_y, double spacing) {
  Strip strip;
  strip.length = strip.height = 300.0;
  strip.spacing = spacing;
  const double c = 60.0 * std::cos(angle), s = 60.0 * std::sin(angle);
  strip.bar = {{150.0 + shift_x - c, 150.0 + shift_y - s, 0.0},
               {150.0 + shift_x + c, 150.0 + shift_y + s, 0.0}};
  strip.material.bond.curve = ForceCurve{{{1.0, 20.0}}};
  strip.material.bond.elastic = true;
  AnalysisBody body = make_strip(strip);
  number(body, [](Index i, int axis) { return i == 0 || (i == 1 && axis == 1); });
  const Index first = body.network.bonds.first[body.network.first_bar_element];
  const Index last = body.network.bonds.second[body.network.num_elements() - 1];
  for (const auto& [node, sign] : {std::pair(first, -1.0), std::pair(last, 1.0)}) {
    body.loads.forces[slot(body, node, 0)] = sign * std::cos(angle);
    body.loads.forces[slot(body, node, 1)] = sign * std::sin(angle);
  }
  return 2.0 * run_elastic_analysis(body).strain_energy;
}

TEST(ReinforcedBars, TheLatticeIsNotSeenByThem) {
  const double straight = extension_of_inclined(0.0, 0.0, 0.0, 10.0);
  double most = 0.0;
  for (const auto& [degrees, x, y] : std::vector<Vector3>{
           {0, 0, 5}, {0, 3, 2.5}, {10, 0, 0}, {22.5, 4, 1}, {45, 0, 0}, {30, 5, 5}}) {
    const double other = extension_of_inclined(degrees * std::numbers::pi / 180.0, x, y, 10.0);
    most = std::max(most, std::abs(other / straight - 1.0));
  }
  EXPECT_LT(most, 0.01);
  RecordProperty("largest_difference", std::to_string(most));
}

/// A bar of the length that two nodes share, so stiff that it slips as one.
TEST(ReinforcedBars, AShortBarFollowsTheModelCode) {
  const ForceCurve curve = model_code_curve({36.0, 8.0});
  Strip strip;
  strip.bar = {{195.0, 50.0, 0.0}, {205.0, 50.0, 0.0}};
  strip.material.youngs_modulus = 1e4 * steel;
  strip.material.bond.curve = curve;
  AnalysisBody body = make_strip(strip);
  pull_out(body, 205.0);
  DamageOptions options;
  options.stop.displacement = 10.0;
  Rows rows;
  const DamageResult result = run_damage_analysis(body, options, rows);
  const double surface = perimeter * 10.0;
  double work = 0.0, slip = 0.0;
  for (const StepRecord& row : rows.rows) {
    // Both nodes fall from segment to segment: the stress moves about the curve.
    EXPECT_NEAR(row.load / surface, curve.force(row.displacement), 0.055 * 15.0)
        << row.displacement;
    work = row.external_work;
    slip = row.displacement;
  }
  EXPECT_NEAR(result.peak_load / surface, 15.0, 0.05 * 15.0);
  // The path through the events runs along the tops of the segments, half a overshoot above the
  // curve.
  EXPECT_GT(work / surface, curve.area(slip));
  EXPECT_LT(work / surface, 1.025 * curve.area(slip));
  EXPECT_LT(result.energy_error, 1e-9);
}

/// The greatest force of a long bar: bond stress over slip along it by small steps from the free
/// end, N' = p tau(s), s' = N / (E A).
double peak_of_long_bar(const ForceCurve& curve, double length) {
  double peak = 0.0;
  const int steps = 2000;
  for (double free_slip = 1e-4; free_slip < 3.0; free_slip *= 1.05) {
    double slip = free_slip, force = 0.0;
    const double dx = length / steps;
    for (int k = 0; k < steps; ++k) {
      const double middle = slip + 0.5 * dx * force / (steel * area);
      force += dx * perimeter * curve.force(middle);
      slip = middle + 0.5 * dx * force / (steel * area);
    }
    peak = std::max(peak, force);
  }
  return peak;
}

TEST(ReinforcedBars, ALongBarBearsWhatItsBondDoes) {
  const ForceCurve curve = model_code_curve({36.0, 8.0});
  Strip strip;
  strip.bar = {{100.0, 50.0, 0.0}, {300.0, 50.0, 0.0}};
  strip.material.bond.curve = curve;
  AnalysisBody body = make_strip(strip);
  pull_out(body, 300.0);
  DamageOptions options;
  options.stop.displacement = 3.0;
  Rows rows;
  const DamageResult result = run_damage_analysis(body, options, rows);
  const double exact = peak_of_long_bar(curve, 200.0);
  EXPECT_NEAR(result.peak_load, exact, 0.03 * exact);
  EXPECT_LT(result.energy_error, 1e-9);
}

/// A bar with a prestrain in a strip that is free: P = e / (1 / E_s A_s + 1 / E_c A_c).
TEST(ReinforcedBars, APrestrainCompressesTheStrip) {
  Strip strip;
  strip.material.shifts = true;
  AnalysisBody body = make_strip(strip);
  const double prestrain = 1e-3;
  double force = 0.0;
  for (Index e = body.network.first_bar_element; e < body.network.num_elements(); ++e) {
    const Index embedded_point = body.network.bonds.second[e];
    ASSERT_TRUE(body.network.is_embedded_point(embedded_point));
    body.unknowns.prescribed[slot(body, embedded_point, 0)] =
        prestrain * body.network.bonds.lengths[e];
  }
  const auto at_left = [&](Index i) { return x_of(body, i) < 1e-6; };
  number(body, [&](Index i, int axis) { return at_left(i) && (axis == 0 || i == 0); });
  body.reference = {true, prestrain * 400.0};
  const ElasticResult result = run_elastic_analysis(body);
  const Index middle = body.network.first_bar_element + 20;
  double extension = 0.0;
  for (int a = 0; a < 2; ++a) {
    extension += body.network.bonds.direction(middle)[a] *
                 (result.displacement[slot(body, body.network.bonds.second[middle], a)] -
                  result.displacement[slot(body, body.network.bonds.first[middle], a)]);
  }
  force = body.network.stiffness[middle] * extension;
  const double exact = prestrain / (1.0 / (steel * area) + 1.0 / (concrete * 1e4));
  EXPECT_NEAR(force, exact, 0.01 * exact);
}

/// Bars in parallel with the solid, beyond yielding and back to no load: the force of the bar falls
/// elastically, (E_s A_s e_m - N_m) / (E_s A_s + E_c A_c) stays.
TEST(ReinforcedBars, ABarThatHasYieldedUnloadsElastically) {
  for (const double hardening : {0.0, 20e3}) {
    Strip strip;
    strip.thickness = 10.0;  // stiffer concrete would make the bar yield in compression
    const double yield = 400.0 / steel;
    strip.material.yield_strength = 400.0;
    if (hardening > 0.0) {
      const double end = 0.1;
      strip.material.curve = ForceCurve{{{yield, 400.0}, {end, 400.0 + hardening * (end - yield)}}};
    }
    strip.material.shifts = true;
    AnalysisBody body = make_strip(strip);
    const auto at = [&](Index i, double x) { return std::abs(x_of(body, i) - x) < 1e-6; };
    for (Index i = 0; i < body.network.first_embedded_point(); ++i) {
      if (at(i, 400.0)) body.unknowns.prescribed[slot(body, i, 0)] = 1.0;
    }
    number(body, [&](Index i, int axis) {
      return (axis == 0 && (at(i, 0.0) || at(i, 400.0))) || (axis == 1 && i == 0);
    });
    body.reference = {true, 1.0};
    body.sets = {{body.loads, body.unknowns, body.reference}};
    DamageOptions options;
    const double most = 2.5 * yield * 400.0;
    options.stages = {{0, most, {}}, {0, std::nullopt, {}, 0.0}, {0, 1.6 * most, {}}};
    Rows rows;
    const DamageResult result = run_damage_analysis(body, options, rows);
    ASSERT_EQ(result.stages.size(), 3u) << result.reason;
    const double solid = concrete * 1e3, bar = steel * area;
    const double stress = 400.0 + hardening * 1.5 * yield;
    const double left = (bar * 2.5 * yield - stress * area) / (bar + solid);
    EXPECT_NEAR(result.stages[1].last.displacement / 400.0, left,
                0.05 * stress * area / (bar + solid));
    // Reloading goes back to the envelope.
    const double again = solid * 4.0 * yield + (400.0 + hardening * 3.0 * yield) * area;
    EXPECT_NEAR(result.stages[2].last.load, again, 0.03 * stress * area);
    EXPECT_LT(result.energy_error, 1e-8);
    // Once it has unloaded, the plastic work is what is dissipated.
    const double flow =
        0.5 * (400.0 + stress) * 1.5 * yield + 0.5 * (400.0 * yield - stress * stress / steel);
    EXPECT_NEAR(result.stages[1].last.dissipated_energy, flow * area * 400.0,
                0.03 * flow * area * 400.0);
  }
}

}  // namespace
}  // namespace perilink

// Beams as cases: handbook deflections, beams constrained by host elements, and breaking beams.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "analysis/quasistatic/damage_analysis.hpp"
#include "analysis/quasistatic/elastic_analysis.hpp"
#include "io/case/case_file.hpp"
#include "model/from_case/analysis_options.hpp"
#include "model/from_case/configure.hpp"
#include "model/gauges.hpp"

namespace perilink {
namespace {

/// Returns a cantilever of length 12 with E = 2 and a section 3 wide and 0.5 high; stepped beams
/// are 1 high beyond x = 8.
CaseFile cantilever(double spacing, double horizon_ratio, bool stepped, const std::string& more) {
  return parse_case(
      fmt::format("[body]\nproblem = \"beam\"\nthickness = 3\nspacing = {}\nhorizon_ratio = {}\n"
                  "[[regions]]\nname = \"thin\"\nx = [0, {}]\ny = [-0.25, 0.25]\n"
                  "[[regions]]\nname = \"thick\"\nx = [8, 12]\ny = [{}, {}]\n"
                  "[[regions]]\nname = \"left\"\nx = [0, 0]\ny = [-1, 1]\n"
                  "[[regions]]\nname = \"right\"\nx = [12, 12]\ny = [-1, 1]\n"
                  "[[materials]]\nregions = [{}]\nyoungs_modulus = 2\n"
                  "fracture_energy = \"infinite\"\n"
                  "[[supports]]\nregion = \"left\"\nfix = [\"x\", \"y\", \"rotation\"]\n"
                  "[[gauges]]\nname = \"tip\"\nat = [12, 0]\naxis = \"y\"\n"
                  "[[gauges]]\nname = \"middle\"\nat = [6, 0]\naxis = \"y\"\n"
                  "[analysis]\ntype = \"elastic\"\n{}",
                  spacing, horizon_ratio, stepped ? 8 : 12, -0.5, 0.5,
                  stepped ? "\"thin\", \"thick\"" : "\"thin\"", more),
      "beam");
}

std::vector<double> deflections(const CaseFile& input) {
  const Model model = build_model(input);
  const ElasticResult result = run_elastic_analysis(model, {});
  Csr neighbourhoods;
  return gauge_values(model, {{}, result.displacement}, neighbourhoods);
}

constexpr double EI = 2.0 * 3.0 * 0.125 / 12.0;

/// Deflections are P L^3 / 3 E I, and P ((L^3 - l^3) / 3 E I + l^3 / 24 E I) for the stepped beam.
/// Its stiffer part has l = 4 and is eight times as stiff. Both are exact for any horizon: every
/// bond is a beam, and bonds share the section. Tolerance: round-off of a matrix with a condition
/// number of 1e6.
TEST(Beams, LoadedAtTheirEndsAreExactAtTheirParticles) {
  const std::string load = "[[point_loads]]\nat = [12, 0]\nforce = [0, -0.001]\n";
  const double L = std::pow(12.0, 3), l = std::pow(4.0, 3);
  for (const double ratio : {1.0, 2.0, 3.0, 6.0}) {
    const double plain = 0.001 * L / (3 * EI), stepped = 0.001 * ((L - l) / 3 + l / 24) / EI;
    EXPECT_NEAR(-deflections(cantilever(1.0, ratio, false, load))[0], plain, 1e-9 * plain);
    EXPECT_NEAR(-deflections(cantilever(0.8, ratio, true, load))[0], stepped, 1e-9 * stepped);
  }
}

/// The deflection is q L^4 / 384 E I between two clamps. Particles divide the load by the
/// trapezoidal rule. Its order is four, because the slopes of the influence line vanish at both
/// ends.
TEST(Beams, BetweenClampsConvergeWithOrderFour) {
  const std::string more =
      "[[supports]]\nregion = \"right\"\nfix = [\"x\", \"y\", \"rotation\"]\n"
      "[[loads]]\nregion = \"body\"\nbody_force = [0, -0.001]\n";
  const double exact = 0.001 * 1.5 * std::pow(12.0, 4) / (384 * EI);
  std::vector<double> errors;
  for (const double spacing : {2.0, 1.0, 0.5}) {
    errors.push_back(std::abs(-deflections(cantilever(spacing, 3, false, more))[1] / exact - 1.0));
  }
  EXPECT_LT(errors[2], 1e-3);
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 4.0, 0.1);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 4.0, 0.1);
}

/// The deflection of an infinite beam on springs k per length under a point load is w = P b / 2 k,
/// b^4 = k / 4 E I (Hetenyi 1946). By symmetry this beam extends to 12 / b = 6.4 on either side.
TEST(Beams, OnSpringsDeflectAsWinklersBeam) {
  const double beta = std::pow(0.01 / (4 * EI), 0.25), exact = 0.001 * beta / (2 * 0.01);
  const CaseFile input = parse_case(
      "[body]\nproblem = \"beam\"\nthickness = 3\nspacing = 0.1\nhorizon_ratio = 3\n"
      "[[regions]]\nname = \"beam\"\nx = [0, 24]\ny = [-0.25, 0.25]\n"
      "[[materials]]\nregion = \"beam\"\nyoungs_modulus = 2\nfracture_energy = \"infinite\"\n"
      "[[symmetry]]\naxis = \"x\"\nat = 0\n[[springs]]\nregion = \"body\"\ntotal = [0, 0.24]\n"
      "[[point_loads]]\nat = [0, 0]\nforce = [0, -0.0005]\n"
      "[[gauges]]\nname = \"middle\"\nat = [0, 0]\naxis = \"y\"\n[analysis]\ntype = \"elastic\"\n",
      "beam");
  EXPECT_NEAR(-deflections(input)[0], exact, 2e-3 * exact);
}

/// An end moment gives a circle, which quadratic elements represent exactly. An end force gives a
/// cubic parabola, with an error of order two.
TEST(Beams, AreCarriedByLineElements) {
  const auto embedded = [](const std::string& load, int spacings) {
    const std::string elements = fmt::format("[elements]\nspacings = {}\n", spacings);
    return -deflections(cantilever(0.25, 3, false, load + elements))[0];
  };
  const std::string moment = "[[point_loads]]\nat = [12, 0]\nforce = [0, 0]\nmoment = -0.01\n";
  const double circle = 0.01 * 144 / (2 * EI);
  EXPECT_NEAR(embedded(moment, 8), circle, 1e-8 * circle);
  const std::string force = "[[point_loads]]\nat = [12, 0]\nforce = [0, -0.001]\n";
  const double cubic = 0.001 * std::pow(12.0, 3) / (3 * EI);
  const double coarse = std::abs(embedded(force, 12) / cubic - 1.0);
  const double fine = std::abs(embedded(force, 6) / cubic - 1.0);
  EXPECT_LT(coarse, 0.03);
  EXPECT_GT(std::log2(coarse / fine), 1.8);
}

/// Breaks a bar of concrete of length 30, on two supports or in tension; E = 30 000, f_t = 3, G_F =
/// 0.1.
DamageResult broken(const std::string& loads, const std::string& elements) {
  const CaseFile input = parse_case(
      "[body]\nproblem = \"beam\"\nthickness = 20\nspacing = 10\nhorizon_ratio = 3\n"
      "[[regions]]\nname = \"beam\"\nx = [0, 300]\ny = [-15, 15]\n"
      "[[regions]]\nname = \"left\"\nx = [0, 0]\ny = [-15, 15]\n"
      "[[regions]]\nname = \"right\"\nx = [300, 300]\ny = [-15, 15]\n"
      "[[materials]]\nregion = \"beam\"\nyoungs_modulus = 30000\nfracture_energy = 0.1\n"
      "tensile_strength = 3\nsoftening = \"bilinear\"\nsoftening_error = 0.001\n"
      "[[supports]]\nregion = \"left\"\nfix = [\"x\", \"y\"]\n" +
          loads + elements,
      "beam");
  const Model model = build_model(input);
  struct : StepObserver {
    void on_step(const StepRecord&, StateSource&) override {}
  } nobody;
  return run_damage_analysis(model, damage_options(input, 1), nobody);
}

/// The peak is f_t A, raised 1 % by the segments and 2 % by the first of them (measured). The
/// dissipated energy is G_F A; bonds near the crack before it opens and the path between segments
/// add 1.7 %.
TEST(Beams, PulledTakeTheStrengthAndTheFractureEnergy) {
  const DamageResult result = broken(
      "[[supports]]\nregion = \"left\"\nfix = [\"rotation\"]\n"
      "[[displacements]]\nregion = \"right\"\nx = 0.01\n",
      "");
  EXPECT_NEAR(result.peak_load, 3.0 * 600.0, 0.03 * 1800.0);
  EXPECT_NEAR(result.last.dissipated_energy, 0.1 * 600.0, 0.03 * 60.0);
  EXPECT_LT(result.energy_error, 1e-9);
}

/// A bond in S-shaped bending with parallel ends has a stretched face at each end. It breaks at the
/// energy of its shear: s_eq^2 = (h / l)^2 (v / l)^2 = s_c^2.
TEST(Beams, BreakWhereTheyBendToAnS) {
  const CaseFile input = parse_case(
      "[body]\nproblem = \"beam\"\nthickness = 1\nspacing = 10\nhorizon_ratio = 1\n"
      "[[regions]]\nname = \"beam\"\nx = [0, 10]\ny = [-1, 1]\n"
      "[[regions]]\nname = \"left\"\nx = [0, 0]\ny = [-1, 1]\n"
      "[[regions]]\nname = \"right\"\nx = [10, 10]\ny = [-1, 1]\n"
      "[[materials]]\nregion = \"beam\"\nyoungs_modulus = 100\nfracture_energy = 0.05\n"
      "[[supports]]\nregion = \"left\"\nfix = [\"x\", \"y\", \"rotation\"]\n"
      "[[supports]]\nregion = \"right\"\nfix = [\"rotation\"]\n"
      "[[loads]]\nregion = \"right\"\nforce = [0, 1]\n",
      "beam");
  const Model model = build_model(input);
  struct : StepObserver {
    void on_step(const StepRecord&, StateSource&) override {}
  } nobody;
  const DamageResult result = run_damage_analysis(model, damage_options(input, 1), nobody);
  EXPECT_EQ(result.broken_bonds, 1);
  const double critical = std::sqrt(2.0 * 0.05 / (100.0 * 10.0));
  EXPECT_NEAR(result.peak_displacement, critical * 10.0 * 10.0 / 2.0, 1e-9);
}

/// In bending the face stress is sqrt 3 times the strength where a bond of mean length begins to
/// soften. Near the load it is slightly larger. Host elements that are released before do not
/// change the result.
TEST(Beams, BendToSqrtThreeTimesTheStrength) {
  const std::string loads =
      "[[supports]]\nregion = \"right\"\nfix = [\"y\"]\n"
      "[[point_loads]]\nat = [150, 0]\nforce = [0, -100]\n";
  const DamageResult free = broken(loads, "");
  const double moment = free.peak_load * 300.0 / 4.0, section = 20.0 * 900.0 / 6.0;
  EXPECT_GT(moment / section, std::sqrt(3.0) * 3.0);
  EXPECT_LT(moment / section, 1.1 * std::sqrt(3.0) * 3.0);
  const DamageResult embedded = broken(loads, "[elements]\nspacings = 5\n");
  EXPECT_NEAR(embedded.peak_load, free.peak_load, 1e-4 * free.peak_load);
  EXPECT_GT(embedded.conversions, 0);
}

}  // namespace
}  // namespace perilink

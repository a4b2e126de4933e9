#include "model/body/lattice_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "app/run/quasistatic.hpp"
#include "base/error.hpp"
#include "model/from_case/configure.hpp"
#include "model/gauges.hpp"
#include "support/program_cases.hpp"
#include "support/replaced.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;

TEST(LatticeModel, FractureEnergyAndCriticalOpeningSayTheSame) {
  MaterialSection material;
  material.lattice.emplace();
  EXPECT_EQ(softening_of(material).strength, 0.0) << "unbreakable";
  material.lattice->tensile_strength = 2.62e6;
  material.lattice->critical_opening = 2e-4;
  const CrackOpeningLaw printed = softening_of(material);
  EXPECT_NEAR(printed.knee_opening, 2e-5, 1e-19);
  EXPECT_EQ(printed.knee_ratio, 0.25);
  material.lattice->critical_opening.reset();
  material.fracture_energy = fracture_energy(printed);
  EXPECT_NEAR(softening_of(material).critical_opening, 2e-4, 1e-16);
}

/// The strip or the bar of a lattice in an elastic analysis.
std::string elastic(const std::string& text) {
  return text.substr(0, text.find("[analysis]")) + "[analysis]\ntype = \"elastic\"\n";
}

ElasticAnswer elastic_answer(const CaseFile& input) {
  return solve_elastic(build_model(input), {});
}

std::string model_message(const std::string& text) {
  try {
    build_model(parse_case(text, ""));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(LatticeModel, HasTheParticlesOfTheExplicitBody) {
  const CaseFile input = parse_case(elastic(test::lattice_strip_case()), "");
  const Model model = build_model(input);
  std::vector<std::string> notes;
  const ExplicitModel body = build_lattice(input, LatticeShape(input), notes);
  EXPECT_EQ(model.network.particles.size(), body.lattice.particles());
  EXPECT_EQ(model.lattice.spacing, 0.1);
  EXPECT_TRUE(model.network.has_states());
  EXPECT_TRUE(model.notes.empty());
  EXPECT_TRUE(model.reference.driven);
  EXPECT_EQ(model.reference.value, 0.04);
}

/// Regions between or outside the particles are refused.
TEST(LatticeModel, TellsWhatHolesTake) {
  const std::string whole = elastic(test::lattice_strip_case());
  const std::string holed =
      replaced(whole, "region = \"strip\"",
               "region = \"strip\"\nholes = [\"disc\", \"inner\", \"between\", \"inner\"]") +
      "[[regions]]\nname = \"disc\"\ncenter = [1, 0.5]\nradius = 0.3\n"
      "[[regions]]\nname = \"inner\"\ncenter = [1, 0.5196152]\nradius = 0.01\n"
      "[[regions]]\nname = \"between\"\nx = [0.51, 0.54]\ny = [0.1, 0.12]\n";
  const Model model = build_model(parse_case(holed, ""));
  const Index taken =
      build_model(parse_case(whole, "")).network.particles.size() - model.network.particles.size();
  const std::vector<std::string> expected = {
      std::to_string(taken) + " particles were in the hole \"disc\"",
      "1 particle was in the hole \"inner\"", "no particle was in the hole \"between\""};
  EXPECT_EQ(model.notes, expected);
}

TEST(LatticeModel, IsElasticWhateverTheMaterialSays) {
  const std::string strip = elastic(test::lattice_strip_case());
  const std::string breakable = replaced(strip, "fracture_energy = \"infinite\"",
                                         "tensile_strength = 1\nfracture_energy = 1e-5\n"
                                         "external_damping = 0.2");
  // In an explicit run the spacing would be too large for this softening.
  EXPECT_EQ(elastic_answer(parse_case(breakable, "")).row.load,
            elastic_answer(parse_case(strip, "")).row.load);
}

TEST(LatticeModel, TakesTheMeanWhereTheRulesHaveNoEnergy) {
  const std::string printed = replaced(elastic(test::lattice_strip_case()), "spacing = 0.1",
                                       "spacing = 0.1\nvariant = \"2018\"");
  const std::string mean = replaced(printed, "2018", "2017");
  const CaseFile input = parse_case(printed, "");
  ASSERT_EQ(build_model(input).notes.size(), 1U);
  EXPECT_THAT(build_model(input).notes[0], HasSubstr("uses their mean"));
  EXPECT_EQ(elastic_answer(input).row.load, elastic_answer(parse_case(mean, "")).row.load);
}

TEST(LatticeModel, LeavesOutWhatHangsOnABond) {
  // A corner of a turned lattice.
  std::string text = replaced(elastic(test::lattice_strip_case()), "spacing = 0.1",
                              "spacing = 0.1\nrotation = 15\noffset = [0.05, 0.95]");
  bool any = false;
  for (int n = 0; n < 20 && !any; ++n) {
    const std::string turned =
        replaced(text, "rotation = 15", "rotation = " + std::to_string(3 * n + 1));
    const CaseFile input = parse_case(turned, "");
    const Model model = build_model(input);
    if (model.notes.empty()) continue;
    any = true;
    EXPECT_THAT(model.notes[0], HasSubstr("left out"));
    std::vector<std::string> notes;
    EXPECT_LT(model.network.particles.size(),
              build_lattice(input, LatticeShape(input), notes).lattice.particles());
    EXPECT_GT(elastic_answer(input).row.load, 0.0);
  }
  EXPECT_TRUE(any);
}

/// Gauges of a bar without Poisson's effect under its own weight 0.5, and a force along y.
std::vector<double> hanging_bar(double spacing) {
  std::string text = replaced(elastic(test::lattice_strip_case(spacing)), "0.2", "0");
  text = text.substr(0, text.find("[[displacements]]")) +
         "[[loads]]\nregion = \"strip\"\nbody_force = [0.5, 0]\n"
         "[[point_loads]]\nat = [2, 0.5]\nforce = [0, 1e-6]\n"
         "[[gauges]]\nname = \"tip\"\nat = [2, 0.5]\naxis = \"x\"\n"
         "[[gauges]]\nname = \"stress\"\nat = [1, 0.5]\nstress = \"xx\"\n" +
         "[analysis]\ntype = \"elastic\"\n";
  const CaseFile input = parse_case(text, "");
  const Model model = build_model(input);
  EXPECT_FALSE(model.reference.driven);
  EXPECT_NEAR(model.reference.value, 0.5 * 2.0, spacing) << "rough sides";
  const ElasticResult result = run_elastic_analysis(model);
  Csr neighbourhoods;
  return gauge_values(model, {{}, result.displacement}, neighbourhoods);
}

/// Held up to x = 0.1: u = w (L x - x^2 / 2) / E over L = 1.9, sigma = w (2 - x). Sides are too
/// stiff, a part of the body that falls with the spacing.
TEST(LatticeModel, TakesLoadsAndGauges) {
  const std::vector<double> coarse = hanging_bar(0.05), fine = hanging_bar(0.0125);
  const double exact[] = {0.5 * 1.9 * 1.9 / 2.0 / 100.0, 0.5};
  for (int n = 0; n < 2; ++n) {
    EXPECT_NEAR(coarse[n], exact[n], 0.07 * exact[n]);
    EXPECT_NEAR(fine[n], exact[n], 0.02 * exact[n]);
  }
}

TEST(LatticeModel, SolvesBodiesInSpace) {
  const CaseFile input = parse_case(elastic(test::lattice_bar_case()), "");
  const ElasticAnswer result = elastic_answer(input);
  // 1 by 1 of modulus 100 over about 1.6 between its clamps.
  EXPECT_NEAR(result.row.load, 100.0 * 0.02 / 1.6, 0.25 * 1.25);
  EXPECT_LT(result.solution.residual, 1e-12);
}

TEST(LatticeModel, RefusesBodiesThatNothingHolds) {
  const std::string strip = elastic(test::lattice_strip_case());
  EXPECT_THAT(model_message(replaced(strip, "fix = [\"x\", \"y\"]", "fix = [\"x\"]")),
              HasSubstr("1 of the 3 rigid-body modes of the body is free"));
  EXPECT_THAT(model_message(replaced(strip, "x = [1.9, 2]", "x = [1.93, 1.94]")),
              HasSubstr("no particle lies in the region \"right side\""));
}

}  // namespace
}  // namespace perilink

// Bodies in compression until crushed, with crack closure: their runs end with a meaningful result.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/whole_run.hpp"

namespace perilink {
namespace {

using namespace test;

constexpr double block_modulus = 30000.0, height = 50.0;

/// Returns a block of 100 by 50 fixed at its left side.
/// \param material  lines of its material
std::string crushed_block(const std::string& body, const std::string& material,
                          const std::string& loads) {
  return body +
         "pattern = \"rectangular\"\n"
         "[[regions]]\nname = \"block\"\nx = [0, 100]\ny = [0, 50]\n"
         "[[regions]]\nname = \"left\"\nx = [0, 0]\ny = [0, 50]\n"
         "[[regions]]\nname = \"right\"\nx = [100, 100]\ny = [0, 50]\n"
         "[[regions]]\nname = \"corner\"\nx = [0, 0]\ny = [0, 0]\n" +
         fmt::format("[[materials]]\nregion = \"block\"\nyoungs_modulus = {}\n", block_modulus) +
         "fracture_energy = 0.1\ntensile_strength = 3\nsoftening_error = 0.1\n" + material +
         "[[supports]]\nregion = \"left\"\nfix = [\"x\"]\n"
         "[[supports]]\nregion = \"corner\"\nfix = [\"y\"]\n" +
         loads;
}

TEST(CrushedBodies, EndBeforeStrainsAreLarge) {
  const WholeRun run(crushed_block(
      "[body]\nproblem = \"plane_stress\"\nspacing = 10\nhorizon_ratio = 3\n",
      "softening = \"bilinear\"\n", "[[displacements]]\nregion = \"right\"\nx = -0.1\n"));
  const auto& told = run.summary.json;
  EXPECT_EQ(told.at("status"), "nothing_breaks");
  EXPECT_THAT(told.at("reason").get<std::string>(), testing::HasSubstr("shorter than small"));
  EXPECT_LT(std::abs(told.at("peak_load").get<double>()), 0.1 * block_modulus * height);
  EXPECT_LT(std::abs(told.at("peak_displacement").get<double>()), 0.1 * 100.0);
  EXPECT_LT(told.at("energy_error").get<double>(), 1e-9);
  EXPECT_THAT(told.at("warnings").dump(), testing::HasSubstr("is not the strength of the body"));
}

/// Prescribed load steps are carried, and the run warns about the peak.
TEST(CrushedBodies, AskedForByStepsAreInDoubt) {
  const auto warnings = [](const std::string& load_factors) {
    const WholeRun run(
        crushed_block("[body]\nproblem = \"plane_stress\"\nspacing = 10\nhorizon_ratio = 3\n",
                      "softening = \"bilinear\"\n",
                      "[[displacements]]\nregion = \"right\"\nx = -0.1\n"
                      "[analysis]\ncontrol = \"steps\"\nload_factors = " +
                          load_factors + "\n"));
    EXPECT_EQ(run.summary.json.at("status"), "completed");
    return run.summary.json.at("warnings").dump();
  };
  EXPECT_THAT(warnings("[0.1, 0.2]"), testing::Not(testing::HasSubstr("small strains")));
  EXPECT_THAT(warnings("[10, 200]"), testing::HasSubstr("is not the strength of the body"));
}

/// The load of a stage is reached if no element fails before it.
TEST(CrushedBodies, AStageEndsAtItsLoadInDoubt) {
  const std::string held =
      crushed_block("[body]\nproblem = \"plane_stress\"\nspacing = 10\nhorizon_ratio = 3\n",
                    "softening = \"bilinear\"\n", "");
  const WholeRun run(held.substr(0, held.find("[[supports]]")) +
                     "[[displacements]]\nregion = \"surface\"\nx = \"-0.01 * x\"\n"
                     "y = \"-0.01 * y\"\nstage = \"press\"\n"
                     "[[stages]]\nname = \"press\"\nto = 30\n");
  EXPECT_EQ(run.summary.json.at("status"), "completed");
  EXPECT_EQ(run.history().rows.size(), 1u);
  EXPECT_THAT(run.summary.json.at("warnings").dump(), testing::HasSubstr("small strains"));
}

/// A constant load under which bonds break until the body moves far away is not carried. The run
/// does not warn about the peak.
TEST(CrushedBodies, TornByALoadThatStaysHaveCollapsed) {
  const auto told = [](const std::string& sizes) {
    const WholeRun run(
        crushed_block("[body]\nproblem = \"plane_stress\"\n" + sizes, "softening = \"linear\"\n",
                      "[analysis]\nevent_tolerance = 0\n[[loads]]\nregion = \"right\"\n"
                      "force = [1000, 0]\nstage = \"pull\"\n"
                      "[[stages]]\nname = \"pull\"\nto = 1\n"));
    EXPECT_EQ(run.summary.json.at("status"), "collapsed");
    EXPECT_THAT(run.summary.json.at("warnings").dump(),
                testing::Not(testing::HasSubstr("small strains")));
    return run.summary.json.at("reason").get<std::string>();
  };
  EXPECT_THAT(told("spacing = 10\nhorizon_ratio = 2\n"),
              testing::HasSubstr("cannot carry the load factor 0.171683: the body separated"));
  EXPECT_THAT(told("spacing = 5\nhorizon_ratio = 3\n"),
              testing::HasSubstr("until small strains no longer hold"));
}

/// After an event a bond exceeds its limit at a load factor where another bond closes. If the load
/// grows, the other bond opens and loads the first one more. If the load falls, the other bond
/// closes, which also loads the first one. The first bond therefore fails at this load factor.
TEST(CrushedBodies, BondsThatBearNoLoadFactorNearByFailAtTheirOwn) {
  const WholeRun run(crushed_block(
      "[body]\nproblem = \"plane_strain\"\nmodel = \"micropolar\"\nspacing = 10\nhorizon_ratio = "
      "2\n",
      "poissons_ratio = 0.18\nsoftening = \"linear\"\n[[cracks]]\npoints = [[30, 10], [60, 30]]\n",
      "[[loads]]\nregion = \"block\"\nforce = [0, -50]\nstage = \"weight\"\n"
      "[[displacements]]\nregion = \"right\"\nx = -0.05\nstage = \"press\"\n"
      "[[stages]]\nname = \"weight\"\nto = 1\n"
      "[[stages]]\nname = \"press\"\nload_fraction = 0.6\n"));
  EXPECT_LT(run.summary.json.at("energy_error").get<double>(), 1e-9);
  EXPECT_NE(run.summary.json.at("status"), "failed") << run.summary.json.at("reason");
  const CsvTable history = run.history();
  const auto value = [&](std::size_t row, const char* name) {
    return history.rows[row][history.column(name)];
  };
  int avalanches_after_a_change = 0;
  for (std::size_t k = 1; k < history.rows.size(); ++k) {
    const bool same_place = value(k, "load_factor") == value(k - 1, "load_factor");
    if (!same_place || value(k - 1, "side_change") == 0.0) continue;
    EXPECT_EQ(value(k, "side_change"), 0.0) << "row " << k << " changes sides back";
    if (value(k, "avalanche") == 1.0) ++avalanches_after_a_change;
  }
  EXPECT_GT(avalanches_after_a_change, 0);
}

}  // namespace
}  // namespace perilink

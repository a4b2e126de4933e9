#include "model/body/bar_layout.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "base/error.hpp"
#include "io/case/case_file.hpp"

namespace perilink {
namespace {

/// A beam of 10 by 4 by 6 with bars of one entry.
LaidBars laid(const std::string& keys, const std::string& problem = "three_dimensional") {
  const bool space = problem == "three_dimensional";
  Body body;
  body.particles.dim = space ? 3 : 2;
  return lay_bars(
      parse_case("[body]\nproblem = \"" + problem +
                     "\"\nspacing = 1\nhorizon_ratio = 3\n[[regions]]\nname = \"beam\"\n"
                     "x = [0, 10]\ny = [0, 4]\n" +
                     (space ? "z = [0, 6]\n" : "") +
                     "[[materials]]\nregion = \"beam\"\nyoungs_modulus = 30\n"
                     "fracture_energy = 1\n[[loads]]\nregion = \"beam\"\nforce = " +
                     (space ? "[0, 1, 0]" : "[0, 1]") +
                     "\n[[rebar]]\nyoungs_modulus = 200\narea = 0.5\n" + keys,
                 "beam.toml"),
      body);
}

TEST(BarLayout, BarsBesideAFaceAreSpreadFromCoverToCover) {
  const LaidBars bars =
      laid("inside = \"beam\"\nalong = \"x\"\nface = \"-y\"\ncover = 0.5\nnumber = 3\n");
  ASSERT_EQ(bars.lines.size(), 3u);
  EXPECT_EQ(bars.lines[0].from, (Vector3{0.5, 0.5, 0.5}));
  EXPECT_EQ(bars.lines[1].to, (Vector3{9.5, 0.5, 3.0}));
  EXPECT_EQ(bars.lines[2].to, (Vector3{9.5, 0.5, 5.5}));
  EXPECT_TRUE(bars.lines[0].embedded);
}

TEST(BarLayout, StirrupsAreClosedAndNoFartherApartThanWanted) {
  const LaidBars bars = laid("inside = \"beam\"\nalong = \"x\"\nspacing = 4\ncover = 0.5\n");
  ASSERT_EQ(bars.lines.size(), 4u);  // 9 is divided into three
  EXPECT_EQ(bars.lines[1].from[0], 3.5);
  EXPECT_EQ(bars.lines[1].from, bars.lines[1].to);
  EXPECT_EQ(bars.lines[1].bends.size(), 3u);
  EXPECT_EQ(bars.lines[1].bends[1], (Vector3{3.5, 3.5, 5.5}));
  const LaidBars plane =
      laid("inside = \"beam\"\nalong = \"x\"\nspacing = 4\ncover = 0.5\n", "plane_stress");
  ASSERT_EQ(plane.lines.size(), 4u);
  EXPECT_EQ(plane.lines[0].to, (Vector3{0.5, 3.5, 0.0}));
}

TEST(BarLayout, CopiesMakeMeshesAndLayers) {
  const LaidBars bars =
      laid("from = [1, 1, 1]\nto = [9, 1, 1]\ncopies = [3, 2]\nsteps = [[0, 0, 2], [0, 1, 0]]\n");
  ASSERT_EQ(bars.lines.size(), 6u);
  EXPECT_EQ(bars.lines[2].from, (Vector3{1, 1, 5}));
  EXPECT_EQ(bars.lines[5].from, (Vector3{1, 2, 5}));
  EXPECT_EQ(bars.sections[5], 0u);
}

TEST(BarLayout, CurvesOfAMeshAreBars) {
  Body body;
  body.groups = {{"plate", {}, {}, {}, {}, {}},
                 {"bars",
                  {},
                  {},
                  {1, 0, 0, 2, 0, 0, 2, 3, 0, 0, 1, 0, 5, 1, 0},
                  {0, 1, 1, 2, 3, 4},
                  Vector3{1, 0}}};
  const auto lay = [&](const std::string& name) {
    return lay_bars(parse_case("[body]\nmesh = \"a.msh\"\nhorizon_ratio = 3\n[[regions]]\n"
                               "name = \"all\"\ngroup = \"plate\"\n[[materials]]\n"
                               "region = \"all\"\nyoungs_modulus = 30\nfracture_energy = 1\n"
                               "[[loads]]\nregion = \"all\"\nforce = [0, 1]\n[[rebar]]\n"
                               "youngs_modulus = 200\narea = 0.5\ngroup = \"" +
                                   name + "\"\ncopies = [2]\nsteps = [[0, 4]]\n",
                               "beam.toml"),
                    body);
  };
  const LaidBars bars = lay("bars");
  ASSERT_EQ(bars.lines.size(), 4u);
  EXPECT_EQ(bars.lines[0].to, (Vector3{2, 3}));
  EXPECT_EQ(bars.lines[0].bends, (std::vector<Vector3>{{2, 0}}));
  EXPECT_EQ(bars.lines[3].from, (Vector3{0, 5}));
  for (const auto& [name, advice] :
       {std::pair("bar", "did you mean `bars`?"), std::pair("plate", "bars")}) {
    try {
      lay(name);
      FAIL() << name;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(),
                  testing::HasSubstr("no Physical Curve of this name lies in the body"));
      EXPECT_THAT(error.what(), testing::HasSubstr(advice));
    }
  }
  const auto refusal = [&](std::vector<Index> lines) -> std::string {
    body.groups[1].lines = std::move(lines);
    try {
      lay("bars");
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(refusal({0, 1, 1, 0}), testing::HasSubstr("has a line twice"));
  EXPECT_THAT(refusal({1, 1}), testing::HasSubstr("whose lines have no length"));
}

TEST(BarLayout, TheirSteelAndBondAreThoseOfTheEntry) {
  const std::string at = "from = [1, 1, 1]\nto = [9, 1, 1]\n";
  EXPECT_FALSE(laid(at).materials[0].bond.curve);
  const BarMaterial linear =
      laid(at +
           "bond = \"linear\"\nbond_stiffness = 50\nbond_strength = 8\nyield_strength = 2\n"
           "hardening_modulus = 10\nrupture_strain = 0.1\nperimeter = 3\n")
          .materials[0];
  ASSERT_TRUE(linear.bond.curve);
  EXPECT_EQ(linear.bond.curve->force(0.08), 4.0);
  EXPECT_EQ(linear.bond.curve->force(1.0), 8.0);
  EXPECT_EQ(linear.bond.perimeter, 3.0);
  ASSERT_TRUE(linear.curve);
  EXPECT_NEAR(linear.curve->force(0.1), 2.0 + 10.0 * 0.09, 1e-13);
  EXPECT_FALSE(linear.curve->endless);
  EXPECT_FALSE(linear.shifts);
  EXPECT_TRUE(laid(at + "prestrain = 0.001\n").materials[0].shifts);
}

}  // namespace
}  // namespace perilink

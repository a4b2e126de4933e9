#include "model/from_case/field_file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/files.hpp"
#include "model/from_case/configure.hpp"
#include "support/case_texts.hpp"
#include "support/replaced.hpp"
#include "support/strip_case.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

using testing::Contains;
using testing::HasSubstr;
using namespace test;

/// The strip has particles at 0 to 40 by 0 to 80, every 10.
class FieldFile : public testing::Test {
 protected:
  CaseFile with(const std::string& keys, const std::string& type = "elastic") const {
    return parse_case(
        strip_text + ("[[graded]]\n" + keys + "\n[analysis]\ntype = \"" + type + "\"\n"),
        path("strip.toml"));
  }
  CaseFile of_file(const std::string& property, const std::string& type = "elastic") const {
    return with("property = \"" + property + "\"\nfile = \"field.csv\"", type);
  }
  std::string path(const char* name) const { return (folder_.path() / name).string(); }
  void write(const std::string& points) const {
    write_whole_file(path("field.csv"), "x,y,factor\n" + points);
  }
  /// Returns the refusal of a case.
  static std::string refusal(const CaseFile& input) {
    try {
      build_model(input);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  const TemporaryDirectory folder_;
};

/// A linear function has equal values on any grid.
TEST_F(FieldFile, OfALinearFunctionEqualsItsFormula) {
  std::string points;
  for (const double y : {0.0, 25.0, 80.0}) {
    for (const double x : {40.0, 7.0, 0.0}) {
      points += fmt::format("{},{},{}\n", x, y, 1.0 + x / 40.0 + y / 20.0);
    }
  }
  write(points);
  const Model file = build_model(of_file("youngs_modulus"));
  const Model formula =
      build_model(with("property = \"youngs_modulus\"\nfactor = \"1 + x / 40 + y / 20\""));
  ASSERT_EQ(file.network.stiffness.size(), formula.network.stiffness.size());
  for (std::size_t b = 0; b < file.network.stiffness.size(); ++b) {
    EXPECT_NEAR(file.network.stiffness[b] / formula.network.stiffness[b], 1.0, 1e-12);
  }
  for (std::size_t i = 0; i < file.modulus.size(); ++i) {
    EXPECT_NEAR(file.modulus[i], formula.modulus[i], 1e-13);
  }
  EXPECT_THAT(file.notes, Contains("graded youngs_modulus: field.csv is a grid of 3 x 3 points "
                                   "with values 1 to 6"));
}

/// The nearest point is the left or the right one: a step.
TEST_F(FieldFile, OfScatteredPointsTakesTheNearest) {
  write("0,0,1\n0,80,1\n0.5,33,1\n40,2,2\n40,79,2\n39.5,33,2\n");
  const Model file = build_model(of_file("fracture_energy", "damage"));
  const Model step =
      build_model(with("property = \"fracture_energy\"\nfactor = \"x < 20 ? 1 : 2\"", "damage"));
  ASSERT_EQ(file.network.critical_stretch.size(), step.network.critical_stretch.size());
  const Particles& particles = file.network.particles;
  for (Index b = 0; b < file.network.num_bonds(); ++b) {
    const double sum = particles.position(file.network.bonds.first[b])[0] +
                       particles.position(file.network.bonds.second[b])[0];
    if (sum == 40.0) continue;  // both are as near, but for the points off the lines
    EXPECT_EQ(file.network.critical_stretch[b], step.network.critical_stretch[b]);
  }
  EXPECT_THAT(file.notes, Contains("graded fracture_energy: field.csv has 6 scattered points with "
                                   "values 1 to 2; every place takes the value of the nearest"));
}

/// Half a step beyond a grid belongs to its outermost points, as to pixels.
TEST_F(FieldFile, NotesHowFarParticlesLieOutside) {
  write("5,10,1\n35,10,2\n5,60,3\n35,60,4\n");
  EXPECT_THAT(build_model(of_file("youngs_modulus")).notes, Contains(HasSubstr("values 1 to 4")));
  write("30,10,1\n35,10,2\n30,60,3\n35,60,4\n");
  EXPECT_THAT(build_model(of_file("youngs_modulus")).notes,
              Contains("graded youngs_modulus: field.csv is a grid of 2 x 2 points with values 1 "
                       "to 4; particles lie up to 30 at -x, 5 at +x outside of them, where the "
                       "nearest value holds"));
  write("0,0,1\n40,0,2\n20,40,5\n0,80,3\n20,80,4\n");
  EXPECT_THAT(build_model(of_file("youngs_modulus")).notes,
              Contains(HasSubstr("has 5 scattered points (4 short of a grid of 3 x 3)")));
}

TEST_F(FieldFile, RefusesPointsFarFromTheBody) {
  write("0,0,1\n1,0,2\n0,1000,1\n1,1000,3\n");
  EXPECT_THAT(build_model(of_file("youngs_modulus")).notes, Contains(HasSubstr("39 at +x")));
  write("100,0,1\n200,0,2\n100,80,1\n200,80,3\n");
  EXPECT_THAT(refusal(of_file("youngs_modulus")),
              HasSubstr("strip.toml:44: graded[1].file: names field.csv, whose points have x = 100 "
                        "to 200, y = 0 to 80; no particle of the body lies there, but at x = 0 to "
                        "40, y = 0 to 80"));
}

TEST_F(FieldFile, IsRefusedWithTheLineAtFault) {
  EXPECT_THAT(refusal(of_file("youngs_modulus")), HasSubstr("strip.toml:44: graded[1].file: "));
  EXPECT_EQ(refusal(of_file("fracture_energy")), "accepted") << "elastic bodies need no energy";
  write("0,0,1\n1,0,-2\n");
  EXPECT_THAT(refusal(of_file("youngs_modulus")), HasSubstr("field.csv:3: factor: is '-2'"));
  write("0,0,1\n40,0,2\n40,0,2\n0,80,4\n0,0,5\n");
  EXPECT_THAT(refusal(of_file("youngs_modulus")),
              HasSubstr("field.csv:6: factor: has another value than line 2 at the same place"));
}

/// The file of a strength that does not fit the fracture energy is named.
TEST_F(FieldFile, IsNamedWhereItsStrengthDoesNotFit) {
  write("0,0,1\n40,0,1\n0,80,81\n40,80,81\n");
  const std::string text =
      replaced(std::string(strip_text), "fracture_energy = 0.001",
               "fracture_energy = 0.001\ntensile_strength = 0.1\nsoftening = \"linear\"");
  const CaseFile input =
      parse_case(text + "[[graded]]\nproperty = \"tensile_strength\"\nfile = \"field.csv\"\n",
                 path("strip.toml"));
  EXPECT_THAT(refusal(input), HasSubstr("graded[1].file: is "));
}

TEST_F(FieldFile, OfSpaceHasThreeCoordinates) {
  std::string points;
  for (int corner = 0; corner < 8; ++corner) {
    const int x = 40 * (corner % 2), y = 80 * (corner / 2 % 2), z = 20 * (corner / 4);
    points += fmt::format("{},{},{},{}\n", x, y, z, 1.0 + x / 40.0 + y / 80.0 + z / 10.0);
  }
  write_whole_file(path("field.csv"), "x,y,z,factor\n" + points);
  std::string text =
      replaced(std::string(strip_text), "problem = \"plane_stress\"\nthickness = 2.0",
               "problem = \"three_dimensional\"");
  for (const char* line : {"y = [0, 80]\n", "y = [0, 20]\n", "y = [60, 80]\n"}) {
    text = replaced(text, line, std::string(line) + "z = [0, 20]\n");
  }
  text = replaced(text, "fix = [\"x\", \"y\"]", "fix = [\"x\", \"y\", \"z\"]");
  text = replaced(text, "force = [0, 12]", "force = [0, 12, 0]");
  text = text.erase(text.find("[[regions]]\nname = \"middle\""),
                    text.find("[[materials]]") - text.find("[[regions]]\nname = \"middle\""));
  text = replaced(text, "horizon = 31.0", "horizon = 21.0\nsurface = \"none\"");
  const auto model_with = [&](const char* key) {
    return build_model(parse_case(text + "[[graded]]\nproperty = \"youngs_modulus\"\n" + key +
                                      "\n[analysis]\ntype = \"elastic\"\n",
                                  path("block.toml")));
  };
  const Model file = model_with("file = \"field.csv\"");
  const Model formula = model_with("factor = \"1 + x / 40 + y / 80 + z / 10\"");
  for (std::size_t b = 0; b < file.network.stiffness.size(); ++b) {
    EXPECT_NEAR(file.network.stiffness[b] / formula.network.stiffness[b], 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace perilink

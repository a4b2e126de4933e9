#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "io/case/sections/case_sections.hpp"
#include "material/elasticity.hpp"
#include "support/case_texts.hpp"

// The refusals themselves are data: tests/cli/malformed. Here stand the edges of what is allowed.

namespace perilink {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string with_size(const std::string& lines) {
  return message_of(replaced(small_case, "columns = 11\nhorizon_ratio = 3", lines));
}

TEST(CaseBody, AllowsTheEdgesOfSizes) {
  EXPECT_EQ(with_size("columns = 2\nhorizon_ratio = 1"), "accepted");
  EXPECT_EQ(with_size("columns = 100000\nhorizon_ratio = 1"), "accepted");
  EXPECT_THAT(with_size("columns = 100001\nhorizon_ratio = 1"), HasSubstr("from 2 to 100000"));
  EXPECT_EQ(with_size("spacing = 0.5\nhorizon = 0.5"), "accepted");
  EXPECT_THAT(with_size("spacing = 0.5\nhorizon = 0.49999"), HasSubstr("less than the spacing"));
  EXPECT_EQ(with_size("columns = 2\nhorizon_level = 0"), "accepted") << "the body refuses it later";
  EXPECT_EQ(with_size("columns = 2\nhorizon_level = 8"), "accepted");
}

TEST(CaseBody, TakesAMeshInPlaceOfALattice) {
  const CaseFile input = parse_case(mesh_case, "case.toml");
  EXPECT_EQ(input.body.mesh, "meshes/plate \"a\".msh");
  EXPECT_EQ(input.body.pattern, Pattern::irregular);
  EXPECT_EQ(input.body.micromodulus, Constants::continuum);
  EXPECT_EQ(input.body.critical_stretch, CriticalStretch::dissipated);
  EXPECT_EQ(input.regions[0].group, "plate");
  EXPECT_EQ(input.regions[1].group, "");
  const std::string long_path = "mesh = \"" + std::string(3000, 'p') + "\"\nhorizon_ratio = 3";
  EXPECT_EQ(with_size(long_path), "accepted");
}

TEST(CaseBody, PlacesUnstructuredParticlesWithoutAMesh) {
  const std::string text = replaced(small_case, "columns", "pattern = \"unstructured\"\ncolumns");
  const CaseFile input = parse_case(text, "case.toml");
  EXPECT_EQ(input.body.pattern, Pattern::irregular);
  EXPECT_FALSE(input.body.mesh.has_value());
  EXPECT_EQ(input.body.seed, 1);
  EXPECT_EQ(input.body.micromodulus, Constants::continuum);
  const std::string seeded = replaced(text, "columns", "seed = 2147483647\ncolumns");
  const CaseFile again = parse_case(write_case(parse_case(seeded, "case.toml")), "written.toml");
  EXPECT_EQ(again.body.seed, 2147483647);
  EXPECT_EQ(again.body.pattern, Pattern::irregular);
  EXPECT_THAT(message_of(replaced(text, "columns", "seed = 2147483648\ncolumns")),
              HasSubstr("body.seed"));
  const std::string round = replaced(text, "x = [0, 1]\ny = [0, 2]", "center = [0, 0]\nradius = 1");
  EXPECT_EQ(message_of(round), "accepted");
  EXPECT_THAT(message_of(replaced(round, "pattern = \"unstructured\"\n", "")),
              HasSubstr("pattern = \"unstructured\""));
}

TEST(CaseBody, AcceptsThePoissonsRatioOfItsBonds) {
  for (const auto& [problem, word] : {std::pair(Problem::plane_stress, "plane_stress"),
                                      std::pair(Problem::plane_strain, "plane_strain")}) {
    const double ratio = bond_poissons_ratio(problem);
    const auto text = [&, name = word](double given) {
      return replaced(
          replaced(small_case, "columns", std::string("problem = \"") + name + "\"\ncolumns"),
          "fracture_energy", "poissons_ratio = " + std::to_string(given) + "\nfracture_energy");
    };
    EXPECT_EQ(message_of(text(ratio)), "accepted");
    EXPECT_EQ(message_of(text(ratio - 0.9e-3)), "accepted");
    EXPECT_THAT(message_of(text(ratio + 1.1e-3)), HasSubstr("bond-based"));
    EXPECT_THAT(message_of(text(ratio - 1.1e-3)), HasSubstr("micropolar"));
  }
  const double ratio = bond_poissons_ratio(Problem::three_dimensional);
  EXPECT_EQ(parse_case(full_case, "").materials[0].poissons_ratio, ratio);
}

TEST(CaseBody, AcceptsThePoissonsRatiosOfMicropolarBonds) {
  for (const auto& [problem, word] : {std::pair(Problem::plane_stress, "plane_stress"),
                                      std::pair(Problem::plane_strain, "plane_strain")}) {
    const auto text = [&, name = word](double given) {
      return replaced(
          replaced(small_case, "columns",
                   std::string("model = \"micropolar\"\nproblem = \"") + name + "\"\ncolumns"),
          "fracture_energy", fmt::format("poissons_ratio = {}\nfracture_energy", given));
    };
    const double largest = bond_poissons_ratio(problem);
    for (const double ratio : {-0.999, 0.0, 0.2, largest}) {
      EXPECT_EQ(message_of(text(ratio)), "accepted") << ratio;
    }
    for (const double ratio : {-1.0, largest + 1e-6, 0.4}) {
      EXPECT_THAT(message_of(text(ratio)), HasSubstr("have ratios above -1 and up to")) << ratio;
    }
  }
}

TEST(CaseBody, LinearElementsNeedNoHorizonAndHaveAnyRatio) {
  const std::string elements =
      replaced(std::string(small_case) + "[analysis]\ntype = \"elastic\"\n", "horizon_ratio = 3",
               "method = \"linear_elements\"");
  EXPECT_EQ(parse_case(elements, "").body.method, BodyMethod::linear_elements);
  EXPECT_EQ(parse_case(small_case, "").body.method, BodyMethod::bonds);
  for (const char* ratio : {"-0.999", "0", "0.4999"}) {
    const std::string text = replaced(
        elements, "youngs_modulus", "poissons_ratio = " + std::string(ratio) + "\nyoungs_modulus");
    EXPECT_EQ(message_of(text), "accepted") << ratio;
  }
}

/// Where it is left out nothing breaks, whatever else the material says about softening.
TEST(CaseBody, ElasticAnalysesNeedNoFractureEnergy) {
  const std::string elastic = std::string(small_case) + "[analysis]\ntype = \"elastic\"\n";
  for (const char* lines : {"", "tensile_strength = 1\n",
                            "softening = \"linear\"\n"
                            "tensile_strength = 1\n"}) {
    const CaseFile input = parse_case(replaced(elastic, "fracture_energy = 0.1\n", lines), "");
    EXPECT_EQ(input.materials[0].fracture_energy, INFINITY);
    const std::string written = write_case(input);
    EXPECT_THAT(written, Not(HasSubstr("fracture_energy")));
    EXPECT_EQ(write_case(parse_case(written, "")), written);
  }
  EXPECT_EQ(parse_case(elastic, "").materials[0].fracture_energy, 0.1);
  const std::string damage = replaced(small_case, "fracture_energy = 0.1\n", "");
  for (const char* type : {"damage", "explicit", "relaxation"}) {
    EXPECT_THAT(message_of(damage + "[analysis]\ntype = \"" + type + "\"\n"),
                HasSubstr("materials[1].fracture_energy: is missing"))
        << type;
  }
  EXPECT_THAT(
      message_of(replaced(elastic, "= 0.1\n", "= \"infinite\"\ntensile_strength = 1\n")),
      HasSubstr("materials[1].tensile_strength: is given, but the material is unbreakable"));
}

/// One that can break beside others keeps its word in the written case.
TEST(CaseBody, ElasticCasesSayWhatIsUnbreakableBesideOthers) {
  const CaseFile input = parse_case(std::string(small_case) +
                                        "[[regions]]\nname = \"patch\"\nx = [0, 1]\ny = [0, 1]\n"
                                        "[[materials]]\nregion = \"patch\"\nyoungs_modulus = 2\n"
                                        "[analysis]\ntype = \"elastic\"\n",
                                    "");
  EXPECT_EQ(input.materials[1].fracture_energy, INFINITY);
  EXPECT_THAT(write_case(input), HasSubstr("fracture_energy = \"infinite\""));
}

}  // namespace
}  // namespace perilink

#include "io/case/sections/laws/case_softening.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "support/case_texts.hpp"

// The refusals are data: tests/cli/malformed/text/softening.txt.

namespace perilink {
namespace {

const std::string energy = "fracture_energy = 0.1";

/// The small case with lines of its material, after or in place of the fracture energy.
CaseFile with(const std::string& lines, bool keeps_energy = true) {
  return parse_case(replaced(small_case, energy, (keeps_energy ? energy + "\n" : "") + lines), "");
}

SofteningMaterial material_of(const std::string& lines, bool keeps_energy = true) {
  return with(lines, keeps_energy).materials.front().softening;
}

TEST(CaseSoftening, IsBrittleWhereNothingIsSaid) {
  for (const char* lines : {"", "softening = \"brittle\""}) {
    const SofteningMaterial material = material_of(lines);
    EXPECT_EQ(material.shape.kind, Softening::brittle);
    EXPECT_FALSE(has_stretches(material));
    EXPECT_TRUE(std::isinf(material.tensile_strength));
  }
}

TEST(CaseSoftening, IsBilinearWithAStrengthAlone) {
  const CaseFile input = with("tensile_strength = 3");
  const SofteningMaterial& material = input.materials.front().softening;
  EXPECT_EQ(material.shape.kind, Softening::bilinear);
  EXPECT_EQ(material.tensile_strength, 3.0);
  EXPECT_EQ(material.shape.knee_force, 1.0 / 3.0) << "Petersson 1981";
  EXPECT_EQ(material.shape.knee_stretch, 2.0 / 9.0) << "Petersson 1981";
  EXPECT_EQ(material.error, 0.01);
  EXPECT_EQ(input.materials.front().fracture_energy, 0.1);
}

TEST(CaseSoftening, ReadsEveryCurve) {
  const std::pair<const char*, Softening> words[] = {{"linear", Softening::linear},
                                                     {"bilinear", Softening::bilinear},
                                                     {"exponential", Softening::exponential}};
  for (const auto& [word, kind] : words) {
    const std::string lines =
        "softening = \"" + std::string(word) + "\"\ntensile_strength = 2.5\nsoftening_error = 0.3";
    const SofteningMaterial material = material_of(lines);
    EXPECT_EQ(material.shape.kind, kind);
    EXPECT_EQ(material.tensile_strength, 2.5);
    EXPECT_EQ(material.error, 0.3);
  }
}

TEST(CaseSoftening, ReadsKnees) {
  const SofteningMaterial material =
      material_of("tensile_strength = 3\nknee_stress_ratio = 0.25\nknee_opening_ratio = 0.15");
  EXPECT_EQ(material.shape.knee_force, 0.25);
  EXPECT_EQ(material.shape.knee_stretch, 0.15);
}

TEST(CaseSoftening, ReadsPointsInAnyUnits) {
  const SofteningMaterial material = material_of(
      "softening = \"points\"\ntensile_strength = 3\n"
      "softening_points = [[0, 4], [0.02, 2], [0.05, 0.5], [0.2, 0]]");
  EXPECT_EQ(material.shape.kind, Softening::points);
  const std::vector<std::array<double, 2>> expected = {{0.02 / 0.2, 0.5}, {0.05 / 0.2, 0.125}};
  EXPECT_EQ(material.shape.points, expected) << "openings over the last, stresses over the first";
  EXPECT_EQ(material.tensile_strength, 3.0);
}

TEST(CaseSoftening, ReadsTheLimitsOfConcrete) {
  const std::string text =
      "poissons_ratio = 0.2\nsoftening = \"concrete\"\ntension_limit = 1e-4\ntension_factor = 2\n"
      "compression_limit = 1e-3\ncompression_factor = 3";
  for (const bool shear : {false, true}) {
    const std::string lines = text + (shear ? "\nshear_softening = true" : "");
    const std::string micropolar = replaced(small_case, "[body]", "[body]\nmodel = \"micropolar\"");
    const CaseFile input = parse_case(replaced(micropolar, energy, lines), "");
    const CaseFile again = parse_case(write_case(input), "");
    for (const CaseFile& each : {input, again}) {
      const SofteningMaterial& material = each.materials.front().softening;
      EXPECT_EQ(material.shape.kind, Softening::concrete);
      EXPECT_DOUBLE_EQ(material.stretches[0], 1e-4);
      EXPECT_DOUBLE_EQ(material.stretches[1], 2e-4);
      EXPECT_DOUBLE_EQ(material.crushing[0], 1e-3);
      EXPECT_DOUBLE_EQ(material.crushing[1], 3e-3);
      EXPECT_EQ(material.shear_softens, shear);
      EXPECT_FALSE(material.closes);
    }
  }
}

TEST(CaseSoftening, ReadsStretchesInPlaceOfTheEnergy) {
  const SofteningMaterial material =
      material_of("softening = \"linear\"\nsoftening_stretches = [1e-4, 2e-3]", false);
  EXPECT_TRUE(has_stretches(material));
  EXPECT_EQ(material.stretches, (std::array{1e-4, 2e-3}));
  EXPECT_EQ(material_of("softening_stretches = [1e-4, 2e-3]", false).shape.kind,
            Softening::bilinear);
}

TEST(CaseSoftening, WritesWhatItReads) {
  const std::pair<const char*, bool> cases[] = {
      {"softening = \"linear\"\ntensile_strength = 2.7", true},
      {"tensile_strength = 2.7\nknee_stress_ratio = 0.25\nsoftening_error = 0.1", true},
      {"softening = \"exponential\"\ntensile_strength = 0.1", true},
      {"softening = \"points\"\ntensile_strength = 3\nsoftening_points = [[0, 3], [1, 1], [3, 0]]",
       true},
      {"softening_stretches = [1e-4, 2e-3]\nknee_opening_ratio = 0.2", false},
      {"softening = \"brittle\"", true}};
  for (const auto& [lines, keeps_energy] : cases) {
    const CaseFile input = with(lines, keeps_energy);
    const std::string written = write_case(input);
    const CaseFile again = parse_case(written, "");
    EXPECT_EQ(write_case(again), written);
    const SofteningMaterial &a = input.materials[0].softening, &b = again.materials[0].softening;
    EXPECT_EQ(a.shape.kind, b.shape.kind);
    EXPECT_EQ(a.shape.knee_force, b.shape.knee_force) << "to the last bit";
    EXPECT_EQ(a.shape.knee_stretch, b.shape.knee_stretch);
    EXPECT_EQ(a.tensile_strength, b.tensile_strength);
    EXPECT_EQ(a.stretches, b.stretches);
    EXPECT_EQ(a.error, b.error);
    EXPECT_EQ(input.materials[0].fracture_energy, again.materials[0].fracture_energy);
  }
}

}  // namespace
}  // namespace perilink

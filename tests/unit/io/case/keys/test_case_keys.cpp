#include "io/case/case_keys.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "io/case/sections/case_kinds.hpp"
#include "support/case_texts.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;

const char* const particle_case = R"(regions = [
  {name = "block", x = [0, 1], y = [0, 2]},
  {name = "top", x = [0, 1], y = [1.8, 2]},
]
[body]
model = "particles"
pattern = "hexagonal"
spacing = 0.1

[[materials]]
region = "block"
youngs_modulus = 30
poissons_ratio = 0.2
density = 2.5
tensile_strength = 0.003
fracture_energy = 1e-5

[[displacements]]
region = "top"
y = 0.01

[analysis]
type = "explicit"
duration = 2
)";

void expect_refusal(const std::string& text, const std::string& key, const std::string& why) {
  try {
    parse_case(text, "");
    FAIL() << "accepted: " << key;
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(key));
    EXPECT_THAT(error.what(), HasSubstr(why));
  }
}

TEST(CaseKeys, ParticlesReadTheirBodyAndMaterial) {
  const CaseFile input = parse_case(particle_case, "");
  EXPECT_TRUE(is_particles(input.body));
  EXPECT_EQ(input.body.surface, Surface::none);
  const MaterialSection& material = input.materials.front();
  ASSERT_TRUE(material.lattice.has_value());
  EXPECT_EQ(material.lattice->tensile_strength, 0.003);
  EXPECT_EQ(material.lattice->compression_threshold, 1.0 / 3.0);
  EXPECT_EQ(material.density, 2.5);
  EXPECT_FALSE(is_particles(parse_case(small_case, "").body));
}

TEST(CaseKeys, ParticlesWriteWhatTheyRead) {
  for (const std::string& text :
       {std::string(particle_case),
        replaced(particle_case, "pattern = \"hexagonal\"\nspacing = 0.1", "mesh = \"l.msh\"")}) {
    const std::string written = write_case(parse_case(text, ""));
    EXPECT_EQ(write_case(parse_case(written, "")), written);
    EXPECT_THAT(written, HasSubstr("model = \"particles\""));
    EXPECT_THAT(written, HasSubstr("tensile_strength = 0.003"));
    EXPECT_THAT(written, Not(HasSubstr("surface")));
    EXPECT_THAT(written, Not(HasSubstr("internal_damping")));
  }
}

TEST(CaseKeys, ParticlesRefuseWhatBondsWithinAHorizonHave) {
  for (const char* line : {"horizon = 0.3", "horizon_ratio = 3", "surface = \"none\"",
                           "micromodulus = \"lattice\"", "critical_stretch = \"lattice\""}) {
    const std::string key(line, std::string(line).find(' '));
    expect_refusal(replaced(particle_case, "spacing", std::string(line) + "\nspacing"), key,
                   "nearest neighbours");
  }
  expect_refusal(replaced(particle_case, "spacing", "rotation = 3\nspacing"), "rotation",
                 "model is \"particles\"");
}

TEST(CaseKeys, ParticlesRefuseWhatOnlyLatticesHave) {
  for (const char* line :
       {"internal_damping = 0.1", "yield_strength = 0.1", "boundary_factor = 0.2"}) {
    const std::string key(line, std::string(line).find(' '));
    expect_refusal(replaced(particle_case, "density", std::string(line) + "\ndensity"), key,
                   "only bodies with model = \"lattice\"");
  }
  expect_refusal(replaced(particle_case, "density", "external_damping = 0.1\ndensity"),
                 "external_damping", "analysis.damping_rate");
  expect_refusal(replaced(particle_case, "poissons_ratio = 0.2", "poissons_ratio = 0.5"),
                 "poissons_ratio", "state-based");
  expect_refusal(replaced(particle_case, "density = 2.5\n", ""), "density", "missing");
}

TEST(CaseKeys, ParticlesRefuseWhatTheyCannotBeCombinedWith) {
  expect_refusal(
      replaced(particle_case, "type = \"explicit\"\nduration = 2", "type = \"relaxation\""),
      "body.model", "relaxation");
  expect_refusal(std::string(particle_case) + "\n[[symmetry]]\naxis = \"x\"\nat = 0\n",
                 "symmetry[1]", "no mirror image");
  expect_refusal(std::string(particle_case) + "strain = \"green\"\n", "analysis.strain",
                 "small strains");
}

TEST(CaseKeys, BondsHaveNoKeysOfStates) {
  for (const TableSchema& table : case_schema()) {
    if (table.name != "materials") continue;
    for (const KeySchema& key : table.keys) {
      const auto of_states = [](const NotFor& without) {
        return without.holds(kinds::bond_based | kinds::plane | kinds::damage);
      };
      if (std::none_of(key.not_for.begin(), key.not_for.end(), of_states)) continue;
      const std::string line = std::string(key.name) + " = 1\nyoungs_modulus";
      expect_refusal(replaced(small_case, "youngs_modulus", line), std::string(key.name),
                     "only bodies with model = \"lattice\"");
    }
  }
}

TEST(CaseKeys, LinearElementsHaveNoKeysOfBonds) {
  for (const std::string_view key : keys_of_bonds()) {
    expect_refusal("[body]\nmethod = \"linear_elements\"\n" + std::string(key) +
                       " = 1\n[analysis]\ntype = \"elastic\"\n",
                   "body." + std::string(key), "have no bonds");
  }
}

/// A text that names what the search does not know would end the program.
TEST(CaseKeys, TextsAreFilledIn) {
  const auto check = [](const std::vector<NotFor>& column) {
    for (const NotFor& entry : column) {
      for (std::string text : {std::string(entry.fault), std::string(entry.suggestion)}) {
        for (const char* known : {"{model}", "{type}", "{resting}", "{turning}"}) {
          if (const auto at = text.find(known); at != std::string::npos) text.erase(at, 1);
        }
        EXPECT_EQ(text.find('{'), std::string::npos) << text;
      }
    }
  };
  for (const TableSchema& table : case_schema()) {
    check(table.not_for);
    for (const KeySchema& key : table.keys) check(key.not_for);
  }
}

}  // namespace
}  // namespace perilink

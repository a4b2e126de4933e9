#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/error.hpp"
#include "io/case/sections/case_lattice.hpp"
#include "support/case_texts.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;

const std::string yielding =
    "yield_strength = 0.02\nultimate_strength = 0.03\nultimate_plastic_strain = 0.003\n";

/// The lattice case by the consistent rules, with these keys in its material.
std::string yielding_case(const std::string& keys, const std::string& variant = "consistent") {
  const std::string text =
      replaced(lattice_case, "variant = \"2018\"", "variant = \"" + variant + "\"");
  return replaced(text, "tensile_strength", keys + "tensile_strength");
}

std::string yielding_refusal(const std::string& text) {
  try {
    parse_case(text, "");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(CaseLatticeYielding, ReadsAndWritesTheCurve) {
  for (const std::string energy : {"0.4", "\"infinite\""}) {
    const CaseFile input =
        parse_case(yielding_case(yielding + "crushing_energy = " + energy + "\n"), "");
    const CaseFile again = parse_case(write_case(input), "");
    for (const CaseFile* each : {&input, &again}) {
      const LatticeMaterialSection& section = *each->materials.front().lattice;
      EXPECT_EQ(section.yield_strength, 0.02);
      EXPECT_EQ(section.ultimate_strength, 0.03);
      EXPECT_EQ(section.ultimate_plastic_strain, 0.003);
      EXPECT_EQ(std::isinf(*section.crushing_energy), energy != "0.4");
    }
  }
  EXPECT_FALSE(
      parse_case(yielding_case(""), "").materials.front().lattice->yield_strength.has_value());
  EXPECT_FALSE(parse_case(yielding_case(yielding, "2018"), "")
                   .materials.front()
                   .lattice->crushing_energy.has_value());
}

TEST(CaseLatticeYielding, RefusesWhatMakesNoSense) {
  EXPECT_THAT(yielding_refusal(yielding_case("ultimate_strength = 0.03\n")),
              HasSubstr("does not yield"));
  EXPECT_THAT(yielding_refusal(yielding_case("yield_strength = 0.02\n")),
              HasSubstr("ultimate_strength"));
  EXPECT_THAT(yielding_refusal(yielding_case(yielding)), HasSubstr("crushing_energy"));
  EXPECT_THAT(yielding_refusal(yielding_case(yielding + "crushing_energy = \"much\"\n")),
              HasSubstr("neither a number nor"));
  EXPECT_THAT(yielding_refusal(yielding_case(yielding + "crushing_energy = 1\n", "2017")),
              HasSubstr("have their own softening"));
  EXPECT_THAT(
      yielding_refusal(yielding_case(replaced(yielding, "0.03", "0.01") + "crushing_energy = 1\n")),
      HasSubstr("less than the yield strength"));
}

}  // namespace
}  // namespace perilink

#include "io/case/sections/laws/case_random.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/replaced.hpp"
#include "support/strip_case.hpp"

namespace perilink {
namespace {

using namespace test;
using testing::ElementsAre;

const std::string random_energy =
    "\n[[random]]\nproperty = \"fracture_energy\"\ndistribution = \"normal\"\nvariation = 0.2\n"
    "correlation_length = 15\n";

CaseFile random_case(const std::string& section) {
  return parse_case(strip_text + section, "strip.toml");
}

TEST(CaseRandom, IsReadWithItsDefaults) {
  const CaseFile input = random_case(random_energy);
  ASSERT_EQ(input.fields.random.size(), 1u);
  const RandomSection& section = input.fields.random[0];
  EXPECT_EQ(section.property, VaryingProperty::fracture_energy);
  EXPECT_TRUE(section.materials.empty());
  EXPECT_EQ(section.field.distribution, Distribution::normal);
  EXPECT_EQ(section.field.variation, 0.2);
  EXPECT_EQ(section.field.correlation_length, 15.0);
  EXPECT_EQ(section.field.seed, 1u);
  EXPECT_THAT(materials_that_vary(input, section), ElementsAre(1));
}

TEST(CaseRandom, IsReadAgainAsItIsWritten) {
  const std::string written =
      write_case(random_case(random_energy + "seed = 7\nmaterials = [\"material 1\"]\n"));
  const CaseFile again = parse_case(written, "again.toml");
  ASSERT_EQ(again.fields.random.size(), 1u) << written;
  EXPECT_EQ(again.fields.random[0].field.seed, 7u);
  EXPECT_EQ(write_case(again), written);
}

TEST(CaseRandom, IsSetAsideByElasticAnalyses) {
  const CaseFile input = random_case(random_energy + "[analysis]\ntype = \"elastic\"\n");
  EXPECT_THAT(input.source.unused, ElementsAre("random[1]"));
}

TEST(CaseRandom, OfStiffnessIsUsedByElasticAnalyses) {
  const CaseFile input =
      random_case(replaced(random_energy, "fracture_energy", "youngs_modulus") +
                  "[[graded]]\nproperty = \"youngs_modulus\"\nfactor = \"1 + y / 80\"\n"
                  "[[graded]]\nproperty = \"fracture_energy\"\nfactor = 2\n"
                  "[analysis]\ntype = \"elastic\"\n");
  EXPECT_THAT(input.source.unused, ElementsAre("graded[2]"));
  EXPECT_TRUE(is_used(input, input.fields.random[0]));
  EXPECT_TRUE(is_used(input, input.fields.graded[0]));
  EXPECT_FALSE(is_used(input, input.fields.graded[1]));
}

TEST(CaseGraded, IsReadAgainAsItIsWritten) {
  const CaseFile input = random_case(
      "[[graded]]\nproperty = \"fracture_energy\"\nmaterials = [\"material 1\"]\n"
      "factor = \"1 + (x - 20)^2 / 400\"\n");
  ASSERT_EQ(input.fields.graded.size(), 1u);
  EXPECT_EQ(input.fields.graded[0].factor.formula, "1 + (x - 20)^2 / 400");
  const std::string written = write_case(input);
  const CaseFile again = parse_case(written, "again.toml");
  ASSERT_EQ(again.fields.graded.size(), 1u) << written;
  EXPECT_EQ(again.fields.graded[0].factor, input.fields.graded[0].factor);
  EXPECT_EQ(write_case(again), written);
}

TEST(CaseRandom, LeavesOutMaterialsWithoutTheProperty) {
  CaseFile input = random_case(random_energy);
  input.materials.push_back(input.materials[0]);
  input.materials[1].fracture_energy = infinity;
  EXPECT_THAT(materials_that_vary(input, input.fields.random[0]), ElementsAre(1, 0));
  input.fields.random[0].materials = {input.materials[1].name};
  EXPECT_THAT(materials_that_vary(input, input.fields.random[0]), ElementsAre(1, 1))
      << "both have this name here";
}

}  // namespace
}  // namespace perilink

#include "model/from_case/property_fields.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "support/strip_case.hpp"

namespace perilink {
namespace {

using namespace test;

CaseFile graded_case(const std::string& property, const std::string& factor,
                     const std::string& type = "damage") {
  return parse_case(strip_text + ("[[graded]]\nproperty = \"" + property + "\"\nfactor = \"" +
                                  factor + "\"\n[analysis]\ntype = \"" + type + "\"\n"),
                    "strip.toml");
}

std::size_t number_of_fields(const CaseFile& input) {
  std::vector<std::string> notes;
  return property_fields(input, {}, notes).size();
}

TEST(PropertyFieldsOfCase, AreLeftOutWhereNothingUsesThem) {
  EXPECT_EQ(number_of_fields(graded_case("fracture_energy", "1 + x")), 1u);
  EXPECT_EQ(number_of_fields(graded_case("youngs_modulus", "1 + x", "elastic")), 1u);
  EXPECT_EQ(number_of_fields(graded_case("fracture_energy", "1 + x", "elastic")), 0u);
}

TEST(PropertyFieldsOfCase, GiveParticlesTheirModulus) {
  const CaseFile input = graded_case("youngs_modulus", "1 + x / 40 + y / 20", "elastic");
  const Model model = build_model(input);
  ASSERT_EQ(model.modulus.size(), static_cast<std::size_t>(model.network.particles.size()));
  for (Index i = 0; i < model.network.particles.size(); ++i) {
    const auto x = model.network.particles.position(i);
    EXPECT_NEAR(model.modulus[i], 1.0 + x[0] / 40.0 + x[1] / 20.0, 1e-14);
  }
  EXPECT_TRUE(build_model(graded_case("fracture_energy", "1 + x")).modulus.empty());
  EXPECT_TRUE(build_model(strip_case()).modulus.empty());
}

TEST(PropertyFieldsOfCase, NoteTheRangeOfTheirFactors) {
  const Model model = build_model(graded_case("youngs_modulus", "y < 45 ? 1 : 3", "elastic"));
  EXPECT_THAT(model.notes, testing::Contains(testing::MatchesRegex(
                               "graded youngs_modulus: over .* bonds the factor is 1 to 3")));
}

TEST(PropertyFieldsOfCase, RefuseValuesThatAreNotPositive) {
  expect_refused(graded_case("youngs_modulus", "1 - y / 70", "elastic"), "graded[1].factor",
                 "at the position (");
  expect_refused(graded_case("fracture_energy", "sqrt(33 - y)"), "graded[1].factor", "nan");
}

TEST(PropertyFieldsOfCase, RefuseModuliThatRoundOffHides) {
  expect_refused(graded_case("youngs_modulus", "exp(y / 3)", "elastic"), "graded[1]",
                 "double precision cannot resolve both");
}

}  // namespace
}  // namespace perilink

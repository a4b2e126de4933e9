#include "io/case/sections/case_bond_dynamics.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/case_texts.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;

std::string with_analysis(const std::string& keys) {
  return fmt::format("{}[analysis]\n{}", small_case, keys);
}

std::string explicit_case(const std::string& keys) {
  return replaced(with_analysis("type = \"explicit\"\nduration = 4\n" + keys),
                  "fracture_energy = 0.1", "fracture_energy = 0.1\ndensity = 2.5");
}

constexpr const char* velocity = R"([[velocities]]
region = "block"
y = 0.5
)";

std::string dynamics_refusal(const std::string& text) {
  try {
    parse_case(text, "case.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(CaseMovingBonds, ReadsRelaxations) {
  const AnalysisSection plain = parse_case(with_analysis("type = \"relaxation\""), "").analysis;
  EXPECT_EQ(plain.load_factors, std::vector{1.0});
  EXPECT_EQ(plain.strain, Strain::small);
  EXPECT_EQ(plain.tolerance, 1e-6);
  EXPECT_EQ(plain.iterations, 1000000);
  const AnalysisSection full =
      parse_case(with_analysis("type = \"relaxation\"\nload_factors = [0.5, 1]\nstrain = "
                               "\"green\"\ntolerance = 1e-8\niterations = 500\n"
                               "rigid_body_modes = \"pin\""),
                 "")
          .analysis;
  EXPECT_EQ(full.load_factors, (std::vector{0.5, 1.0}));
  EXPECT_EQ(full.strain, Strain::green);
  EXPECT_EQ(full.tolerance, 1e-8);
  EXPECT_EQ(full.iterations, 500);
  EXPECT_EQ(full.rigid_body_modes, RigidBodyModes::pin);
}

TEST(CaseMovingBonds, ReadsStrainsAndVelocitiesOfExplicitAnalyses) {
  const CaseFile input = parse_case(replaced(explicit_case("strain = \"green\""), "[analysis]",
                                             velocity + std::string("[analysis]")),
                                    "");
  EXPECT_EQ(input.analysis.strain, Strain::green);
  ASSERT_EQ(input.velocities.size(), 1U);
  EXPECT_EQ(input.velocities[0].value[1]->number, 0.5);
  EXPECT_FALSE(input.velocities[0].value[0].has_value());
}

TEST(CaseMovingBonds, IsWrittenSoThatItReadsBack) {
  const std::string moved = replaced(explicit_case("strain = \"green\""), "[analysis]",
                                     velocity + std::string("[analysis]"));
  for (const std::string& text :
       {moved, with_analysis("type = \"relaxation\"\nload_factors = [0.5, 1]\nstrain = \"green\"\n"
                             "tolerance = 1e-8\niterations = 500")}) {
    const std::string once = write_case(parse_case(text, ""));
    EXPECT_EQ(write_case(parse_case(once, "")), once);
    EXPECT_THAT(once, HasSubstr("green"));
  }
  EXPECT_THAT(write_case(parse_case(moved, "")), HasSubstr("[[velocities]]"));
}

TEST(CaseMovingBonds, RefusesWhatRelaxationHasNot) {
  const std::string type = "type = \"relaxation\"\n";
  EXPECT_THAT(dynamics_refusal(with_analysis(type + "tolerance = 1e-14")), HasSubstr("round-off"));
  EXPECT_THAT(dynamics_refusal(with_analysis(type + "iterations = 0")), HasSubstr("iterations"));
  EXPECT_THAT(dynamics_refusal(with_analysis(type + "load_factors = [0, 0]")),
              HasSubstr("only zeros"));
  EXPECT_THAT(dynamics_refusal(with_analysis(type + "strain = \"large\"")), HasSubstr("green"));
  EXPECT_THAT(dynamics_refusal(replaced(with_analysis(type), "[body]\n",
                                        "[body]\nmethod = \"linear_elements\"\n")),
              HasSubstr("linear_elements"));
}

TEST(CaseMovingBonds, GreenStrainsAreOfBondsWithoutMoments) {
  const std::string text = replaced(with_analysis("type = \"relaxation\"\nstrain = \"green\""),
                                    "[body]\n", "[body]\nmodel = \"micropolar\"\n");
  EXPECT_THAT(
      dynamics_refusal(replaced(text, "youngs_modulus", "poissons_ratio = 0.2\nyoungs_modulus")),
      HasSubstr("small rotations only"));
  EXPECT_THAT(
      dynamics_refusal(replaced(lattice_case, "[analysis]\n", "[analysis]\nstrain = \"green\"\n")),
      HasSubstr("true lengths"));
}

TEST(CaseMovingBonds, VelocitiesAreOfExplicitBonds) {
  const auto with_velocity = [](const std::string& text) {
    return replaced(text, "[analysis]", velocity + std::string("[analysis]"));
  };
  EXPECT_THAT(dynamics_refusal(with_velocity(lattice_case)), HasSubstr("only bodies of bonds"));
  EXPECT_THAT(dynamics_refusal(with_velocity(explicit_case("")) +
                               "[[displacements]]\nregion = \"block\"\nx = 0\n"),
              testing::StrEq("accepted"));
  EXPECT_THAT(
      dynamics_refusal(replaced(with_velocity(explicit_case("")), "region = \"block\"\ny = 0.5",
                                "region = \"blok\"\ny = 0.5")),
      HasSubstr("block"));
}

}  // namespace
}  // namespace perilink

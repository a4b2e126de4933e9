#include "io/case/sections/case_rules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/case_texts.hpp"

// The refusals themselves are data: tests/cli/malformed. Here stands what the rules must let pass.

namespace perilink {
namespace {

using testing::HasSubstr;

const char* const two_materials = R"([[materials]]
region = "block"
youngs_modulus = 1
fracture_energy = 1

[[loads]])";

TEST(CaseRules, LetOverlappingRegionsHaveMaterials) {
  const std::string patch = "[[regions]]\nname = \"patch\"\nx = [0.2, 0.5]\ny = [0, 1]\n";
  const std::string text = replaced(replaced(small_case, "[[loads]]", two_materials),
                                    "region = \"block\"", "region = \"patch\"");
  EXPECT_EQ(message_of(text + patch), "accepted");
  EXPECT_THAT(message_of(text), HasSubstr("\"patch\", but no [[regions]]"));
  EXPECT_THAT(message_of(replaced(small_case, "[[loads]]", two_materials)),
              HasSubstr("has a material already"));
}

TEST(CaseRules, LetDisplacementsRepeatWhatSupportsHold) {
  const std::string text =
      std::string(small_case) + "[[supports]]\nregion = \"block\"\nfix = [\"x\"]\n";
  const std::string driven = "[[displacements]]\nregion = \"block\"\n";
  EXPECT_EQ(message_of(text + driven + "x = 0\n"), "accepted");
  EXPECT_EQ(message_of(text + driven + "y = 1\n"), "accepted");
  EXPECT_EQ(message_of(text + driven + "y = 1\n" + driven + "y = 1\n"), "accepted");
  EXPECT_THAT(message_of(text + driven + "x = 1\n"), HasSubstr("hold it in x"));
  EXPECT_THAT(message_of(text + driven + "y = 1\n" + driven + "y = 2\n"), HasSubstr("another"));
}

TEST(CaseRules, CheckACaseThatWasMadeByHand) {
  CaseFile input = parse_case(small_case, "case.toml");
  EXPECT_NO_THROW(check_rules(input));
  input.loads.clear();
  EXPECT_THROW(check_rules(input), InputError);
}

}  // namespace
}  // namespace perilink

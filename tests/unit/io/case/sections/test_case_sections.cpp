#include "io/case/sections/case_sections.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "support/case_texts.hpp"

// The refusals themselves are data: tests/cli/malformed. Here stand the edges of what is allowed.

namespace perilink {
namespace {

using testing::HasSubstr;

std::string message_with(const std::string& lines) { return message_of(small_case + lines); }

TEST(CaseSections, AllowTheEdgesOfStopRules) {
  EXPECT_EQ(message_with("[stop]\nbroken_bonds = 1"), "accepted");
  EXPECT_EQ(message_with("[stop]\nbroken_bonds = 2147483647"), "accepted");
  EXPECT_THAT(message_with("[stop]\nbroken_bonds = 2147483648"), HasSubstr("from 1 to 2147483647"));
  EXPECT_EQ(message_with("[stop]\nload_fraction = 0.999"), "accepted");
  EXPECT_THAT(message_with("[stop]\nload_fraction = 1"), HasSubstr("less than 1"));
}

TEST(CaseSections, RefuseNegativeLoadFactors) {
  const std::string steps = "[analysis]\ncontrol = \"steps\"\nload_factors = ";
  EXPECT_EQ(message_with(steps + "[0, 1, 0.5]"), "accepted");
  EXPECT_THAT(message_with(steps + "[0, -1, 0.5]"), HasSubstr("is -1, but must not be negative"));
  EXPECT_THAT(message_with(steps + "[-0.0]"), HasSubstr("only zeros"));
}

TEST(CaseSections, LetBarsBeElastic) {
  const std::string bar = "[[rebar]]\nfrom = [0, 0]\nto = [0, 2]\nyoungs_modulus = 1\narea = 1\n";
  EXPECT_EQ(message_with(bar), "accepted");
  EXPECT_EQ(message_with(bar + "yields = false"), "accepted");
  EXPECT_EQ(message_with(bar + "yield_strength = 1\nyields = true"), "accepted");
  EXPECT_THAT(message_with(bar + "yields = true"), HasSubstr("no yield strength"));
}

TEST(CaseSections, AllowAnEmptyListOfFields) {
  EXPECT_EQ(message_with("[output]\nfields_at = []"), "accepted");
  EXPECT_EQ(message_with("[output]\nfields_at = [1, 2, 3]\nfields_every = 1"), "accepted");
}

}  // namespace
}  // namespace perilink

#include "app/run/separated_body.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/strip_case.hpp"

namespace perilink {
namespace {

using namespace test;

/// The strip with a crack at the height of 45, from `begin` to its right edge and beyond.
CaseFile cracked_strip(double begin, double force) {
  CaseFile input = strip_case();
  input.materials[0].softening.closes = true;
  CrackSection crack;
  crack.points = {{begin, 45.0, 0.0}, {50.0, 45.0, 0.0}};
  input.cracks.push_back(crack);
  input.loads[0].force = Vector3{0.0, force, 0.0};
  return input;
}

TEST(SeparatedBody, IsRefusedWhereTheLoadsPullItApart) {
  const CaseFile input = cracked_strip(-10.0, 12.0);
  try {
    note_of_separated_body(input, draft_model(input), 1);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("and the loads pull it away"));
  }
}

TEST(SeparatedBody, IsToldOfWhereTheyPressItTogether) {
  const CaseFile input = cracked_strip(-10.0, -12.0);
  const auto note = note_of_separated_body(input, draft_model(input), 1);
  ASSERT_TRUE(note);
  EXPECT_THAT(*note, testing::HasSubstr("nothing but their closed faces holds it"));
}

TEST(SeparatedBody, OneWithALigamentIsNone) {
  const CaseFile input = cracked_strip(25.0, 12.0);
  EXPECT_FALSE(note_of_separated_body(input, draft_model(input), 1));
}

}  // namespace
}  // namespace perilink

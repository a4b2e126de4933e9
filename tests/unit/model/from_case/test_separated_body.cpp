#include "model/from_case/separated_body.hpp"

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

TEST(SeparatedBody, IsRefusedWhereItSlides) {
  const CaseFile input = cracked_strip(-10.0, -12.0);
  EXPECT_THROW(note_of_separated_body(input, draft_model(input), 1), InputError);
}

TEST(SeparatedBody, IsToldOfWhereTheyPressItTogether) {
  CaseFile input = cracked_strip(-10.0, -12.0);
  input.supports.push_back({"upper end", {true}});
  const auto note = note_of_separated_body(input, draft_model(input), 1);
  ASSERT_TRUE(note);
  EXPECT_THAT(*note, testing::HasSubstr("only their closed faces hold it"));
}

TEST(SeparatedBody, OneWithALigamentIsNone) {
  const CaseFile input = cracked_strip(25.0, 12.0);
  EXPECT_FALSE(note_of_separated_body(input, draft_model(input), 1));
}

/// A straight bar resists the opening of a cut, not the slip along it or the turn of the part
/// above.
TEST(SeparatedBody, IsRefusedWhereItSlidesAcrossABar) {
  for (const AnalysisType type : {AnalysisType::elastic, AnalysisType::damage}) {
    CaseFile input = cracked_strip(-10.0, 12.0);
    input.analysis.type = type;
    input.materials[0].softening.closes = false;
    RebarSection bar;
    bar.points = {{20.0, 5.0, 0.0}, {20.0, 75.0, 0.0}};
    bar.bond.type = RebarBond::concrete;
    bar.youngs_modulus = 29000.0;
    bar.area = 1.0;
    input.rebar.push_back(bar);
    const Model model = draft_model(input);
    try {
      refuse_pieces_on_bars(input, model, 1);
      FAIL() << "accepted";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("only bars hold the piece of 20"));
    }
    SupportSection roller;
    roller.region = "upper end";
    roller.fix = {true, false, false};
    input.supports.push_back(roller);
    EXPECT_NO_THROW(refuse_pieces_on_bars(input, draft_model(input), 1));
  }
}

}  // namespace
}  // namespace perilink

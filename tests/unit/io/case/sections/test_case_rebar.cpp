#include "io/case/sections/case_rebar.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "io/case/case_file.hpp"
#include "support/case_texts.hpp"

// The refusals themselves are data: tests/cli/malformed. Here stand what is read and written.

namespace perilink {
namespace {

using testing::HasSubstr;

const std::string steel = "youngs_modulus = 200e3\narea = 201\n";

CaseFile with_bar(const std::string& bar, const std::string& more = "") {
  return parse_case(small_case + ("[[rebar]]\n" + bar + steel) + more, "case.toml");
}

void expect_read_back(const CaseFile& input) {
  EXPECT_EQ(write_case(parse_case(write_case(input), "again.toml")), write_case(input));
}

TEST(CaseRebar, IsPerfectlyBondedUnlessItSaysOtherwise) {
  const CaseFile input = with_bar("from = [0, 0]\nto = [1, 2]\n");
  const RebarSection& bar = input.rebar.at(0);
  EXPECT_EQ(bar.bond.type, RebarBond::perfect);
  EXPECT_EQ(bar.points.size(), 2u);
  EXPECT_EQ(bar.bond.hooks, Hooks::none);
  EXPECT_FALSE(bar.across_gaps || bar.bends);
  expect_read_back(input);
}

TEST(CaseRebar, HasBendsCopiesAndABondCurve) {
  const CaseFile input = with_bar(
      "points = [[0, 0], [0.5, 0], [1, 1]]\ncopies = [2, 3]\nsteps = [[0, 0.1], [0.1, 0]]\n"
      "bond = \"curve\"\nbond_curve = [[0.1, 4], [1, 10], [5, 0]]\nhooks = \"both\"\n"
      "stress_strain = [[0.0025, 500], [0.05, 600]]\nrupture_strain = 0.06\n");
  const RebarSection& bar = input.rebar.at(0);
  EXPECT_EQ(bar.points.at(2), (Vector3{1.0, 1.0, 0.0}));
  EXPECT_THAT(bar.copies, testing::ElementsAre(2, 3));
  EXPECT_EQ(bar.bond.curve.at(1)[1], 10.0);
  EXPECT_EQ(bar.curve.at(1)[0], 0.05);
  expect_read_back(input);
}

TEST(CaseRebar, FollowsTheModelCode) {
  const CaseFile input = with_bar(
      "from = [0, 0]\nto = [1, 2]\nbond = \"model_code\"\nconcrete_strength = 38e6\n"
      "rib_spacing = 8e-3\nbond_failure = \"splitting_stirrups\"\nbond_conditions = \"other\"\n"
      "megapascal = 1e6\nmillimetre = 1e-3\nbends = true\n");
  const ModelCodeBond& code = input.rebar.at(0).bond.model_code;
  EXPECT_EQ(code.failure, BondFailure::splitting_stirrups);
  EXPECT_EQ(code.conditions, BondConditions::other);
  EXPECT_EQ(code.megapascal, 1e6);
  EXPECT_TRUE(input.rebar.at(0).bends);
  expect_read_back(input);
}

TEST(CaseRebar, IsLaidIntoARegion) {
  const CaseFile layer =
      with_bar("inside = \"block\"\nalong = \"y\"\nface = \"+x\"\ncover = 0.1\n");
  EXPECT_EQ(layer.rebar.at(0).layout->face, 3);
  expect_read_back(layer);
  const CaseFile stirrups =
      with_bar("inside = \"block\"\nalong = \"y\"\nspacing = 0.3\ncover = 0.1\n");
  EXPECT_EQ(stirrups.rebar.at(0).layout->spacing, 0.3);
  expect_read_back(stirrups);
}

TEST(CaseRebar, APrestrainBelongsToAStage) {
  const std::string stages =
      "[[stages]]\nname = \"prestress\"\nto = 1\n[[stages]]\nname = \"push\"\nto = 1\n";
  std::string text = small_case;
  text.replace(text.find("force = [0, -1]\n"), 16, "force = [0, -1]\nstage = \"push\"\n");
  const std::string bar = "[[rebar]]\nfrom = [0, 0]\nto = [1, 2]\nprestrain = 1e-3\n" + steel;
  EXPECT_THAT(message_of(text + bar + stages), HasSubstr("rebar[1]"));
  EXPECT_EQ(message_of(text + bar + "stage = \"prestress\"\n" + stages), "accepted");
  EXPECT_THAT(message_of(text + bar + "stage = \"none\"\n" + stages), HasSubstr("rebar[1].stage"));
}

}  // namespace
}  // namespace perilink

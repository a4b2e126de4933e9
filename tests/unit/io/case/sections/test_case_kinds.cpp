#include "io/case/sections/case_kinds.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "support/case_texts.hpp"

// The refusals themselves are data: tests/cli/malformed.

namespace perilink {
namespace {

using testing::HasSubstr;

TEST(CaseKinds, OnlyLatticesAndParticlesHaveStates) {
  BodySection body;
  for (const BodyModel model :
       {BodyModel::bond_based, BodyModel::micropolar, BodyModel::lattice, BodyModel::particles}) {
    body.model = model;
    EXPECT_EQ(is_lattice(body), body.model == BodyModel::lattice);
    EXPECT_EQ(is_particles(body), body.model == BodyModel::particles);
    EXPECT_EQ(has_state_based_particles(body), is_lattice(body) || is_particles(body));
  }
}

TEST(CaseKinds, SayWhyNothingRotates) {
  BodySection body;
  EXPECT_THAT(why_nothing_rotates(body), HasSubstr("bond-based body"));
  body.model = BodyModel::particles;
  EXPECT_THAT(why_nothing_rotates(body), HasSubstr("state-based body"));
  body = {};
  body.method = BodyMethod::linear_elements;
  EXPECT_THAT(why_nothing_rotates(body), HasSubstr("corners"));
  EXPECT_THAT(what_rotates(body), HasSubstr("instead of method"));
}

TEST(CaseKinds, HaveTwoOrThreeDimensions) {
  BodySection body;
  EXPECT_EQ(dimension_of(body), 2);
  body.problem = Problem::three_dimensional;
  EXPECT_EQ(dimension_of(body), 3);
}

TEST(CaseKinds, MaterialsMayBeUnbreakable) {
  std::string text = small_case;
  const std::string given = "fracture_energy = 0.1";
  text.replace(text.find(given), given.size(), "fracture_energy = \"infinite\"");
  const CaseFile input = parse_case(text, "");
  EXPECT_EQ(input.materials[0].fracture_energy, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace perilink

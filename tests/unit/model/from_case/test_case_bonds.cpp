#include "model/from_case/case_bonds.hpp"

#include <gtest/gtest.h>

#include "support/strip_case.hpp"

namespace perilink {
namespace {

TEST(CaseBonds, MaterialsMayDifferInNamesOnly) {
  CaseFile input = test::strip_case();
  input.body.surface = Surface::none;
  input.analysis.type = AnalysisType::elastic;
  input.materials.push_back(input.materials[0]);
  input.materials[1].regions = {"lower end"};
  input.materials[0].poissons_ratio = 1.0 / 3.0;  // as bonds in plane stress have
  input.materials[1].poissons_ratio.reset();
  EXPECT_FALSE(have_unlike_constants(input));
  input.materials[0].poissons_ratio = 0.333;  // with the digits that users write
  EXPECT_FALSE(have_unlike_constants(input));
  input.body.model = BodyModel::micropolar;  // whose bonds follow the ratio
  EXPECT_TRUE(have_unlike_constants(input));
}

}  // namespace
}  // namespace perilink

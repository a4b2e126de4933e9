#include "app/supports.hpp"

#include <gtest/gtest.h>

#include "support/strip_case.hpp"

namespace perilink {
namespace {

using test::expect_refused;
using test::strip_case;

TEST(Supports, DisplacementsFollowTheirFormula) {
  CaseFile input = strip_case();
  input.supports.clear();
  input.loads.clear();
  DisplacementSection driven;
  driven.region = "surface";
  driven.value[0] = Expression("0.001*x*y");
  driven.value[1] = Expression("0.002*y^2");
  input.displacements.push_back(driven);
  const Model model = build_model(input);
  for (Index i = 0; i < model.network.particles.size(); ++i) {
    const std::span<const double> x = model.network.particles.position(i);
    const bool rim = x[0] == 0.0 || x[0] == 40.0 || x[1] == 0.0 || x[1] == 80.0;
    ASSERT_EQ(model.unknowns.at(i, 0) == no_index, rim);
    if (!rim) continue;
    EXPECT_DOUBLE_EQ(model.unknowns.prescribed[2 * i], 0.001 * x[0] * x[1]);
    EXPECT_DOUBLE_EQ(model.unknowns.prescribed[2 * i + 1], 0.002 * x[1] * x[1]);
  }
  EXPECT_TRUE(model.reference.driven);
  EXPECT_DOUBLE_EQ(model.reference.value, 0.002 * 6400.0);
}

TEST(Supports, FormulasThatAgreeMayMeet) {
  CaseFile input = strip_case();
  input.supports.clear();
  input.loads.clear();
  DisplacementSection driven;
  driven.region = "surface";
  driven.value[0] = Expression("0.3*y");
  driven.value[1] = 0.0;
  input.displacements.push_back(driven);
  driven.region = "upper end";
  driven.value[0] = Expression("3*y/10");
  driven.value[1].reset();
  input.displacements.push_back(driven);
  EXPECT_NO_THROW(build_model(input));
  input.displacements[1].value[0] = Expression("0.3*y + 1e-6");
  expect_refused(input, "displacements[2]", "another entry sets it to 18");
}

}  // namespace
}  // namespace perilink

#include "model/conditions/supports.hpp"

#include <gtest/gtest.h>

#include <cmath>

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
  EXPECT_DOUBLE_EQ(model.reference.value, std::hypot(0.001 * 3200.0, 0.002 * 6400.0));
}

/// Displacement of a velocity at the end of the duration.
TEST(Supports, VelocitiesArePrescribedAsTheWayTheyGo) {
  CaseFile input = strip_case();
  input.loads.clear();
  input.analysis.duration = 4.0;
  DisplacementSection moved;
  moved.region = "upper end";
  moved.value[1] = Expression("0.5*x");
  input.velocities.push_back(moved);
  const Model model = build_model(input);
  int found = 0;
  for (Index i = 0; i < model.network.particles.size(); ++i) {
    const std::span<const double> x = model.network.particles.position(i);
    if (model.unknowns.prescribed[2 * i + 1] == 0.0) continue;
    EXPECT_DOUBLE_EQ(model.unknowns.prescribed[2 * i + 1], 4.0 * 0.5 * x[0]);
    ++found;
  }
  EXPECT_GT(found, 0);
  EXPECT_DOUBLE_EQ(model.reference.value, 4.0 * 0.5 * 40.0);
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

/// A strip cut in two by its axis of symmetry moves like the whole one.
TEST(Supports, HalfABodyWithAPlaneOfSymmetryHoldsTheNormalDisplacement) {
  CaseFile input = strip_case();
  input.supports[0].fix = {false, true};
  input.symmetry.push_back({0, 0.0, ""});
  const Model model = build_model(input);
  for (Index i = 0; i < model.network.particles.size(); ++i) {
    const std::span<const double> x = model.network.particles.position(i);
    EXPECT_EQ(model.unknowns.at(i, 0) == no_index, x[0] == 0.0);
    EXPECT_EQ(model.unknowns.at(i, 1) == no_index, x[1] <= 20.0);
  }
  input.symmetry[0] = {0, std::nullopt, "middle"};
  input.regions[3].box = {{40.0, 0.0, 0.0}, {40.0, 80.0, 0.0}};
  const Model by_region = build_model(input);
  EXPECT_EQ(by_region.unknowns.count, model.unknowns.count);
  for (Index i = 0; i < model.network.particles.size(); ++i) {
    EXPECT_EQ(model.gripped[i] != 0, model.network.particles.position(i)[1] <= 20.0) << "support";
  }
  input.symmetry[0] = {0, 3.0, ""};
  expect_refused(input, "symmetry[1].at", "is 3, but no particle lies in that plane");
  expect_refused(input, "symmetry[1].at", "the nearest particle has x = 0");
}

TEST(Supports, APlaneOfSymmetryHoldsTheRotationsThatItForbids) {
  CaseFile input = strip_case();
  input.body.model = BodyModel::micropolar;
  input.analysis.type = AnalysisType::elastic;
  input.materials[0].poissons_ratio = 0.2;
  input.supports[0].fix = {false, true};
  input.symmetry.push_back({0, 0.0, ""});
  const Model plane = build_model(input);
  for (Index i = 0; i < plane.network.particles.size(); ++i) {
    EXPECT_EQ(plane.unknowns.at(i, 2) == no_index, plane.network.particles.position(i)[0] == 0.0);
  }
  CaseFile prism = test::prism_case();
  prism.body.model = BodyModel::micropolar;
  prism.analysis.type = AnalysisType::elastic;
  prism.materials[0].poissons_ratio = 0.2;
  prism.symmetry.push_back({2, 0.4, ""});
  const Model space = build_model(prism);
  for (Index i = 0; i < space.network.particles.size(); ++i) {
    const std::span<const double> x = space.network.particles.position(i);
    if (x[1] < 0.1) continue;  // held
    const bool mirrored = x[2] == 0.4;
    EXPECT_EQ(space.unknowns.at(i, 2) == no_index, mirrored);
    EXPECT_EQ(space.unknowns.at(i, 3) == no_index, mirrored);
    EXPECT_EQ(space.unknowns.at(i, 4) == no_index, mirrored);
    EXPECT_NE(space.unknowns.at(i, 5), no_index) << "turning about the normal stays";
  }
}

TEST(Supports, SpringsShareTheirAreaOrVolume) {
  CaseFile input = strip_case();
  EXPECT_TRUE(build_model(input).network.support_stiffness.empty());
  Region top;
  top.name = "top";
  top.box = {{0.0, 80.0, 0.0}, {40.0, 80.0, 0.0}};
  input.regions.push_back(top);
  input.springs.push_back({"top", Vector3{0.5, 3.0, 0.0}, std::nullopt});
  input.springs.push_back({"upper end", std::nullopt, Vector3{0.0, 7.0, 0.0}});
  const Model model = build_model(input);
  const Particles& particles = model.network.particles;
  double along_x = 0.0, along_y = 0.0;
  for (Index i = 0; i < particles.size(); ++i) {
    const std::span<const double> x = particles.position(i);
    const bool corner = x[0] == 0.0 || x[0] == 40.0;
    const double area = x[1] < 80.0 ? 0.0 : 2.0 * (corner ? 5.0 : 10.0);
    EXPECT_NEAR(model.network.support_stiffness[2 * i], 0.5 * area, 1e-13);
    along_x += model.network.support_stiffness[2 * i];
    along_y += model.network.support_stiffness[2 * i + 1];
  }
  EXPECT_NEAR(along_x, 0.5 * 80.0, 1e-12);
  EXPECT_NEAR(along_y, 3.0 * 80.0 + 7.0, 1e-12);
}

TEST(Supports, SpringsHoldABodyThatNothingElseHolds) {
  CaseFile input = strip_case();
  input.supports.clear();
  expect_refused(input, "analysis", "3 of the 3 rigid-body modes");
  input.springs.push_back({"lower end", std::nullopt, Vector3{0.0, 7.0, 0.0}});
  expect_refused(input, "analysis", "1 of the 3 rigid-body modes");
  input.springs[0].total = Vector3{1.0, 7.0, 0.0};
  EXPECT_NO_THROW(build_model(input));
}

}  // namespace
}  // namespace perilink

#include "model/conditions/boundary_conditions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/strip_case.hpp"

namespace perilink {
namespace {

using test::expect_refused;
using test::free_strip_case;
using test::prism_case;
using test::strip_case;

double force(const Model& model, Index particle, int axis) {
  return model.loads.forces[static_cast<std::size_t>(particle) * model.network.dim() + axis];
}

double total_force(const Model& model, int axis) {
  double sum = 0.0;
  for (Index i = 0; i < model.network.particles.size(); ++i) sum += force(model, i, axis);
  return sum;
}

TEST(BoundaryConditions, AForceIsSharedByVolumeAndNothingIsLost) {
  const Model model = build_model(strip_case());
  const Particles& particles = model.network.particles;
  // Rows at 60, 70 and 80; the last one and the sides have half volumes: 2.5 rows of 4 cells.
  const double per_volume = 12.0 / (2.5 * 4.0 * 10.0 * 10.0 * 2.0);
  for (Index i = 0; i < particles.size(); ++i) {
    const bool loaded = particles.position(i)[1] >= 60.0;
    EXPECT_NEAR(force(model, i, 1), loaded ? per_volume * particles.volumes[i] : 0.0, 1e-14);
    EXPECT_EQ(force(model, i, 0), 0.0);
  }
  EXPECT_NEAR(total_force(model, 1), 12.0, 1e-12);
  EXPECT_FALSE(model.reference.driven);
  EXPECT_DOUBLE_EQ(model.reference.value, 12.0);
}

TEST(BoundaryConditions, ABodyForceIsForcePerVolume) {
  CaseFile input = strip_case();
  input.loads[0].force.reset();
  input.loads[0].body_force = Vector3{0.25, -0.5, 0.0};
  input.loads[0].region = "strip";
  const Model model = build_model(input);
  const Particles& particles = model.network.particles;
  for (Index i = 0; i < particles.size(); ++i) {
    EXPECT_NEAR(force(model, i, 0), 0.25 * particles.volumes[i], 1e-12);
    EXPECT_NEAR(force(model, i, 1), -0.5 * particles.volumes[i], 1e-12);
  }
  const double volume = 40.0 * 80.0 * 2.0;
  EXPECT_NEAR(total_force(model, 1), -0.5 * volume, 1e-9);
  EXPECT_NEAR(model.reference.value, std::hypot(0.25, 0.5) * volume, 1e-9);
}

TEST(BoundaryConditions, LoadsOnTheSameParticlesAdd) {
  CaseFile input = strip_case();
  LoadSection more = input.loads[0];
  more.force = Vector3{3.0, 30.0, 0.0};
  more.region = "strip";
  input.loads.push_back(more);
  const Model model = build_model(input);
  EXPECT_NEAR(total_force(model, 0), 3.0, 1e-12);
  EXPECT_NEAR(total_force(model, 1), 42.0, 1e-12);
  const double apart = 12.0 + std::hypot(3.0, 30.0), together = std::hypot(3.0, 42.0);
  EXPECT_DOUBLE_EQ(model.reference.value, 0.5 * (apart + together)) << "of two places";
}

TEST(BoundaryConditions, LoadsGoToTheSolidAndSupportsToBarsToo) {
  CaseFile input = strip_case();
  RebarSection bar;
  bar.points = {{15.0, 5.0, 0.0}, {15.0, 75.0, 0.0}};
  bar.bond.type = RebarBond::concrete;
  bar.youngs_modulus = 29000.0;
  bar.area = 1.0;
  input.rebar.push_back(bar);
  const Model model = build_model(input);
  const Particles& particles = model.network.particles;
  EXPECT_NEAR(total_force(model, 1), 12.0, 1e-12);
  for (Index i = 45; i < particles.size(); ++i) {
    ASSERT_EQ(particles.kind[i], ParticleKind::rebar);
    EXPECT_EQ(force(model, i, 1), 0.0);
    EXPECT_EQ(model.unknowns.at(i, 0) == no_index, particles.position(i)[1] <= 20.0);
  }
}

TEST(BoundaryConditions, SupportsHoldTheDirectionsThatTheyName) {
  CaseFile input = strip_case();
  SupportSection side;
  side.region = "upper end";
  side.fix = {true, false, false};
  input.supports.push_back(side);
  const Model model = build_model(input);
  for (Index i = 0; i < model.network.particles.size(); ++i) {
    const double y = model.network.particles.position(i)[1];
    EXPECT_EQ(model.unknowns.at(i, 0) == no_index, y <= 20.0 || y >= 60.0);
    EXPECT_EQ(model.unknowns.at(i, 1) == no_index, y <= 20.0);
  }
  EXPECT_EQ(model.unknowns.count, 2 * 45 - 2 * 15 - 15);
}

TEST(BoundaryConditions, DrivenDisplacementsArePrescribed) {
  CaseFile input = strip_case();
  input.loads.clear();
  DisplacementSection driven;
  driven.region = "upper end";
  driven.value[1] = -0.2;
  input.displacements.push_back(driven);
  const Model model = build_model(input);
  for (Index i = 0; i < model.network.particles.size(); ++i) {
    const double y = model.network.particles.position(i)[1];
    const std::size_t slot = static_cast<std::size_t>(i) * 2 + 1;
    EXPECT_EQ(model.unknowns.prescribed[slot], y >= 60.0 ? -0.2 : 0.0);
    EXPECT_EQ(model.unknowns.at(i, 1) == no_index, y >= 60.0 || y <= 20.0);
    EXPECT_EQ(model.unknowns.at(i, 0) == no_index, y <= 20.0);
  }
  EXPECT_TRUE(model.reference.driven);
  EXPECT_DOUBLE_EQ(model.reference.value, 0.2);
}

/// The load of strip_case() acts on the displacement-controlled end; so does that of the whole
/// strip.
TEST(BoundaryConditions, ForcesOnWhatIsDrivenAreNoted) {
  CaseFile input = strip_case();
  DisplacementSection driven;
  driven.region = "upper end";
  driven.value[1] = -0.2;
  input.displacements.push_back(driven);
  const auto is_note =
      testing::Contains(testing::HasSubstr("prescribed displacements in their direction"));
  EXPECT_THAT(build_model(input).notes, is_note);
  input.displacements[0].value = {};
  input.displacements[0].value[0] = 0.2;
  EXPECT_THAT(build_model(input).notes, testing::Not(is_note)) << "across them";
}

/// Without supports along y the approach of the platens counts, else what one of them moves.
TEST(BoundaryConditions, PlatensThatMoveBothAreOneDisplacement) {
  CaseFile input = strip_case();
  input.loads.clear();
  DisplacementSection driven;
  driven.region = "upper end";
  driven.value[1] = -0.2;
  input.displacements.push_back(driven);
  driven.region = "lower end";
  driven.value[1] = 0.1;
  input.displacements.push_back(driven);
  input.supports[0].fix = {true, false, false};
  const Model platens = build_model(input);
  EXPECT_DOUBLE_EQ(platens.reference.value, 0.3);
  ASSERT_EQ(platens.prescribed_regions.size(), 2u);
  EXPECT_EQ(platens.prescribed_regions[1].name, "lower end");
  EXPECT_EQ(platens.prescribed_regions[1].slots.size(), 15u);
  input.displacements[1].value[1] = -0.1;
  EXPECT_DOUBLE_EQ(build_model(input).reference.value, 0.1);
}

TEST(BoundaryConditions, EntriesThatOverlapMustAgree) {
  CaseFile input = strip_case();
  DisplacementSection driven;
  driven.region = "strip";
  driven.value[0] = 0.0;
  input.displacements.push_back(driven);
  EXPECT_NO_THROW(build_model(input)) << "both say zero";
  input.displacements[0].value[0] = 0.5;
  expect_refused(input, "displacements[1]", "displacement along x");
  input.displacements[0].region = "upper end";
  EXPECT_NO_THROW(build_model(input));
  DisplacementSection other = driven;
  other.region = "strip";
  other.value = {};
  other.value[0] = 0.25;
  input.supports[0].fix = {false, true, false};
  input.displacements.push_back(other);
  expect_refused(input, "displacements[2]", "to 0.25, where another entry sets it to 0.5");
}

TEST(BoundaryConditions, PinningHoldsTheRigidModesAndNoMore) {
  const Model plane = build_model(free_strip_case());
  EXPECT_EQ(plane.unknowns.count, 2 * 45 - 3);
  EXPECT_THAT(plane.notes, testing::Contains(testing::HasSubstr("3 rigid-body modes")));
  CaseFile prism = prism_case();
  prism.supports.clear();
  prism.loads.push_back(prism.loads[0]);
  prism.loads[1].region = "lower end";
  prism.loads[1].force = Vector3{0.0, -3.0, 0.0};
  prism.analysis.rigid_body_modes = RigidBodyModes::pin;
  const Model space = build_model(prism);
  EXPECT_EQ(space.unknowns.count, 3 * 5 * 5 * 9 - 6);
  EXPECT_THAT(space.notes, testing::Contains(testing::HasSubstr("6 rigid-body modes")));
}

TEST(BoundaryConditions, FreeBodiesAreRefusedUnlessTheyMayBePinned) {
  CaseFile input = free_strip_case();
  input.analysis.rigid_body_modes = RigidBodyModes::refuse;
  expect_refused(input, "analysis",
                 "3 of the 3 rigid-body modes of the body are free: translation along x, "
                 "translation along y, 1 rotation");
  SupportSection roller;
  roller.region = "lower end";
  roller.fix = {false, true, false};
  input.supports.push_back(roller);
  expect_refused(input, "supports[1]",
                 "1 of the 3 rigid-body modes of the body is free: translation along x");
  input.analysis.rigid_body_modes = RigidBodyModes::pin;
  expect_refused(input, "analysis.rigid_body_modes", "partly supported");
}

/// In motion a free body needs no supports, and pins would fix particles.
TEST(BoundaryConditions, BodiesInMotionAreHeldByTheirInertia) {
  CaseFile input = free_strip_case();
  input.analysis.type = AnalysisType::explicit_;
  input.materials[0].density = 2.0;
  input.regions[2].box.lower[0] = 10.0;  // the pull is off the axis
  const Model pinned = build_model(input);
  EXPECT_EQ(pinned.unknowns.count, 2 * 45);
  EXPECT_THAT(pinned.notes, testing::Contains(testing::HasSubstr("no particle is held")));
  EXPECT_THAT(pinned.notes, testing::Contains(testing::HasSubstr("is subtracted from them")));
  const LoadResultant sum = load_resultant(pinned.network, pinned.loads);
  EXPECT_NEAR(sum.force[0], 0.0, 1e-13);
  EXPECT_NEAR(sum.force[1], 0.0, 1e-13);
  EXPECT_NEAR(sum.moment[0], 0.0, 1e-12);
  input.analysis.rigid_body_modes = RigidBodyModes::refuse;
  const Model free = build_model(input);
  EXPECT_THAT(free.notes, testing::Contains(testing::HasSubstr("resists 3 rigid-body modes")));
  EXPECT_GT(std::abs(load_resultant(free.network, free.loads).moment[0]), 1.0);
  SupportSection roller;
  roller.region = "lower end";
  roller.fix = {false, true, false};
  input.supports.push_back(roller);
  EXPECT_THAT(build_model(input).notes,
              testing::Contains(testing::HasSubstr("resists 1 rigid-body mode of the body")));
  input.analysis.rigid_body_modes = RigidBodyModes::pin;
  expect_refused(input, "analysis.rigid_body_modes", "delete the key");
}

TEST(BoundaryConditions, PinnedBodiesNeedBalancedLoads) {
  CaseFile input = free_strip_case();
  input.loads[1].force = Vector3{0.0, -11.9, 0.0};
  expect_refused(input, "analysis.rigid_body_modes", "not in balance");
  input.loads[1].force = Vector3{0.0, -12.0 * (1.0 + 1e-9), 0.0};
  EXPECT_NO_THROW(build_model(input)) << "typed with ten digits";
}

TEST(BoundaryConditions, ASmallNetCoupleIsNotedAndALargeOneRefused) {
  EXPECT_THAT(build_model(free_strip_case()).notes,
              testing::Not(testing::Contains(testing::HasSubstr("couple"))));
  CaseFile input = free_strip_case();
  input.regions[2].box.lower[0] = 10.0;  // the pull is off the axis by 15/8, half a column short
  EXPECT_THAT(build_model(input).notes, testing::Contains(testing::HasSubstr("net couple of")));
  input.loads[0].force = Vector3{12.0, 0.0, 0.0};
  input.loads[1].force = Vector3{-12.0, 0.0, 0.0};
  expect_refused(input, "analysis.rigid_body_modes", "the loads rotate the free body");
}

/// Two strips side by side, each pushed by one force of a pair that balances in all only.
TEST(BoundaryConditions, EachPinnedPartNeedsBalancedLoadsOfItsOwn) {
  CaseFile input = free_strip_case();
  Region other = input.regions[0];
  other.name = "other strip";
  other.box.lower[0] = 200.0;
  other.box.upper[0] = 240.0;
  input.regions.push_back(other);
  input.materials[0].regions.push_back(other.name);
  EXPECT_THAT(build_model(input).notes, testing::Contains(testing::HasSubstr("2 parts")));
  input.loads[1].region = other.name;
  expect_refused(input, "analysis.rigid_body_modes", "not in balance");
}

TEST(BoundaryConditions, LooseParticlesAreRefused) {
  CaseFile input = strip_case();
  input.body.surface = Surface::none;
  input.body.horizon = 14.2;
  RebarSection bar;  // its outer node, off the corner of the body, has a single element
  bar.points = {{40.0, 80.0, 0.0}, {47.0, 87.0, 0.0}};
  bar.bond.type = RebarBond::concrete;
  bar.across_gaps = true;
  bar.youngs_modulus = 29000.0;
  bar.area = 1.0;
  input.rebar.push_back(bar);
  expect_refused(input, "body.horizon", "(47, 87) is held by bonds in fewer than 2 directions");
  input.regions[3].box = {{40.0, 80.0, 0.0}, {50.0, 90.0, 0.0}};
  input.supports.push_back({"middle", {true, true, false}});
  EXPECT_NO_THROW(build_model(input)) << "a support holds it";
}

/// The strip with micropolar bonds.
CaseFile micropolar_strip() {
  CaseFile input = strip_case();
  input.body.model = BodyModel::micropolar;
  input.materials[0].poissons_ratio = 0.2;
  return input;
}

TEST(BoundaryConditions, RotationsAreFreeUnlessASupportHoldsThem) {
  CaseFile input = micropolar_strip();
  const Model free = build_model(input);
  EXPECT_EQ(free.network.width(), 3);
  EXPECT_EQ(free.unknowns.count, 3 * 45 - 2 * 15);
  input.supports[0].fix[5] = true;
  const Model held = build_model(input);
  EXPECT_EQ(held.unknowns.count, 3 * 45 - 3 * 15);
  for (Index i = 0; i < 45; ++i) {
    EXPECT_EQ(held.unknowns.at(i, 2) == no_index, held.network.particles.position(i)[1] < 20.5);
  }
  // The load is a force: moments stay zero.
  for (Index i = 0; i < 45; ++i) EXPECT_EQ(held.loads.forces[3 * i + 2], 0.0);
}

TEST(BoundaryConditions, RotationsInSpaceGoAboutTheAxesThatAreNamed) {
  CaseFile input = prism_case();
  input.body.model = BodyModel::micropolar;
  input.materials[0].poissons_ratio = 0.2;
  input.supports[0].fix = {true, true, true, false, true, false};
  const Model model = build_model(input);
  for (Index i = 0; i < model.network.particles.size(); ++i) {
    const bool low = model.network.particles.position(i)[1] < 0.06;
    for (int a = 0; a < 6; ++a) {
      EXPECT_EQ(model.unknowns.at(i, a) == no_index, low && a != 3 && a != 5);
    }
  }
}

/// The strip under its load, then clamped and displaced at its upper end.
TEST(BoundaryConditions, StagesHaveTheirOwnLoadsAndGrips) {
  CaseFile input = strip_case();
  input.loads[0].stage = "weight";
  DisplacementSection driven;
  driven.region = "upper end";
  driven.value[1] = -0.2;
  driven.stage = "push";
  input.displacements.push_back(driven);
  input.stages.resize(3);
  input.stages[0].name = input.stages[0].loads = "weight";
  input.stages[1].name = input.stages[1].loads = "push";
  input.stages[2].name = "back";
  input.stages[2].loads = "push";
  const Model model = build_model(input);
  ASSERT_EQ(model.sets.size(), 2u);
  const LoadCase &weight = model.sets[0], &push = model.sets[1];
  EXPECT_EQ(weight.unknowns.count, 2 * 45 - 2 * 15);
  EXPECT_EQ(push.unknowns.count, weight.unknowns.count - 15);
  EXPECT_EQ(model.unknowns.count, weight.unknowns.count);
  EXPECT_DOUBLE_EQ(weight.reference.value, 12.0);
  EXPECT_FALSE(weight.reference.driven);
  EXPECT_DOUBLE_EQ(push.reference.value, 0.2);
  EXPECT_TRUE(push.reference.driven);
  double force = 0.0, rest = 0.0, lowest = 0.0;
  for (std::size_t slot = 1; slot < weight.loads.forces.size(); slot += 2) {
    force += weight.loads.forces[slot];
    rest += std::abs(push.loads.forces[slot]) + std::abs(weight.unknowns.prescribed[slot]);
    lowest = std::min(lowest, push.unknowns.prescribed[slot]);
  }
  EXPECT_NEAR(force, 12.0, 1e-12);
  EXPECT_EQ(rest, 0.0);
  EXPECT_EQ(lowest, -0.2);
}

TEST(BoundaryConditions, EveryStageMustLoadSomething) {
  CaseFile input = strip_case();
  input.loads.push_back(input.loads[0]);
  input.loads[0].stage = "one";
  input.loads[1].stage = "two";
  input.loads[1].region = "lower end";
  input.stages.resize(2);
  input.stages[0].name = input.stages[0].loads = "one";
  input.stages[1].name = input.stages[1].loads = "two";
  try {
    build_model(input);
    FAIL() << "forces on supports do no work";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("loads[2]"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace perilink

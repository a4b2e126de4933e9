#include "model/conditions/loads.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/strip_case.hpp"

namespace perilink {
namespace {

using test::expect_refused;
using test::prism_case;
using test::strip_case;

/// The strip is 40 by 80 by 2 with 5 by 9 particles; "top" is its upper edge.
CaseFile strip_with_top() {
  CaseFile input = strip_case();
  input.loads.clear();
  Region top;
  top.name = "top";
  top.box = {{0.0, 80.0, 0.0}, {40.0, 80.0, 0.0}};
  input.regions.push_back(top);
  return input;
}

TractionSection traction_on(const std::string& region, const Expression& x, const Expression& y) {
  TractionSection section;
  section.region = region;
  section.traction = ExpressionVector();
  (*section.traction)[0] = x;
  (*section.traction)[1] = y;
  return section;
}

double force_on(const Model& model, Index particle, int axis) {
  return model.loads.forces[static_cast<std::size_t>(particle) * model.network.dim() + axis];
}

double force_on_all(const Model& model, int axis) {
  double sum = 0.0;
  for (Index i = 0; i < model.network.particles.size(); ++i) sum += force_on(model, i, axis);
  return sum;
}

TEST(Loads, UniformTractionsShareTheAreaEqually) {
  CaseFile input = strip_with_top();
  input.tractions.push_back(traction_on("top", 0.5, 3.0));
  const Model model = build_model(input);
  for (Index i = 0; i < model.network.particles.size(); ++i) {
    const std::span<const double> x = model.network.particles.position(i);
    const bool corner = x[0] == 0.0 || x[0] == 40.0;
    const double area = x[1] < 80.0 ? 0.0 : 2.0 * (corner ? 5.0 : 10.0);
    EXPECT_NEAR(force_on(model, i, 0), 0.5 * area, 1e-13);
    EXPECT_NEAR(force_on(model, i, 1), 3.0 * area, 1e-13);
  }
  EXPECT_NEAR(model.reference.value, std::hypot(0.5, 3.0) * 80.0, 1e-11);
}

TEST(Loads, LinearTractionsHaveExactForcesAndMoments) {
  CaseFile input = strip_with_top();
  input.tractions.push_back(traction_on("top", 0.0, Expression("3 - x/10")));
  const Model model = build_model(input);
  EXPECT_NEAR(force_on_all(model, 1), 2.0 * (3.0 * 40.0 - 800.0 / 10.0), 1e-11);
  double moment = 0.0;
  for (Index i = 0; i < model.network.particles.size(); ++i) {
    moment += force_on(model, i, 1) * model.network.particles.position(i)[0];
  }
  EXPECT_NEAR(moment, 2.0 * (3.0 * 800.0 - 64000.0 / 30.0), 1e-9);
}

/// Pressure pushes inwards; all around a body it is in balance, and the reference is then half the
/// sum of sizes: per particle the area vector, so diagonal at the four corners.
TEST(Loads, PressurePushesInwardsAndBalancesAllAround) {
  CaseFile input = strip_with_top();
  TractionSection section;
  section.region = "top";
  section.pressure = 2.0;
  input.tractions.push_back(section);
  const Model above = build_model(input);
  EXPECT_NEAR(force_on_all(above, 1), -2.0 * 80.0, 1e-11);
  EXPECT_NEAR(force_on_all(above, 0), 0.0, 1e-13);
  input.tractions[0].region = "surface";
  const Model around = build_model(input);
  EXPECT_NEAR(force_on_all(around, 0), 0.0, 1e-12);
  EXPECT_NEAR(force_on_all(around, 1), 0.0, 1e-12);
  const double faces = 2.0 * 2.0 * 2.0 * (40.0 + 80.0);  // the sum of the sizes of their forces
  EXPECT_NEAR(around.reference.value, 0.5 * faces, 1e-10);
}

TEST(Loads, FacesPressedOneByOneAreAsMuchAsAllInOneEntry) {
  CaseFile input = strip_with_top();
  const auto press = [&](const std::string& region, const Expression& pressure) {
    TractionSection section;
    section.region = region;
    section.pressure = pressure;
    input.tractions.push_back(section);
  };
  press("surface", 2.0);
  const double together = build_model(input).reference.value;
  input.tractions.clear();
  press("surface", Expression("2 + 1e-7*x"));
  EXPECT_NEAR(build_model(input).reference.value, together, 1e-5 * together) << "nearly balanced";
  input.tractions.clear();
  const double sides[4][4] = {{0, 40, 80, 80}, {0, 40, 0, 0}, {0, 0, 0, 80}, {40, 40, 0, 80}};
  for (const auto& [x, right, y, above] : sides) {
    Region side;
    side.name = fmt::format("side {}", input.regions.size());
    side.box = {{x, y, 0.0}, {right, above, 0.0}};
    input.regions.push_back(side);
    press(side.name, 2.0);
  }
  EXPECT_NEAR(build_model(input).reference.value, together, 1e-10);
}

TEST(Loads, TractionsOnAFaceInSpaceAddUp) {
  CaseFile input = prism_case();
  input.loads.clear();
  Region face;
  face.name = "face";
  face.box = {{0.0, 0.8, 0.0}, {0.4, 0.8, 0.4}};
  input.regions.push_back(face);
  TractionSection section = traction_on("face", 0.0, Expression("x*z"));
  input.tractions.push_back(section);
  const Model model = build_model(input);
  EXPECT_NEAR(force_on_all(model, 1), 0.08 * 0.08, 1e-15);  // (0.4^2 / 2)^2
}

TEST(Loads, BodyForcesByFormulaAreValuesTimesVolumes) {
  CaseFile input = strip_with_top();
  LoadSection load;
  load.region = "body";
  load.body_force = ExpressionVector();
  (*load.body_force)[1] = Expression("-0.1*y");
  input.loads.push_back(load);
  const Model model = build_model(input);
  const Particles& particles = model.network.particles;
  for (Index i = 0; i < particles.size(); ++i) {
    EXPECT_NEAR(force_on(model, i, 1), -0.1 * particles.position(i)[1] * particles.volumes[i],
                1e-11);
  }
  EXPECT_NEAR(model.reference.value, 0.1 * 3200.0 * 40.0 * 2.0, 1e-8);
}

TEST(Loads, AFormulaThatEqualsANumberChangesNothing) {
  CaseFile input = strip_with_top();
  input.loads.push_back(strip_case().loads[0]);
  input.loads[0].force.reset();
  input.loads[0].body_force = Vector3{0.0, 0.25, 0.0};
  const Model number = build_model(input);
  (*input.loads[0].body_force)[1] = Expression("1/4");
  const Model formula = build_model(input);
  for (std::size_t slot = 0; slot < number.loads.forces.size(); ++slot) {
    EXPECT_NEAR(formula.loads.forces[slot], number.loads.forces[slot], 1e-13);
  }
}

TEST(Loads, TractionsOffTheSurfaceAreRefusedWithTheNearestFacet) {
  CaseFile input = strip_with_top();
  input.tractions.push_back(traction_on("middle", 1.0, 0.0));
  input.regions[3].box = {{12.0, 45.0, 0.0}, {28.0, 60.0, 0.0}};
  expect_refused(input, "tractions[1].region", "tractions act on the surface");
  expect_refused(input, "tractions[1].region", "the nearest facet has its centre at (0, 45)");
}

TEST(Loads, FormulasThatAreZeroEverywhereAreRefused) {
  CaseFile input = strip_with_top();
  input.tractions.push_back(traction_on("top", 0.0, Expression("y - 80")));
  expect_refused(input, "tractions[1]", "the case has no load");
}

/// A body of triangles or tetrahedra, 5 by 3 cells in the plane, whose region "loaded" carries 10
/// along x. \return the first moments of the force over the force: where it acts, z last
Vector3 place_of_force(bool in_space, const std::string& loaded) {
  const auto region = [&](const std::string& name, const std::string& box) {
    return "[[regions]]\nname = \"" + name + "\"\n" + box + (in_space ? "z = [0, 3]\n" : "");
  };
  const Model model = build_model(parse_case(
      "[body]\nmethod = \"linear_elements\"\nspacing = 1\nproblem = \"" +
          std::string(in_space ? "three_dimensional" : "plane_stress") + "\"\n" +
          region("body of it", "x = [0, 5]\ny = [0, 3]\n") + region("loaded", loaded) +
          region("left", "x = [0, 0]\ny = [0, 3]\n") +
          "[[materials]]\nregion = \"body of it\"\nyoungs_modulus = 1\n[[supports]]\nregion = "
          "\"left\"\n" +
          (in_space ? "fix = [\"x\", \"y\", \"z\"]\n" : "fix = [\"x\", \"y\"]\n") +
          "[[loads]]\nregion = \"loaded\"\nforce = " + (in_space ? "[10, 0, 0]" : "[10, 0]") +
          "\n[analysis]\ntype = \"elastic\"\n",
      "elements.toml"));
  Vector3 place{};
  for (Index i = 0; i < model.network.particles.size(); ++i) {
    const std::span<const double> x = model.network.particles.position(i);
    for (std::size_t a = 0; a < x.size(); ++a) place[a] += 0.1 * force_on(model, i, 0) * x[a];
  }
  EXPECT_NEAR(force_on_all(model, 0), 10.0, 1e-13);
  return place;
}

TEST(Loads, ForcesActAtTheCentroidsOfFacesAndVolumesOfLinearElements) {
  for (const bool in_space : {false, true}) {
    const auto expect_at = [&](const std::string& loaded, double x, double y) {
      const Vector3 place = place_of_force(in_space, loaded);
      EXPECT_NEAR(place[0], x, 1e-13) << loaded;
      EXPECT_NEAR(place[1], y, 1e-13) << loaded;
      if (in_space) {
        EXPECT_NEAR(place[2], 1.5, 1e-13) << loaded;
      }
    };
    expect_at("x = [5, 5]\ny = [0, 3]\n", 5.0, 1.5);
    expect_at("x = [0, 2]\ny = [3, 3]\n", 1.0, 3.0);
    expect_at("x = [3, 5]\ny = [0, 1]\n", 4.0, 0.5);
  }
}

/// A mesh of two triangles over a rectangle; cells carry the body force, not the particles.
TEST(Loads, BodyForcesOnAMeshAreIntegratedOverItsCells) {
  CaseFile input = strip_with_top();
  LoadSection load;
  load.region = "body";
  load.body_force = ExpressionVector();
  (*load.body_force)[0] = Expression("x");
  input.loads.push_back(load);
  Model model;
  model.network.particles.dim = 2;
  model.network.particles.positions = {0, 0, 40, 0, 0, 80, 40, 80};
  model.network.particles.volumes.assign(4, 1600.0);
  model.network.particles.material.assign(4, 0);
  model.network.particles.kind.assign(4, ParticleKind::solid);
  model.lattice.spacing = 10.0;
  model.cells.vertices = {0, 1, 3, 0, 3, 2};
  model.cells.material = {0, 0};
  const AppliedLoads applied = collect_loads(input, model, 2);
  double sum = 0.0;
  for (const double f : applied.loads.forces) sum += f;
  EXPECT_NEAR(sum, 2.0 * 80.0 * 800.0, 1e-9);  // thickness 2, integral of x over the rectangle
  // Vertex 1 belongs to one triangle, where x has the means 40/3, 80/3: (2 a + b + c) A / 12.
  EXPECT_NEAR(applied.loads.forces[2], 2.0 * 1600.0 * (2.0 * 40.0 + 40.0) / 12.0, 1e-9);
}

TEST(Loads, PointLoadsGoToTheNearestParticle) {
  CaseFile input = strip_with_top();
  input.point_loads.push_back({{20.0, 80.0, 0.0}, {1.0, -4.0, 0.0}, {}});
  const Model exact = build_model(input);
  EXPECT_EQ(force_on_all(exact, 0), 1.0);
  EXPECT_EQ(force_on_all(exact, 1), -4.0);
  EXPECT_DOUBLE_EQ(exact.reference.value, std::hypot(1.0, 4.0));
  for (Index i = 0; i < exact.network.particles.size(); ++i) {
    const std::span<const double> x = exact.network.particles.position(i);
    EXPECT_EQ(force_on(exact, i, 1) != 0.0, x[0] == 20.0 && x[1] == 80.0);
  }
  input.point_loads[0].at = {23.0, 81.0, 0.0};
  const Model moved = build_model(input);
  EXPECT_EQ(moved.loads.forces, exact.loads.forces);
  ASSERT_EQ(moved.notes.size(), exact.notes.size() + 1);
  EXPECT_EQ(moved.notes.back(), "the point load at (23, 81) acts on the particle at (20, 80)");
  input.point_loads[0].at = {20.0, 91.0, 0.0};
  expect_refused(input, "point_loads[1].at", "is (20, 91), 11 from the nearest particle");
}

/// Two forces side by side carry their sum over the mean of their deflections; a force and a
/// traction on one region are one place.
TEST(Loads, PlacesSideBySideAddUpAndEntriesOfOneRegionAreOnePlace) {
  CaseFile input = strip_with_top();
  input.point_loads.push_back({{10.0, 80.0, 0.0}, {0.0, -4.0, 0.0}, {}});
  input.point_loads.push_back({{30.0, 80.0, 0.0}, {0.0, -4.0, 0.0}, {}});
  const Model apart = build_model(input);
  EXPECT_DOUBLE_EQ(apart.reference.value, 8.0);
  ASSERT_EQ(apart.load_regions.size(), 2u);
  EXPECT_EQ(apart.load_regions[1].name, "particle at (30, 80)");
  input.point_loads.clear();
  input.tractions.push_back(traction_on("top", 0.5, 0.0));
  input.tractions.push_back(traction_on("top", 0.0, 3.0));
  const Model one = build_model(input);
  EXPECT_EQ(one.load_regions.size(), 1u);
  EXPECT_NEAR(one.reference.value, std::hypot(0.5, 3.0) * 80.0, 1e-11);
}

TEST(Loads, PointMomentsTurnMicropolarParticles) {
  CaseFile input = strip_with_top();
  input.body.model = BodyModel::micropolar;
  input.analysis.type = AnalysisType::elastic;
  input.materials[0].poissons_ratio = 0.2;
  input.point_loads.push_back({{20.0, 80.0, 0.0}, {}, {0.0, 0.0, 6.0}});
  const Model model = build_model(input);
  double sum = 0.0;
  for (Index i = 0; i < model.network.particles.size(); ++i) sum += model.loads.forces[3 * i + 2];
  EXPECT_EQ(sum, 6.0);
  EXPECT_EQ(model.reference.value, 6.0);
  input.body.micromodulus = Constants::continuum;
  input.materials[0].poissons_ratio = 1.0 / 3.0;
  expect_refused(input, "point_loads[1].moment", "have no rotational stiffness");
}

}  // namespace
}  // namespace perilink

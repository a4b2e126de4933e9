#include "model/body/mesh_input.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "app/run/run_kind.hpp"
#include "base/error.hpp"
#include "io/mesh/gmsh_mesher.hpp"
#include "io/text/csv.hpp"
#include "model/from_case/configure.hpp"
#include "model/model_regions.hpp"
#include "support/gmsh_texts.hpp"
#include "support/halved_meshes.hpp"
#include "support/replaced.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

using test::TemporaryDirectory;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* case_text = R"(regions = [
  {name = "solid", group = "plate"},
  {name = "base", group = "lower"},
  {name = "right", x = [2, 2], y = [0, 2]},
]
[body]
mesh = "body.msh"
horizon_ratio = 3
surface = "none"

[[materials]]
region = "solid"
youngs_modulus = 100
fracture_energy = 1

[[supports]]
region = "base"
fix = ["x", "y"]

[[loads]]
region = "right"
force = [1, 0]
)";

/// A folder with the square mesh and a case that uses it.
class MeshInput : public ::testing::Test {
 protected:
  MeshInput() { test::write_text(directory_ / "body.msh", test::square_mesh); }

  CaseFile parse(const std::string& from = "", const std::string& to = "") const {
    std::string text = case_text;
    if (!from.empty()) text.replace(text.find(from), from.size(), to);
    return parse_case(text, (directory_ / "case.toml").string());
  }
  std::string refusal(const std::string& from, const std::string& to) const {
    try {
      build_model(parse(from, to));
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  TemporaryDirectory directory_;
};

TEST_F(MeshInput, GivesParticlesBondsAndGroups) {
  const Model model = build_model(parse());
  EXPECT_EQ(model.network.particles.size(), 5);
  EXPECT_EQ(model.network.bonds.size(), 10);  // every pair
  EXPECT_EQ(model.lattice.pattern, Pattern::irregular);
  EXPECT_DOUBLE_EQ(model.horizon, 3.0 * model.lattice.spacing);
  EXPECT_EQ(model.facets.size(), 4);
  EXPECT_EQ(model.cells.size(), 4);
  EXPECT_THAT(model.notes, ElementsAre(HasSubstr("thin body")));
  EXPECT_EQ(model.unknowns.count, 6);
}

TEST_F(MeshInput, RegionsAreGroupsOrBoxes) {
  const CaseFile input = parse();
  const Model model = build_model(input);
  EXPECT_THAT(particles_of_region(input, model, "base", "supports[1]"), ElementsAre(0, 1));
  EXPECT_THAT(particles_of_region(input, model, "right", "loads[1]"), ElementsAre(1, 2));
  EXPECT_EQ(group_named(model, "lower and left").facets.size(), 2u);
}

TEST_F(MeshInput, BoxesHoldMaterialsToo) {
  std::vector<std::string> notes;
  const CaseFile input = parse("group = \"plate\"", "x = [0, 1], y = [0, 2]");
  const Body body = read_mesh_body(input, 2, notes);
  EXPECT_EQ(body.cells.size(), 3);  // the centre of the right triangle is at 1.5
  EXPECT_THAT(body.particles.material, Each(0));
  EXPECT_THAT(notes, ElementsAre("left out: 1 of the 4 cells of the mesh, without material"));
}

TEST_F(MeshInput, RefusesWhatTheMeshLacks) {
  EXPECT_THAT(refusal("group = \"lower\"", "group = \"lover\""),
              AllOf(HasSubstr("regions[2].group: is \"lover\""), HasSubstr("did you mean `lower`?"),
                    HasSubstr("Allowed: corner, lower, lower and left, plate")));
  EXPECT_THAT(
      refusal("group = \"plate\"", "group = \"lower\""),
      AllOf(HasSubstr("materials[1]"), HasSubstr("a group of lines, which contain no material")));
  EXPECT_THAT(refusal("horizon_ratio = 3", "horizon = 0.5"),
              HasSubstr("body.horizon: the horizon 0.5 is smaller than the spacing"));
  EXPECT_THAT(
      refusal("mesh = \"body.msh\"", "mesh = \"body.msh\"\nproblem = \"three_dimensional\""),
      HasSubstr("regions[3].z"));
  EXPECT_THAT(refusal("body.msh", "nobody.msh"),
              AllOf(HasSubstr("body.mesh: "), HasSubstr("nobody.msh: cannot be opened")));
}

TEST_F(MeshInput, SaysHowToMakeGroupsWhereThereAreNone) {
  std::string text = test::square_mesh;
  const std::pair<std::string, std::string> entities[] = {{"0 0 0 1 7", "0 0 0 0"},
                                                          {"2 -3 4 2 1 2", "0 2 1 2"},
                                                          {"0 1 4 2 1 4", "0 0 2 1 4"},
                                                          {"0 1 5 2 11 12", "0 0 2 11 12"}};
  for (const auto& [grouped, plain] : entities) {
    text.replace(text.find(grouped), grouped.size(), plain);
  }
  test::write_text(directory_ / "body.msh", text);
  EXPECT_THAT(refusal("", ""), HasSubstr("write Physical Surface(\"plate\") = {...};"));
}

TEST_F(MeshInput, NamesOfGroupsNeedToBeUniqueInTheirDimensionOnly) {
  test::write_text(directory_ / "body.msh",
                   replaced(replaced(test::square_mesh, "\"corner\"", "\"lower\""),
                            "\"lower and left\"", "\"plate\""));
  const CaseFile input = parse();
  const Model model = build_model(input);
  EXPECT_THAT(particles_of_region(input, model, "base", ""), ElementsAre(0, 1)) << "not its point";
  EXPECT_EQ(particles_of_region(input, model, "solid", "").size(), 5u) << "not its lines";
  for (const char* group : {"\"base\" is the group \"lower\" of lines; ",
                            "\"solid\" is the group \"plate\" of triangles; "}) {
    EXPECT_THAT(model.notes, Contains(std::string("the region ") + group +
                                      "groups of lower dimension have the same name and are not "
                                      "used"));
  }
}

/// A plate in tension by its right side: stress E u / L, energy half of force times displacement.
TEST_F(MeshInput, MarksUnusedNodesAndNamesChangeNothing) {
  const std::string clean = test::square_mesh;
  const std::string meshes[] = {clean, "\xEF\xBB\xBF" + clean,
                                replaced(clean, "9 9 0\n", "9 9 7\n"),
                                replaced(clean, "2 5 \"plate\"", "2 5 \"lower\""),
                                replaced(clean, "\"lower and left\"", "\"lower\"")};
  for (const std::string& mesh : meshes) {
    test::write_text(directory_ / "body.msh", mesh);
    const CaseFile input = parse_case(R"(regions = [
  {name = "plate", x = [0, 2], y = [0, 2]},
  {name = "left", x = [0, 0], y = [0, 2]},
  {name = "right", x = [2, 2], y = [0, 2]},
  {name = "corner", x = [0, 0], y = [0, 0]},
]
[body]
mesh = "body.msh"
method = "linear_elements"
[[materials]]
region = "plate"
youngs_modulus = 30000
poissons_ratio = 0.3
[[supports]]
region = "left"
fix = ["x"]
[[supports]]
region = "corner"
fix = ["y"]
[[displacements]]
region = "right"
x = 0.002
[analysis]
type = "elastic"
)",
                                      (directory_ / "case.toml").string());
    const auto run = make_run(input, 1, true);
    std::filesystem::create_directories(directory_ / "out");
    run->open(directory_ / "out", true);
    RunFiles& files = run->files();
    run->analyse();
    files.finish();
    const CsvTable table = read_csv((directory_ / "out/history.csv").string());
    EXPECT_NEAR(table.rows[0][table.column("load")], 60.0, 1e-9);
    EXPECT_NEAR(table.rows[0][table.column("strain_energy")], 0.06, 1e-12);
  }
}

/// Coordinates of the mesh in millimetres, of the case in metres.
TEST_F(MeshInput, ScalesTheCoordinatesOfMeshesAndScripts) {
  const auto upper_corner = [&](const std::string& mesh) {
    const Mesh read = read_mesh_input(parse("mesh = \"body.msh\"", mesh), 2).mesh;
    const auto largest = std::max_element(read.positions.begin(), read.positions.end());
    return std::pair(*largest, read.num_cells());
  };
  EXPECT_EQ(upper_corner("mesh = \"body.msh\"").first, 9.0);
  EXPECT_EQ(upper_corner("mesh = \"body.msh\"\nmesh_scale = 0.5").first, 4.5);
  if (!has_gmsh()) return;
  test::write_text(directory_ / "body.geo",
                   "DefineConstant[ h = 1 ]; SetFactory(\"OpenCASCADE\");\n"
                   "Rectangle(1) = {0, 0, 0, 4, 2}; MeshSize{:} = h;\n"
                   "Physical Surface(\"plate\") = {1}; Physical Curve(\"lower\") = {1};\n");
  const auto plain = upper_corner("mesh = \"body.geo\"\nmesh_size = 0.5");
  const auto scaled = upper_corner("mesh = \"body.geo\"\nmesh_size = 0.05\nmesh_scale = 0.1");
  EXPECT_EQ(plain.first, 4.0);
  EXPECT_EQ(scaled.first, 0.4);
  EXPECT_EQ(scaled.second, plain.second) << "mesh_size is in the unit of the case";
}

TEST_F(MeshInput, RefusesLinesOutsideThePlaneOnlyInGroupsThatTheCaseNames) {
  test::write_text(
      directory_ / "body.msh",
      replaced(replaced(test::square_mesh, "9 9 0\n", "9 9 5\n"), "3 40 10 ", "3 40 60"));
  EXPECT_NO_THROW(read_mesh_input(parse(), 2));
  EXPECT_THAT(refusal("group = \"lower\"", "group = \"lower and left\""),
              HasSubstr("regions[2].group: is \"lower and left\", a group with lines outside the "
                        "plane of the body"));
}

TEST_F(MeshInput, GeometriesSayTheirUnitAndSize) {
  if (!has_gmsh()) GTEST_SKIP() << "built without gmsh";
  const auto write = [&](const std::string& name) {
    const std::string script = (directory_ / "make.geo").string();
    test::write_text(
        script,
        "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {1, 0, 0, 2, 1};\nSave \"" + name + "\";\n");
    mesh_geometry(script, 2, {}, true);
    return test::read_text(directory_ / name);
  };
  const auto notes_of = [&](const std::string& name, const char* size) {
    CaseFile input = parse("mesh = \"body.msh\"", "mesh = \"" + name + "\"\nmesh_size = " + size);
    input.regions.clear();  // the geometry has no groups
    input.materials.clear();
    return read_mesh_input(input, 2).notes;
  };
  const std::string metres =
      replaced(write("body.step"), "SI_UNIT(.MILLI.,.METRE.)", "SI_UNIT($,.METRE.)");
  test::write_text(directory_ / "body.step", metres);
  EXPECT_THAT(notes_of("body.step", "500"),
              Contains(AllOf(HasSubstr("body.step: lengths are in millimetres"),
                             HasSubstr("the mesh goes from (1000, 0) to (3000, 1000)"))));
  write("body.brep");
  EXPECT_THAT(notes_of("body.brep", "0.5"),
              Contains(AllOf(HasSubstr("BREP files state no unit"),
                             HasSubstr("the mesh goes from (1, 0) to (3, 1)"))));
}

TEST_F(MeshInput, CracksCutBonds) {
  CaseFile input = parse();
  input.cracks = {{{{1.0, -1.0, 0.0}, {1.0, 0.5, 0.0}}}};  // only the lower side is crossed
  const Model model = build_model(input);
  EXPECT_EQ(model.network.bonds.size(), 10 - 1);
  EXPECT_THAT(model.network.report.cut_by_crack, ElementsAre(1));
}

/// Bonds of meshes that can break have the critical stretches of a continuum at first.
TEST_F(MeshInput, BrittleMaterialsInLayersAreCalibratedLayerByLayer) {
  test::write_text(directory_ / "halves.msh", test::halved_mesh_text(2, 16, 1.0));
  std::string text = "[body]\nmesh = \"halves.msh\"\nhorizon_ratio = 2\n";
  for (const char* group : {"first", "second", "left", "right"}) {
    text += fmt::format("[[regions]]\nname = \"{0}\"\ngroup = \"{0}\"\n", group);
  }
  text +=
      "[[materials]]\nregion = \"first\"\nyoungs_modulus = 100\nfracture_energy = 1\n"
      "[[materials]]\nregion = \"second\"\nyoungs_modulus = 400\nfracture_energy = 1\n"
      "[[supports]]\nregion = \"left\"\nfix = [\"x\", \"y\"]\n"
      "[[loads]]\nregion = \"right\"\nforce = [1, 0]\n";
  const Model model = build_model(parse_case(text, (directory_ / "halves.toml").string()));
  // Along the joint's normal, from the corner of the body about which it is turned.
  const auto height = [&](Index i) {
    const auto x = model.network.particles.position(i);
    return x[0] * std::cos(std::numbers::pi / 6.0) + x[1] * std::sin(std::numbers::pi / 6.0) - 0.5;
  };
  int beside = 0;
  for (Index b = 0; b < model.network.bonds.size(); ++b) {
    const double from = height(model.network.bonds.first[b]);
    const double to = height(model.network.bonds.second[b]);
    EXPECT_FALSE(from * to < -1e-12) << "crosses the joint";  // round-off of the turn
    beside += std::abs(from) < 0.1 && std::abs(to) < 0.1;
  }
  EXPECT_GT(beside, 0);
}

TEST_F(MeshInput, IsFoundFromTheFolderOfTheResults) {
  const CaseFile input = parse();
  const auto results = directory_ / "results/plate";
  std::filesystem::create_directories(results);
  const CaseFile moved = seen_from(input, results);
  EXPECT_EQ(*moved.body.mesh, "../../body.msh");
  const CaseFile read = parse_case(write_case(moved), (results / "case.toml").string());
  EXPECT_EQ(build_model(read).network.particles.size(), 5);

  CaseFile embedded = input;
  embedded.elements.emplace();
  embedded.elements->mesh = "coarse.msh";
  EXPECT_EQ(*seen_from(embedded, results).elements->mesh, "../../coarse.msh");

  CaseFile graded = input;
  graded.fields.graded.resize(1);
  graded.fields.graded[0].file = "strength.csv";
  EXPECT_EQ(*seen_from(graded, results).fields.graded[0].file, "../../strength.csv");

  CaseFile absolute = input;
  absolute.body.mesh = (directory_ / "body.msh").string();
  EXPECT_EQ(seen_from(absolute, results).body.mesh, absolute.body.mesh);
}

}  // namespace
}  // namespace perilink

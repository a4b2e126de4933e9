#include "io/mesh/gmsh_mesher.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include "base/error.hpp"
#include "io/mesh/mesh_file.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

using ::testing::HasSubstr;

const std::string meshes = PERILINK_SOURCE_DIR "/meshes/";

std::string refusal(const std::string& path, std::optional<double> size) {
  try {
    mesh_geometry(path, 2, size);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(GmshMesher, MeshesScriptsWithTheSizeAskedFor) {
  if (!has_gmsh()) {
    EXPECT_THAT(refusal(meshes + "disc.geo", {}), HasSubstr("was built without gmsh"));
    return;
  }
  const Mesh own = mesh_geometry(meshes + "disc.geo", 2, {});
  const Mesh fine = mesh_geometry(meshes + "disc.geo", 2, 0.075);
  EXPECT_EQ(own.groups.size(), 3u);
  // Equilateral triangles of this side that fill the disc; gmsh's are up to a fifth smaller.
  const auto ideal = [](double side) {
    return std::numbers::pi / (0.25 * std::sqrt(3.0) * side * side);
  };
  EXPECT_NEAR(own.num_cells() / ideal(0.15), 1.0, 0.2) << "the script's own size";
  EXPECT_NEAR(fine.num_cells() / ideal(0.075), 1.0, 0.2);
  EXPECT_EQ(mesh_geometry(meshes + "disc.geo", 2, 0.075).positions, fine.positions);
}

TEST(GmshMesher, SaysWhatIsWrong) {
  if (!has_gmsh()) GTEST_SKIP() << "built without gmsh";
  const test::TemporaryDirectory directory;
  const std::string path = (directory / "body.geo").string();
  EXPECT_THAT(refusal(path, {}), HasSubstr("body.geo: cannot be opened"));
  test::write_text(path, "DefineConstant[ size = 0.1 ];\n");
  EXPECT_THAT(refusal(path, 0.1),
              AllOf(HasSubstr("has no constant `h`"), HasSubstr("[ h = 0.1 ]")));
  test::write_text(path, "Plane Surface(1) = {7};\n");
  EXPECT_THAT(refusal(path, {}), HasSubstr("body.geo"));
  test::write_text(path, "// nothing\n");
  EXPECT_THAT(refusal(path, {}), AllOf(HasSubstr("body.geo"), HasSubstr("holds no mesh")));
}

/// Sizes are refused by the number of cells, not by the box around the body.
TEST(GmshMesher, RefusesCellsBeyondTheMemory) {
  if (!has_gmsh()) GTEST_SKIP() << "built without gmsh";
  EXPECT_THAT(refusal(meshes + "disc.geo", 1e-5),
              AllOf(HasSubstr("gives about"), HasSubstr("e+1"), HasSubstr("times this size")));
  const test::TemporaryDirectory directory;
  const std::string path = (directory / "body.geo").string();
  const auto corner = [&](double along, double across) {
    test::write_text(path, fmt::format("SetFactory(\"OpenCASCADE\"); DefineConstant[ h = 1 ];\n"
                                       "Rectangle(1) = {{0, 0, 0, {0}, {1}}};\n"
                                       "Rectangle(2) = {{0, 0, 0, {1}, {0}}};\n"
                                       "BooleanUnion{{Surface{{1}}; Delete;}}{{Surface{{2}}; "
                                       "Delete;}}\nMeshSize{{:}} = h;\n",
                                       along, across));
    return path;
  };
  // 5e6 squares in the box of two bars a cell wide
  EXPECT_LT(mesh_geometry(corner(23, 0.01), 2, 0.01).num_cells(), 3e4);
  EXPECT_THAT(refusal(corner(1000, 1000), 0.01), HasSubstr("times this size"));
}

/// A square with a line in it, of which the lower end is on the side.
constexpr const char* square_with_slit = R"(h = 0.25;
Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {1, 1, 0, h}; Point(4) = {0, 1, 0, h};
Point(5) = {0.5, 0, 0, h}; Point(6) = {0.5, 0.5, 0, h};
Line(1) = {1, 5}; Line(2) = {5, 2}; Line(3) = {2, 3}; Line(4) = {3, 4}; Line(5) = {4, 1};
Line(6) = {5, 6};
Curve Loop(1) = {1, 2, 3, 4, 5}; Plane Surface(1) = {1}; Curve{6} In Surface{1};
Physical Surface("plate", 1) = {1}; Physical Curve("slit", 4) = {6};
Physical Point("mouth", 5) = {5};
Mesh.MshFileVersion = 2.2;
)";

TEST(GmshMesher, KeepsTheMeshOfScriptsThatMeshThemselves) {
  if (!has_gmsh()) GTEST_SKIP() << "built without gmsh";
  const test::TemporaryDirectory directory;
  const auto mesh_of = [&](const std::string& more, int dim = 2) {
    const std::string path = (directory / "body.geo").string();
    test::write_text(path, square_with_slit + more + "\n");
    return mesh_geometry(path, dim, {});
  };
  const Mesh plain = mesh_of("");
  EXPECT_EQ(mesh_of("Mesh 2;").positions, plain.positions);
  EXPECT_EQ(mesh_of("Mesh 1;").num_cells(), plain.num_cells()) << "not yet meshed";
  EXPECT_EQ(mesh_of("Mesh 2; RefineMesh;").num_cells(), 4 * plain.num_cells());
  const Mesh slit = mesh_of(
      "Mesh 2; Plugin(Crack).Dimension = 1; Plugin(Crack).PhysicalGroup = 4;\n"
      "Plugin(Crack).OpenBoundaryPhysicalGroup = 5; Plugin(Crack).Run;");
  EXPECT_EQ(slit.num_cells(), plain.num_cells());
  // Two flanks of two lines each, which share the tip.
  ASSERT_EQ(plain.groups[1].points.size(), 3u);
  EXPECT_EQ(slit.groups[1].elements.size(), 4u);
  EXPECT_EQ(slit.num_points(), plain.num_points() + 2);
  // Part of the surfaces only: the others are meshed after the script.
  const Mesh two = mesh_of(
      "Mesh 2; Delete Physicals; Point(11) = {2, 0, 0, h}; Point(12) = {3, 0, 0, h};"
      "Point(13) = {3, 1, 0, h}; Line(11) = {11, 12}; Line(12) = {12, 13};"
      "Line(13) = {13, 11}; Curve Loop(11) = {11, 12, 13}; Plane Surface(2) = {11};");
  EXPECT_GT(two.num_cells(), plain.num_cells());
}

TEST(GmshMesher, RunsNoCommandsOfScriptsUnlessTrusted) {
  if (!has_gmsh()) GTEST_SKIP() << "built without gmsh";
  const test::TemporaryDirectory directory;
  const std::string written = (directory / "written").string();
  for (const std::string& command :
       {"SystemCall \"touch " + written + "\";", "Printf(\"x\") > \"" + written + "\";"}) {
    const std::string path = (directory / "body.geo").string();
    test::write_text(path, "SetFactory(\"OpenCASCADE\"); Disk(1) = {0, 0, 0, 1};\n" + command);
    EXPECT_THAT(refusal(path, {}), HasSubstr("--trust-geometry"));
    EXPECT_FALSE(std::filesystem::exists(written)) << command;
    EXPECT_GT(mesh_geometry(path, 2, {}, true).num_cells(), 0);
    EXPECT_TRUE(std::filesystem::remove(written)) << "this test would see the file";
  }
}

/// The meshes of the folder are those of their geometries.
TEST(GmshMesher, ReadsTheMeshesOfTheFolder) {
  const struct {
    const char* name;
    int dim;
    std::size_t groups;
  } files[] = {{"plate_with_hole", 2, 6},
               {"full_plate_with_hole", 2, 6},
               {"disc", 2, 3},
               {"l_shape", 2, 7},
               {"hollow_sphere", 3, 6}};
  for (const auto& [name, dim, groups] : files) {
    const Mesh mesh = load_mesh(meshes + name + ".msh", dim);
    EXPECT_EQ(mesh.groups.size(), groups) << name;
    if (!has_gmsh()) continue;
    const Mesh meshed = mesh_geometry(meshes + name + ".geo", dim, {});
    // Another version of gmsh may place a few points elsewhere.
    EXPECT_NEAR(meshed.num_cells(), mesh.num_cells(), 0.1 * mesh.num_cells()) << name;
  }
}

}  // namespace
}  // namespace perilink

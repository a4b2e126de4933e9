#include "model/body/host_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "base/error.hpp"
#include "model/from_case/configure.hpp"
#include "support/simplex_meshes.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

/// A plate of 16 by 8 with particles one apart; its elements are four by four.
Model plate(const std::string& more, const std::string& keys = "",
            const std::string& size = "spacings = 4\n") {
  const std::string text = R"(regions = [
  {name = "plate", x = [0, 16], y = [0, 8]},
  {name = "left", x = [0, 0], y = [0, 8]},
  {name = "corner", x = [13, 16], y = [0, 2]},
]
[body]
spacing = 1.0
horizon_ratio = 3
[[materials]]
region = "plate"
youngs_modulus = 10.0
fracture_energy = 0.1
[[supports]]
region = "left"
fix = ["x", "y"]
[[point_loads]]
at = [16, 8]
force = [1, 0]
)";
  return build_model(parse_case(text + more + "[elements]\n" + size + keys, "plate.toml"));
}

Index whole(const Model& model) {
  return static_cast<Index>(
      std::count(model.embedded->whole.begin(), model.embedded->whole.end(), 1));
}

TEST(HostModel, WholeEdgesThatAreHeldStayInElements) {
  const Model model = plate("");
  EXPECT_EQ(whole(model), 8);
  // Quadratic elements: a grid of 9 by 5 nodes, the left column held.
  EXPECT_EQ(model.unknowns.count, 2 * (9 * 5 - 5));
  EXPECT_EQ(model.embedded->free.count, 2 * (17 * 9 - 9));
  EXPECT_EQ(model.embedded->buffer_zone, model.horizon);
}

TEST(HostModel, RegionsOfParticlesHaveNoElements) {
  EXPECT_EQ(whole(plate("", "particles = [\"corner\"]\n")), 7);
  EXPECT_THROW(plate("", "regions = [\"corner\", \"left\"]\n"), InputError) << "no active host";
}

TEST(HostModel, PreCracksHaveFreeParticlesAroundThem) {
  // From the lower edge up the middle of the second column of elements, one and a half high.
  const Model model = plate("[[cracks]]\npoints = [[6.5, -1], [6.5, 5.5]]\n");
  EXPECT_EQ(whole(model), 6);
}

TEST(HostModel, ShortPreCracksAndThoseBesideAPlaneCountToo) {
  EXPECT_EQ(whole(plate("[[cracks]]\npoints = [[6.5, -1], [6.5, 0.5]]\n")), 7);
  // Between the rows y = 3 and y = 4: particles on both sides are free.
  EXPECT_EQ(whole(plate("[[cracks]]\npoints = [[5.2, 3.5], [6.8, 3.5]]\n")), 6);
}

TEST(HostModel, ElementsWithTooFewParticlesDoNotCarry) {
  // A single quadratic element of two by two spacings has a particle for every node.
  const Model model = plate("", "", "size = 2.0\n");
  EXPECT_EQ(model.unknowns.count, model.embedded->free.count);
}

/// Elements one and a half spacings high hold two rows of particles at most, however long they are:
/// quadratic ones have three of nodes.
TEST(HostModel, FlatElementsDoNotCarryHoweverManyParticlesTheyHold) {
  const test::TemporaryDirectory work;
  Mesh mesh;
  for (int row = 0; row <= 5; ++row) {
    for (const double x : {0.0, 64.0}) mesh.positions.insert(mesh.positions.end(), {x, 1.6 * row});
  }
  for (int row = 0; row < 5; ++row) {
    const Index a = 2 * row;
    mesh.cells.insert(mesh.cells.end(), {a, a + 1, a + 3, a, a + 3, a + 2});
  }
  std::ofstream(work / "flat.msh") << test::gmsh_text(mesh, {1, 1, 1}, {0, 0, 0});
  std::string text = R"(regions = [{name = "plate", x = [0, 64], y = [0, 8]}]
[body]
spacing = 1.0
horizon_ratio = 3
[[materials]]
region = "plate"
youngs_modulus = 10.0
fracture_energy = "infinite"
[[supports]]
region = "body"
fix = ["x"]
[[point_loads]]
at = [64, 8]
force = [0, 1]
[[springs]]
region = "plate"
stiffness = [0, 1]
[analysis]
type = "elastic"
[elements]
mesh = "flat.msh"
order = )";
  const auto elements = [&](const char* order) {
    return whole(build_model(parse_case(text + order, (work / "plate.toml").string())));
  };
  EXPECT_GT(elements("1\n"), 0);
  EXPECT_THROW(elements("2\n"), InputError) << "no active host";
}

/// The crack lies where the mesh of the body is three times as coarse as on average.
TEST(HostModel, PreCracksInCoarsePartsOfAMeshCountToo) {
  const test::TemporaryDirectory work;
  Mesh mesh;
  std::vector<double> columns;
  for (double x = 0.0; x < 8.0; x += 0.5) columns.push_back(x);
  for (double x = 8.0; x <= 20.0; x += 3.0) columns.push_back(x);
  for (const double x : columns) {
    for (int y = 0; y <= 16; ++y) mesh.positions.insert(mesh.positions.end(), {x, 0.5 * y});
  }
  for (Index c = 0; c + 1 < static_cast<Index>(columns.size()); ++c) {
    for (Index r = 0; r < 16; ++r) {
      const Index a = 17 * c + r;
      mesh.cells.insert(mesh.cells.end(), {a, a + 17, a + 18, a, a + 18, a + 1});
    }
  }
  std::ofstream(work / "body.msh") << test::gmsh_text(mesh, {1, 1, 1}, {0, 0, 0});
  const auto model = [&](const std::string& crack) {
    return build_model(parse_case(R"(regions = [{name = "plate", x = [0, 20], y = [0, 8]}]
[body]
mesh = "body.msh"
horizon = 6.1
[[materials]]
region = "plate"
youngs_modulus = 10.0
fracture_energy = "infinite"
[[supports]]
region = "body"
fix = ["x"]
[[point_loads]]
at = [20, 8]
force = [0, 1]
[[springs]]
region = "plate"
stiffness = [0, 1]
[analysis]
type = "elastic"
[elements]
size = 10.0
order = 1
)" + crack,
                                  (work / "plate.toml").string()));
  };
  const std::string crack = "[[cracks]]\npoints = [[12.5, -1], [12.5, 9]]\n";
  EXPECT_EQ(whole(model("")), 2);
  EXPECT_EQ(whole(model(crack)), 1) << "the crack divides one";
}

}  // namespace
}  // namespace perilink

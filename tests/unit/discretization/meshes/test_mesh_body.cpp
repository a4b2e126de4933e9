#include "discretization/meshes/mesh_body.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "support/simplex_meshes.hpp"

namespace perilink {
namespace {

using test::box_mesh;
using ::testing::DoubleEq;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Round-off of a few thousand additions of numbers of size one.
constexpr double round_off = 1e-13;

std::vector<Index> one_material(const Mesh& mesh) {
  return std::vector<Index>(static_cast<std::size_t>(mesh.num_cells()), 0);
}

std::string refusal(const Mesh& mesh, const std::vector<Index>& material) {
  try {
    make_mesh_body(mesh, material, 1.0);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

std::string refusal(const Mesh& mesh) { return refusal(mesh, one_material(mesh)); }

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Two triangles over the diagonal of the unit square; the first runs clockwise.
Mesh square_mesh() {
  Mesh mesh;
  mesh.positions = {0, 0, 1, 0, 1, 1, 0, 1};
  mesh.cells = {0, 2, 1, 0, 2, 3};
  return mesh;
}

TEST(MeshBody, SharesVolumesAsLinearShapeFunctionsDo) {
  const Body body = make_mesh_body(square_mesh(), std::vector<Index>{0, 0}, 3.0);
  // A third of triangles of area 1/2 and thickness 3.
  EXPECT_THAT(body.particles.volumes,
              ElementsAre(DoubleEq(1.0), DoubleEq(0.5), DoubleEq(1.0), DoubleEq(0.5)));
  EXPECT_THAT(body.particles.kind, Each(ParticleKind::solid));
  EXPECT_EQ(body.lattice.pattern, Pattern::irregular);
  EXPECT_DOUBLE_EQ(body.lattice.spacing, (4.0 + std::sqrt(2.0)) / 5.0);
  EXPECT_DOUBLE_EQ(body.lattice.cell_volume, 0.75);
  EXPECT_EQ(body.lattice.step, Vector3{});
}

TEST(MeshBody, DropsPointsThatNoCellUses) {
  Mesh mesh = square_mesh();
  mesh.positions.insert(mesh.positions.begin(), {7, 7});
  for (Index& corner : mesh.cells) ++corner;
  const Body body = make_mesh_body(mesh, std::vector<Index>{0, 0}, 1.0);
  EXPECT_THAT(body.particles.positions, ElementsAre(0, 0, 1, 0, 1, 1, 0, 1));
  EXPECT_THAT(body.cells.vertices, ElementsAre(0, 1, 2, 0, 2, 3));
}

class MeshBodyIn : public ::testing::TestWithParam<int> {};

TEST_P(MeshBodyIn, CellsRunTheRightWayRound) {
  const Mesh mesh = box_mesh(GetParam(), 3);
  const Body body = make_mesh_body(mesh, one_material(mesh), 1.0);
  ASSERT_EQ(body.cells.size(), mesh.num_cells());
  const int dim = GetParam();
  for (Index cell = 0; cell < body.cells.size(); ++cell) {
    const auto corners = body.cells.cell(cell);
    double e[3][3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 1}};
    for (int row = 0; row < dim; ++row) {
      for (int axis = 0; axis < dim; ++axis) {
        e[row][axis] = body.particles.position(corners[row + 1])[axis] -
                       body.particles.position(corners[0])[axis];
      }
    }
    const double determinant = e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                               e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                               e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
    EXPECT_GT(determinant, 0.0) << cell;
  }
}

TEST_P(MeshBodyIn, FillsTheBoxAndClosesItsSurface) {
  const int dim = GetParam();
  const Mesh mesh = box_mesh(dim, 4);
  const double thickness = dim == 2 ? 0.5 : 1.0;
  const Body body = make_mesh_body(mesh, one_material(mesh), thickness);
  EXPECT_NEAR(sum(body.particles.volumes), thickness, round_off);
  const Facets& facets = body.facets;
  EXPECT_EQ(facets.size(), dim == 2 ? 4 * 4 : 6 * 16 * 2);
  // Divergence theorem: the area vectors sum to zero, and with the centres to the volume times the
  // unit tensor.
  double total[3] = {};
  double moment[3][3] = {};
  for (Index f = 0; f < facets.size(); ++f) {
    ASSERT_TRUE(facets.on_surface(f));
    const Vector3 centre = facets.centre(f, body.particles.positions);
    for (int a = 0; a < dim; ++a) {
      total[a] += facets.area_vector(f)[a];
      for (int b = 0; b < dim; ++b) moment[a][b] += facets.area_vector(f)[a] * centre[b];
    }
  }
  for (int a = 0; a < dim; ++a) {
    EXPECT_NEAR(total[a], 0.0, round_off);
    for (int b = 0; b < dim; ++b) EXPECT_NEAR(moment[a][b], a == b ? thickness : 0.0, round_off);
  }
}

TEST_P(MeshBodyIn, FacesBetweenMaterialsPointFromTheLowerToTheHigher) {
  const int dim = GetParam();
  const Mesh mesh = box_mesh(dim, 2);
  std::vector<Region> halves(2);
  halves[0].box = {{0, 0, 0}, {1, 1, 1}};
  halves[1].box = {{0, 0, 0}, {0.5, 1, 1}};
  // The left half has the higher number.
  Mesh straight = mesh;
  for (Index i = 0; i < straight.num_points(); ++i) {  // the middle plane is a plane again
    double& x = straight.positions[static_cast<std::size_t>(i) * dim];
    x = std::round(2.0 * x) / 2.0;
  }
  const auto material = materials_of_cells(straight, halves, std::vector<Index>{0, 1});
  const Body body = make_mesh_body(straight, material, 1.0);
  double area[3] = {};
  for (Index f = 0; f < body.facets.size(); ++f) {
    if (body.facets.on_surface(f)) continue;
    EXPECT_EQ(body.facets.inside[f], 0);
    EXPECT_EQ(body.facets.outside[f], 1);
    for (int a = 0; a < dim; ++a) area[a] += body.facets.area_vector(f)[a];
  }
  EXPECT_NEAR(area[0], -1.0, round_off);
  EXPECT_NEAR(area[1], 0.0, round_off);
  for (Index i = 0; i < body.particles.size(); ++i) {
    EXPECT_EQ(body.particles.material[i], body.particles.position(i)[0] <= 0.5 ? 1 : 0)
        << "on the interface the higher number";
  }
}

INSTANTIATE_TEST_SUITE_P(TwoAndThreeDimensions, MeshBodyIn, ::testing::Values(2, 3));

TEST(MeshBody, LeavesOutCellsWithoutMaterial) {
  const Mesh mesh = square_mesh();
  const Body body = make_mesh_body(mesh, std::vector<Index>{no_index, 2}, 1.0);
  EXPECT_EQ(body.particles.size(), 3);
  EXPECT_EQ(body.cells.size(), 1);
  EXPECT_EQ(body.facets.size(), 3);
  EXPECT_THAT(body.particles.material, Each(2));
  EXPECT_THAT(refusal(mesh, {no_index, no_index}), HasSubstr("the body is empty"));
}

TEST(MeshBody, LaterMaterialsCountAndGroupsAndBoxesMix) {
  Mesh mesh = square_mesh();
  mesh.groups = {{"all", 2, {0, 1}, {0, 1, 2, 3}}};
  std::vector<Region> regions(2);
  regions[0].group = "all";
  regions[1].box = {{0.5, 0, 0}, {1, 0.5, 0}};  // holds the centre (2/3, 1/3) of the first
  EXPECT_THAT(materials_of_cells(mesh, regions, std::vector<Index>{0, 1}), ElementsAre(1, 0));
  std::swap(regions[0], regions[1]);
  EXPECT_THAT(materials_of_cells(mesh, regions, std::vector<Index>{0, 1}), ElementsAre(1, 1));
  regions.pop_back();
  EXPECT_THAT(materials_of_cells(mesh, regions, std::vector<Index>{0}), ElementsAre(0, no_index));
}

TEST(MeshBody, GroupsHoldParticlesAndFacetsOfTheSurface) {
  Mesh mesh = square_mesh();
  mesh.facets = {1, 0, 0, 2};  // the lower edge and the diagonal
  mesh.groups = {{"corner", 0, {}, {2}},
                 {"lower", 1, {0}, {0, 1}},
                 {"diagonal", 1, {1}, {0, 2}},
                 {"upper half", 2, {1}, {0, 2, 3}}};
  const Body body = make_mesh_body(mesh, std::vector<Index>{0, 0}, 1.0);
  ASSERT_EQ(body.groups.size(), 4u);
  EXPECT_EQ(body.groups[1].name, "lower");
  EXPECT_THAT(body.groups[0].particles, ElementsAre(2));
  EXPECT_THAT(body.groups[0].facets, ElementsAre());
  EXPECT_THAT(body.groups[1].particles, ElementsAre(0, 1));
  ASSERT_EQ(body.groups[1].facets.size(), 1u);
  const auto area = body.facets.area_vector(body.groups[1].facets[0]);
  EXPECT_DOUBLE_EQ(area[0], 0.0);
  EXPECT_DOUBLE_EQ(area[1], -1.0);
  EXPECT_THAT(body.groups[2].particles, ElementsAre(0, 2));
  EXPECT_THAT(body.groups[2].facets, ElementsAre()) << "inside the body";
  EXPECT_EQ(body.groups[3].facets.size(), 2u);
  for (const Index f : body.groups[3].facets) {
    EXPECT_LE(body.facets.area_vector(f)[0], 0.0);  // upper and left edge
    EXPECT_GE(body.facets.area_vector(f)[1], 0.0);
  }
}

TEST(MeshBody, RefusesFlatCells) {
  Mesh mesh = square_mesh();
  mesh.positions[4] = 0.5;
  mesh.positions[5] = 0.0;
  EXPECT_THAT(refusal(mesh), HasSubstr("is flat: it has no area"));
}

TEST(MeshBody, RefusesFacesOfThreeCells) {
  Mesh mesh = square_mesh();
  mesh.positions.insert(mesh.positions.end(), {-1, 5});
  mesh.cells.insert(mesh.cells.end(), {0, 2, 4});
  EXPECT_THAT(refusal(mesh), HasSubstr("the edge at (0.5, 0.5) belongs to 3 cells"));
}

TEST(MeshBody, RefusesFoldsAndCellsTwice) {
  Mesh mesh = square_mesh();
  // The second triangle lies on the same side of the diagonal as the first.
  mesh.positions[6] = 0.9;
  mesh.positions[7] = 0.1;
  EXPECT_THAT(refusal(mesh), HasSubstr("overlap"));
  mesh = square_mesh();
  mesh.cells.insert(mesh.cells.end(), {3, 2, 0});
  EXPECT_THAT(refusal(mesh), HasSubstr("belongs to 3 cells"));
  mesh.cells = {0, 2, 1, 2, 1, 0};
  EXPECT_THAT(refusal(mesh), HasSubstr("holds a cell twice"));
}

TEST(MeshBody, RefusesPartsThatOnlyTouch) {
  Mesh twice = square_mesh();  // the diagonal's ends once for each triangle
  twice.positions.insert(twice.positions.end(), {0, 0, 1, 1});
  twice.cells = {0, 2, 1, 4, 5, 3};
  EXPECT_THAT(refusal(twice), HasSubstr("are not joined"));

  Mesh hanging = square_mesh();  // the middle of the diagonal belongs to the cells on one side only
  hanging.positions.insert(hanging.positions.end(), {0.5, 0.5});
  hanging.cells = {0, 1, 2, 0, 4, 3, 4, 2, 3};
  EXPECT_THAT(refusal(hanging), HasSubstr("the vertex at (0.5, 0.5) lies on the side of a cell"));

  Mesh tetrahedra;  // the second one stands on a face of the first, with corners of its own
  tetrahedra.dim = 3;
  tetrahedra.positions = {0,   0,   0, 2, 0,   0, 0,   2, 0, 0, 0, 2,
                          0.1, 0.1, 0, 1, 0.1, 0, 0.1, 1, 0, 0, 0, -1};
  tetrahedra.cells = {0, 1, 2, 3, 4, 5, 6, 7};
  EXPECT_THAT(refusal(tetrahedra), HasSubstr("the vertex at (0.1, 0.1, 0)"));
}

TEST(MeshBody, KeepsCurvesAcrossItsCells) {
  Mesh mesh = square_mesh();
  mesh.positions.insert(mesh.positions.end(), {0.1, 0.3, 0.9, 0.3});
  mesh.facets = {4, 5, 5, 2, 0, 1};
  mesh.groups = {{"bar", 1, {0, 1}, {2, 4, 5}}, {"foot", 1, {2}, {0, 1}}};
  const Body body = make_mesh_body(mesh, one_material(mesh), 1.0);
  const Group& bar = body.groups[0];
  EXPECT_THAT(bar.line_points, ElementsAre(1, 1, 0, 0.1, 0.3, 0, 0.9, 0.3, 0));
  EXPECT_THAT(bar.lines, ElementsAre(1, 2, 2, 0));
  EXPECT_EQ(bar.loose, (Vector3{0.1, 0.3}));
  EXPECT_TRUE(bar.facets.empty());
  EXPECT_EQ(body.groups[1].facets.size(), 1u);
  EXPECT_FALSE(body.groups[1].loose);
}

TEST(MeshBody, KeepsCurvesInSpace) {
  Mesh mesh = box_mesh(3, 1);
  mesh.positions.insert(mesh.positions.end(), {0.5, 0.5, 0.5});
  mesh.lines = {0, 1, 0, 8};
  mesh.groups = {{"edge", 1, {0}, {0, 1}}, {"bar", 1, {1}, {0, 8}}};
  const Body body = make_mesh_body(mesh, one_material(mesh), 1.0);
  EXPECT_THAT(body.groups[0].particles, ElementsAre(0, 1));
  EXPECT_FALSE(body.groups[0].loose);
  EXPECT_THAT(body.groups[1].lines, ElementsAre(0, 1));
  EXPECT_EQ(body.groups[1].loose, (Vector3{0.5, 0.5, 0.5}));
}

TEST(MeshBody, TellsElementsOfGroupsThatAreNoSideOfACell) {
  Mesh mesh = square_mesh();
  mesh.facets = {1, 3};
  mesh.groups = {{"other diagonal", 1, {0}, {1, 3}}};
  EXPECT_EQ(make_mesh_body(mesh, one_material(mesh), 1.0).groups[0].loose, (Vector3{1.0, 0.0}));
  Mesh box = box_mesh(3, 1);
  box.facets = {1, 2, 4};  // across the diagonal of the cube
  box.groups = {{"across", 2, {0}, {1, 2, 4}}};
  EXPECT_EQ(make_mesh_body(box, one_material(box), 1.0).groups[0].loose, (Vector3{1.0, 0.0}));
}

}  // namespace
}  // namespace perilink

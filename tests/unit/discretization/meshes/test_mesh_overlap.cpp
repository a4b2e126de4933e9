#include "discretization/meshes/mesh_overlap.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "discretization/meshes/mesh_body.hpp"
#include "support/simplex_meshes.hpp"

namespace perilink {
namespace {

using test::box_mesh;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// A second mesh beside or in the first, its corners written anew.
Mesh with(Mesh mesh, const Mesh& other, const Vector3& shift, double scale = 1.0) {
  const Index first = mesh.num_points();
  for (std::size_t k = 0; k < other.positions.size(); ++k) {
    mesh.positions.push_back(scale * other.positions[k] + shift[k % other.dim]);
  }
  for (const Index corner : other.cells) mesh.cells.push_back(first + corner);
  return mesh;
}

/// Whether the body is made, or its refusal.
std::string answer(const Mesh& mesh) {
  try {
    make_mesh_body(mesh, std::vector<Index>(static_cast<std::size_t>(mesh.num_cells()), 0), 1.0);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "made";
}

class MeshOverlapIn : public ::testing::TestWithParam<int> {};

TEST_P(MeshOverlapIn, TwoBoxesMeshedApartThatLieInOneAnother) {
  const Mesh box = box_mesh(GetParam(), 3);
  // By a half of a cell and more, by a corner, by a thousandth of a cell.
  for (const Vector3& shift : {Vector3{0.51, 0, 0}, {0.9, 0.9, 0.9}, {1 - 0.0003, 0, 0}}) {
    EXPECT_THAT(answer(with(box, box, shift)), HasSubstr("overlap")) << shift[0];
  }
}

TEST_P(MeshOverlapIn, CellsWrittenTwiceWithOtherCorners) {
  const Mesh box = box_mesh(GetParam(), 2);
  EXPECT_THAT(answer(with(box, box, {})), HasSubstr("overlap"));
}

TEST_P(MeshOverlapIn, PartInsideOfOneCell) {
  // No cell at the surface of the large part is met.
  const Mesh box = box_mesh(GetParam(), 5);
  EXPECT_THAT(answer(with(box, box_mesh(GetParam(), 1), {0.47, 0.47, 0.47}, 0.02)),
              HasSubstr("overlap"));
  EXPECT_THAT(answer(with(box_mesh(GetParam(), 1), box, {0.47, 0.47, 0.47}, 0.02)),
              HasSubstr("overlap"));
}

TEST_P(MeshOverlapIn, NotPartsThatTouchOrStandApart) {
  const Mesh box = box_mesh(GetParam(), 1);
  // Face to face, as along a crack, and corner to corner; both are refused as not joined.
  EXPECT_THAT(answer(with(box, box, {1, 0, 0})), HasSubstr("not joined"));
  EXPECT_THAT(answer(with(box, box, {1, 1, 1})), HasSubstr("not joined"));
  EXPECT_EQ(answer(with(box, box, {1.001, 0, 0})), "made");
  EXPECT_EQ(answer(box_mesh(GetParam(), 6)), "made");
}

TEST_P(MeshOverlapIn, NotPartsFarFromTheOrigin) {
  Mesh far = box_mesh(GetParam(), 2);
  for (double& x : far.positions) x = 1e-3 * x + 1e3;  // round-off is 1e-10 of a cell
  EXPECT_EQ(answer(far), "made");
  EXPECT_THAT(answer(with(far, far, {0.00051, 0, 0})), HasSubstr("overlap"));
}

INSTANTIATE_TEST_SUITE_P(Dimensions, MeshOverlapIn, ::testing::Values(2, 3));

TEST(MeshOverlap, RingThatWindsRoundIntoItself) {
  // A strip of squares around the origin, over one turn and a quarter; over three quarters.
  const auto ring = [](double turns) {
    Mesh mesh;
    constexpr int steps = 40;
    for (int i = 0; i <= steps; ++i) {
      const double angle = 2.0 * M_PI * turns * i / steps;
      for (const double radius : {1.0, 1.5}) {
        mesh.positions.insert(mesh.positions.end(),
                              {radius * std::cos(angle), radius * std::sin(angle)});
      }
      const Index at = 2 * i;
      if (i < steps) mesh.cells.insert(mesh.cells.end(), {at, at + 1, at + 3, at, at + 3, at + 2});
    }
    return mesh;
  };
  EXPECT_EQ(answer(ring(0.75)), "made");
  EXPECT_THAT(answer(ring(1.25)), HasSubstr("overlap"));
}

TEST(MeshOverlap, NamesTheElementsAsTheirFileDoes) {
  Mesh mesh = with(box_mesh(2, 1), box_mesh(2, 1), {0.51, 0});
  mesh.cell_tags = {11, 12, 13, 14};
  // By hand: the upper triangle of the first square reaches to x = 1 at y = 1, the lower one below.
  EXPECT_THAT(answer(mesh), AllOf(HasSubstr("elements 11 and 1"), HasSubstr("BooleanFragments")));
}

}  // namespace
}  // namespace perilink

#include "app/plot/plot_body.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "support/cracked_field.hpp"

namespace perilink {
namespace {

using test::CrackedPlate;
using test::make_cracked_field;

TEST(PlotBody, ReadsAFieldFile) {
  const PlotBody body = read_body(make_cracked_field({}, true), "plate.vtu");
  EXPECT_EQ(body.size(), 25 * 8 + 25 + 25);
  EXPECT_EQ(body.broken_bonds.size(), 4u);
  EXPECT_EQ(body.segments.size(), 24u);
  EXPECT_EQ(body.kind.back(), 2);
  EXPECT_EQ(body.spacing, 2.0);
}

/// Those that carry a beam, with two corners, are no cracks.
TEST(PlotBody, LinesOfElementsAreElements) {
  VtuGrid grid = make_cracked_field({}, true);
  grid.types.push_back(VtuCell::line);
  grid.connectivity.insert(grid.connectivity.end(), {0, 3});
  grid.offsets.push_back(grid.offsets.back() + 2);
  for (VtuArray& field : grid.cell_data) field.values.push_back(0.0);
  for (VtuArray& field : grid.cell_data) {
    if (field.name == "element") field.values.back() = 4.0;
  }
  const PlotBody body = read_body(grid, "beam.vtu");
  EXPECT_EQ(body.broken_bonds.size(), 4u);
  ASSERT_EQ(body.elements.rows(), 1);
  EXPECT_EQ(body.elements.row(0)[1], 3);
}

TEST(PlotBody, NamesTheArrayThatIsMissing) {
  VtuGrid grid = make_cracked_field({}, false);
  grid.point_data.erase(grid.point_data.begin() + 1);
  try {
    read_body(grid, "plate.vtu");
    FAIL() << "accepted a file without damage";
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("plate.vtu: array 'damage'"), std::string::npos);
  }
  grid = make_cracked_field({}, false);
  grid.field_data.clear();
  EXPECT_THROW(read_body(grid, "plate.vtu"), FileError);
}

TEST(PlotBody, SizesAreThoseOfTheVolumesOffTheSquareLattice) {
  VtuGrid grid = make_cracked_field({.hexagonal = true}, false);
  const std::size_t count = grid.points.size() / 3;
  EXPECT_EQ(read_body(grid, "").sizes, std::vector<double>(count, 2.0)) << "a file without volumes";
  // A hexagon of the area sqrt(3)/2 h^2 has neighbours at h = 2; the first particle has a quarter
  // of it.
  grid.field_data.push_back({"thickness", 0.5});
  grid.point_data.push_back({"volume", 1, std::vector<double>(count, 0.5 * std::sqrt(0.75) * 4.0)});
  grid.point_data.back().values[0] *= 0.25;
  const PlotBody body = read_body(grid, "");
  EXPECT_NEAR(body.sizes[0], 1.0, 1e-12);
  EXPECT_NEAR(body.sizes[1], 2.0, 1e-12);
  VtuGrid square = make_cracked_field({}, false);
  square.point_data.push_back({"volume", 1, std::vector<double>(count, 0.1)});
  EXPECT_EQ(read_body(square, "").sizes, std::vector<double>(count, 2.0));
}

TEST(PlotBody, StressIsThatOfVonMises) {
  VtuGrid grid = make_cracked_field({.nx = 3, .ny = 1}, false);
  EXPECT_TRUE(read_body(grid, "").stress.empty());
  // Tension 5 along y; pressure 7; shear 2 in one plane: sqrt(3) times as much.
  grid.point_data.push_back(
      {"stress", 6, {0, 5, 0, 0, 0, 0, -7, -7, -7, 0, 0, 0, 0, 0, 0, 0, 2, 0}});
  const std::vector<double> stress = read_body(grid, "").stress;
  ASSERT_EQ(stress.size(), 3u);
  EXPECT_DOUBLE_EQ(stress[0], 5.0);
  EXPECT_DOUBLE_EQ(stress[1], 0.0);
  EXPECT_DOUBLE_EQ(stress[2], 2.0 * std::sqrt(3.0));
}

TEST(PlotBody, AutomaticScaleShowsAboutATwelfthOfTheSize) {
  PlotBody body = read_body(make_cracked_field({}, false), "");
  const double size = 24 * 2.0;
  const double largest = 8e-4;  // 1e-4 times the height 8 of the crack tip
  const double share = automatic_scale(body) * largest / size;
  EXPECT_GT(share, 0.04);  // 1-2-5 steps are at most a factor 2.5 apart, 10 % the upper end
  EXPECT_LE(share, 0.1 + 1e-9);

  const double scale = automatic_scale(body);
  body.displacements[3] = {1e6, 0.0, 0.0};
  body.damage[3] = 1.0;  // a crumb that flew away
  EXPECT_EQ(automatic_scale(body), scale);
  body.displacements.assign(body.displacements.size(), {});
  EXPECT_EQ(automatic_scale(body), 1.0);
}

TEST(PlotBody, TellsSquareLatticesFromOthers) {
  EXPECT_TRUE(on_square_lattice(read_body(make_cracked_field({}, true), "")));
  EXPECT_FALSE(on_square_lattice(read_body(make_cracked_field({.hexagonal = true}, false), "")));
}

TEST(PlotBody, ViewIsARotation) {
  const Vector3 x = view({1, 0, 0}, 3), y = view({0, 1, 0}, 3), z = view({0, 0, 1}, 3);
  const auto dot = [](const Vector3& a, const Vector3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  EXPECT_NEAR(dot(x, x), 1.0, 1e-15);
  EXPECT_NEAR(dot(x, y), 0.0, 1e-15);
  EXPECT_NEAR(dot(y, z), 0.0, 1e-15);
  EXPECT_GT(z[1], 0.9);  // up is up
  EXPECT_EQ(view({3, 4, 0}, 2), (Vector3{3, 4, 0}));
}

}  // namespace
}  // namespace perilink

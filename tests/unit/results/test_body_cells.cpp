#include "results/body_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "discretization/bonds.hpp"
#include "support/replaced.hpp"
#include "support/strip_case.hpp"

namespace perilink {
namespace {

/// Model of the strip of 5 by 9 particles with changed text.
Model strip(const std::string& from = "thickness", const std::string& to = "thickness") {
  return build_model(parse_case(replaced(test::strip_text, from, to), "strip.toml"));
}

Csr cells_of(const Model& model, Secants secants = {}) {
  const Network& network = model.network;
  return body_cells(network, model.lattice, model.cells,
                    bonds_of_particles(network.bonds, network.particles.size()), secants);
}

/// Area of the cells in the plane, by the shoelace formula; negative corners turn clockwise.
double area_of(const Model& model, const Csr& cells) {
  double area = 0.0;
  for (Index k = 0; k < cells.rows(); ++k) {
    const auto corners = cells.row(k);
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const auto a = model.network.particles.position(corners[c]);
      const auto b = model.network.particles.position(corners[(c + 1) % corners.size()]);
      area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
  }
  return area;
}

TEST(BodyCells, SquaresFillALattice) {
  const Model model = strip();
  const Csr cells = cells_of(model);
  EXPECT_EQ(cells.rows(), 4 * 8);
  EXPECT_EQ(cells.values.size(), 4u * 4 * 8);
  EXPECT_NEAR(area_of(model, cells), 40.0 * 80.0, 1e-9);
}

TEST(BodyCells, TrianglesFillTheInsideOfAHexagonalLattice) {
  const Model model = strip("spacing = 10.0", "spacing = 10.0\npattern = \"hexagonal\"");
  const Csr cells = cells_of(model);
  EXPECT_EQ(cells.values.size(), 3 * static_cast<std::size_t>(cells.rows()));
  EXPECT_GT(area_of(model, cells), 0.8 * 40.0 * 80.0);
  EXPECT_LT(area_of(model, cells), 40.0 * 80.0 + 1e-9);
}

TEST(BodyCells, CellsWithABrokenSideAreLeftOut) {
  const Model model = strip();
  const Network& network = model.network;
  std::vector<double> secants(static_cast<std::size_t>(network.num_elements()), 1.0);
  // All bonds between the fourth and the fifth row: a crack through the strip.
  for (Index e = 0; e < network.num_elements(); ++e) {
    const double low = network.particles.position(network.bonds.first[e])[1];
    const double high = network.particles.position(network.bonds.second[e])[1];
    if (std::min(low, high) < 35.0 && std::max(low, high) > 35.0) secants[e] = 0.0;
  }
  const Csr cells = cells_of(model, secants);
  EXPECT_EQ(cells.rows(), 4 * 7);
  for (Index k = 0; k < cells.rows(); ++k) {
    std::set<bool> sides;
    for (const Index i : cells.row(k)) sides.insert(network.particles.position(i)[1] > 35.0);
    EXPECT_EQ(sides.size(), 1u);
  }
}

TEST(BodyCells, APreCrackIsAGap) {
  const Model model =
      strip("[[supports]]", "[[cracks]]\npoints = [[-1, 45], [21, 45]]\n[[supports]]");
  EXPECT_EQ(cells_of(model).rows(), 4 * 8 - 3);
}

TEST(BodyCells, HexahedraFillABlock) {
  const Model model = build_model(parse_case(R"([body]
problem = "three_dimensional"
spacing = 1.0
horizon = 3.01
[[regions]]
name = "block"
x = [0, 4]
y = [0, 3]
z = [0, 2]
[[regions]]
name = "end"
x = [0, 0]
y = [0, 3]
z = [0, 2]
[[materials]]
region = "block"
youngs_modulus = 100.0
fracture_energy = "infinite"
[[supports]]
region = "end"
fix = ["x", "y", "z"]
[[loads]]
region = "block"
force = [1, 0, 0]
[analysis]
type = "elastic"
)",
                                             "block.toml"));
  const Csr cells = cells_of(model);
  EXPECT_EQ(cells.rows(), 4 * 3 * 2);
  ASSERT_EQ(cells.values.size(), 8u * 24);
  const auto at = [&](std::size_t corner) {
    return model.network.particles.position(cells.row(0)[corner]);
  };
  EXPECT_NEAR(at(6)[0] - at(0)[0], 1.0, 1e-12);
  EXPECT_NEAR(at(6)[1] - at(0)[1], 1.0, 1e-12);
  EXPECT_NEAR(at(6)[2] - at(0)[2], 1.0, 1e-12);
  EXPECT_NEAR(at(3)[1] - at(0)[1], 1.0, 1e-12);
  EXPECT_NEAR(at(3)[0] - at(0)[0], 0.0, 1e-12);
}

}  // namespace
}  // namespace perilink

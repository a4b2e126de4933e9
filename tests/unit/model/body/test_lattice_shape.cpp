#include "model/body/lattice_shape.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "base/error.hpp"
#include "model/from_case/lattice_case.hpp"
#include "support/gmsh_texts.hpp"
#include "support/program_cases.hpp"
#include "support/replaced.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;

const Region& region_of(const CaseFile& input, const std::string& name) {
  for (const Region& region : input.regions) {
    if (region.name == name) return region;
  }
  throw std::invalid_argument(name);
}

constexpr const char* round_regions = R"(
[[regions]]
name = "disc"
center = [1, 0.5]
radius = 0.3
)";

TEST(LatticeShape, HolesAreCutOutOfTheRegions) {
  const std::string text = replaced(test::lattice_strip_case() + round_regions,
                                    "region = \"strip\"", "region = \"strip\"\nholes = [\"disc\"]");
  const CaseFile input = parse_case(text, "");
  const LatticeShape shape(input);
  EXPECT_TRUE(shape.holds({0.1, 0.5, 0.0}));
  EXPECT_FALSE(shape.holds({1.0, 0.5, 0.0}));
  EXPECT_FALSE(shape.holds({1.2, 0.7, 0.0}));
  EXPECT_TRUE(shape.holds({1.3, 0.5, 0.0})) << "the rim of a hole belongs to the body";
  EXPECT_FALSE(shape.holds({2.1, 0.5, 0.0}));
  EXPECT_TRUE(shape.test_of(region_of(input, "disc"), "")({1.0, 0.5, 0.0}));
}

TEST(LatticeShape, DiscsAreFilled) {
  const std::string text = replaced(test::lattice_strip_case() + round_regions,
                                    "region = \"strip\"", "regions = [\"disc\", \"left side\"]");
  const CaseFile input = parse_case(text, "");
  const LatticeShape shape(input);
  EXPECT_TRUE(shape.holds({1.2, 0.7, 0.0}));
  EXPECT_FALSE(shape.holds({1.25, 0.75, 0.0}));
  EXPECT_NEAR(shape.box().lower[0], 0.0, 1.1e-7);
  EXPECT_NEAR(shape.box().upper[0], 1.3, 1.1e-7) << "a millionth of the spacing 0.1";
}

/// Particles of a lattice cut to a disc fill its area, cell by cell, except for the rim.
TEST(LatticeShape, TheLatticeOfADiscHasItsArea) {
  std::string text = replaced(test::lattice_strip_case(0.02), "x = [0, 2]\ny = [0, 1]",
                              "center = [0.5, 0.5]\nradius = 0.5");
  text = replaced(text, "x = [0, 0.1]", "x = [-1, 0.1]");
  text = replaced(text, "x = [1.9, 2]", "x = [0.9, 1]");
  const ExplicitCase disc = build_explicit_case(parse_case(text, ""));
  const LatticeRows& lattice = disc.model.lattice;
  const double area = lattice.particles() * lattice.cell_volume;
  // Gauss' circle problem: the error is below the rim's length times a cell's diameter.
  EXPECT_NEAR(area, 0.25 * 3.14159265, 3.1416 * 0.02 / std::sqrt(3.0) * 2.0 * 0.3);
}

/// A case whose body is the square [0, 2] x [0, 2] of a mesh.
class LatticeOfMesh : public ::testing::Test {
 protected:
  LatticeOfMesh() { test::write_text(directory_ / "body.msh", test::square_mesh); }

  CaseFile parse(const std::string& text) const {
    return parse_case(text, (directory_ / "case.toml").string());
  }
  std::string text() const {
    std::string text =
        replaced(test::lattice_strip_case(), "spacing = 0.1", "spacing = 0.1\nmesh = \"body.msh\"");
    return replaced(text, "x = [0, 2]\ny = [0, 1]", "group = \"plate\"");
  }
  std::string refusal(const std::string& text) const {
    try {
      build_explicit_case(parse(text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  test::TemporaryDirectory directory_;
};

TEST_F(LatticeOfMesh, FillsTheCellsOfTheMaterial) {
  const CaseFile input = parse(text());
  const LatticeShape shape(input);
  EXPECT_TRUE(shape.holds({2.0, 2.0, 0.0}));
  EXPECT_TRUE(shape.holds({0.3, 1.9, 0.0}));
  EXPECT_FALSE(shape.holds({2.01, 1.0, 0.0}));
  EXPECT_NEAR(shape.box().upper[1], 2.0, 1.1e-7);
  const LatticeRows lattice = build_explicit_case(input).model.lattice;
  const Index rows = 1 + static_cast<Index>(2.0 / (0.05 * std::sqrt(3.0)));
  EXPECT_EQ(lattice.particles(), 21 * ((rows + 1) / 2) + 20 * (rows / 2)) << "those of a box";
}

TEST_F(LatticeOfMesh, HolesAreCutOutOfCells) {
  const CaseFile input = parse(replaced(text() + round_regions, "region = \"strip\"",
                                        "region = \"strip\"\nholes = [\"disc\"]"));
  const LatticeShape shape(input);
  EXPECT_FALSE(shape.holds({1.0, 0.5, 0.0}));
  EXPECT_TRUE(shape.holds({1.0, 0.9, 0.0}));
}

TEST_F(LatticeOfMesh, GroupsOfCellsSelectParticles) {
  const CaseFile input = parse(text() + "\n[[regions]]\nname = \"all\"\ngroup = \"plate\"\n");
  const PointTest test = LatticeShape(input).test_of(region_of(input, "all"), "");
  EXPECT_TRUE(test({1.0, 1.0, 0.0}));
  EXPECT_FALSE(test({3.0, 1.0, 0.0}));
}

/// An eighth of a hollow sphere between the radii 1 and 2, of tetrahedra with edges of 0.45.
TEST_F(LatticeOfMesh, FillsTetrahedra) {
  std::string text =
      replaced(test::lattice_bar_case(), "spacing = 0.25",
               "spacing = 0.1\nmesh = \"" PERILINK_SOURCE_DIR "/meshes/hollow_sphere.msh\"");
  text = replaced(text, "x = [0, 1]\ny = [0, 2]\nz = [0, 1]", "group = \"sphere\"");
  text =
      replaced(text, "x = [0, 1]\ny = [0, 0.2]\nz = [0, 1]", "center = [1.5, 0, 0]\nradius = 0.5");
  const LatticeRows lattice = build_explicit_case(parse(text)).model.lattice;
  for (const Index slot : lattice.particle_slot) {
    double square = 0.0;
    for (int a = 0; a < 3; ++a) square += std::pow(lattice.positions[lattice.at(a, slot)], 2);
    // Chords of the inner sphere run below it by half the square of half an edge, 0.025.
    EXPECT_GT(std::sqrt(square), 0.95);
    EXPECT_LT(std::sqrt(square), 2.0 + 1e-6);
  }
  // Half a layer more on each of the three plane faces, where lattice planes lie in x, y, z = 0.
  const double volume = 7.0 / 6.0 * std::numbers::pi, faces = 3.0 * 0.75 * std::numbers::pi;
  const double layer = 0.1 / std::numbers::sqrt2;
  EXPECT_NEAR(lattice.particles() * lattice.cell_volume, volume + 0.5 * faces * layer,
              0.03 * volume);
}

TEST_F(LatticeOfMesh, RefusesWhatDoesNotSuitTheMesh) {
  EXPECT_THAT(refusal(replaced(text(), "x = [0, 0.1]\ny = [0, 1]", "group = \"lower\"")),
              testing::AllOf(HasSubstr("supports[1].region"),
                             HasSubstr("is a group of lines, which contain no particles"),
                             HasSubstr("name a physical surface, or give a box")));
  EXPECT_THAT(refusal(replaced(text(), "group = \"plate\"", "group = \"lower\"")),
              HasSubstr("is a group of lines, which contain no material"));
  EXPECT_THAT(refusal(replaced(text(), "group = \"plate\"", "group = \"Plate\"")),
              HasSubstr("has no such group"));
  const std::string all_hole = "\n[[regions]]\nname = \"all\"\ngroup = \"plate\"\n";
  EXPECT_THAT(refusal(replaced(text() + all_hole, "region = \"strip\"",
                               "region = \"strip\"\nholes = [\"all\"]")),
              HasSubstr("body.mesh: there is no cell"));
  EXPECT_THAT(refusal(replaced(text(), "body.msh", "other.msh")), HasSubstr("cannot be opened"));
}

}  // namespace
}  // namespace perilink

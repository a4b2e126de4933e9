#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "discretization/lattices/beam_body.hpp"
#include "support/joint_bodies.hpp"
#include "support/small_networks.hpp"

// Networks of elastic analyses have no limits but otherwise equal networks that can break.

namespace perilink {
namespace {

using namespace test;

void expect_same_without_limits(const Body& body, NetworkInput input) {
  const Network breakable = build_network(body, input);
  input.elastic = true;
  const Network elastic = build_network(body, input);
  Index limited = 0;
  for (Index e = 0; e < breakable.num_elements(); ++e) limited += breakable.has_limit(e) ? 1 : 0;
  EXPECT_GT(limited, 0);
  EXPECT_TRUE(elastic.critical_stretch.empty());
  EXPECT_TRUE(elastic.bending_ratio.empty());
  EXPECT_FALSE(elastic.has_limit(0));
  EXPECT_FALSE(elastic.has_limit(elastic.num_elements() - 1));
  EXPECT_EQ(elastic.bonds.first, breakable.bonds.first);
  EXPECT_EQ(elastic.bonds.second, breakable.bonds.second);
  EXPECT_EQ(elastic.stiffness, breakable.stiffness);
  EXPECT_EQ(elastic.bending, breakable.bending);
  EXPECT_EQ(elastic.inflection, breakable.inflection);
  EXPECT_EQ(elastic.hinged, breakable.hinged);
  EXPECT_EQ(elastic.facets.shares, breakable.facets.shares);
  EXPECT_EQ(elastic.first_bar_element, breakable.first_bar_element);
}

TEST(WithoutLimits, JointsAreTheSame) {
  for (const JointCase& joint :
       {JointCase{"plane", Pattern::rectangular, 2, 4.0, 3.0},
        JointCase{"space", Pattern::cubic, 3, 4.0, 2.0},
        JointCase{"mesh", Pattern::irregular, 2, 4.0, 3.0},
        JointCase{"frames", Pattern::rectangular, 2, 4.0, 3.0, std::array{0.1, 0.2}},
        JointCase{"frames_on_mesh", Pattern::irregular, 2, 4.0, 3.0, std::array{0.1, 0.2}}}) {
    SCOPED_TRACE(joint.name);
    JointBody tough(joint, 8);
    for (SolidMaterial& material : tough.input.materials) material.fracture_energy = 0.02;
    expect_same_without_limits(tough.body, tough.input);
  }
}

TEST(WithoutLimits, BarsThatYieldAreTheSame) {
  for (const bool embedded : {false, true}) {
    const LatticeInput lattice = body_input(rectangular, 8);
    NetworkInput input = network_input(lattice);
    RebarLine bar{{0.1, 0.43, 0.0}, {0.9, 0.57, 0.0}};
    bar.embedded = embedded;
    input.bars = {bar};
    BarMaterial material{200.0, 0.01, 0.5};
    material.bond.perimeter = 0.4;
    material.bond.curve = ForceCurve{{{0.01, 3.0}, {0.1, 3.0}}};
    input.bar_materials = {material};
    expect_same_without_limits(make_body(lattice), input);
  }
}

TEST(WithoutLimits, LargeBoxesAreTheSame) {
  LatticeInput lattice = body_input({"", Pattern::cubic, Surface::calibrated}, 16);
  lattice.horizon = 2.0 * lattice.spacing;
  NetworkInput input = network_input(lattice);
  input.solid = lattice.solid;
  expect_same_without_limits(make_body(lattice), input);
}

TEST(WithoutLimits, GluedCellsAreTheSame) {
  const Mesh mesh = box_mesh(2, 6);
  const std::vector<Index> material(static_cast<std::size_t>(mesh.num_cells()), 0);
  std::vector<std::uint8_t> tied(material.size(), 0);
  for (std::size_t cell = 0; cell < tied.size() / 2; ++cell) tied[cell] = 1;
  Body body = make_mesh_body(mesh, material, 1.0, tied);
  body.lattice.surface = Surface::calibrated;
  NetworkInput input;
  input.critical_stretch = Constants::continuum;
  input.horizon = 3.0 * body.lattice.spacing;
  input.materials = {{1000.0, 1.0}};
  expect_same_without_limits(body, input);
}

TEST(WithoutLimits, BeamsAreTheSame) {
  LatticeInput lattice;
  lattice.spacing = 1.0;
  lattice.thickness = 0.5;
  lattice.solid = {{{0, -1, 0}, {9, 1, 0}}};
  lattice.material = {0};
  NetworkInput input;
  input.model = BondModel::micropolar;
  input.thickness = lattice.thickness;
  input.horizon = 3.0;
  input.materials = {{4.0, 0.03}};
  expect_same_without_limits(make_beam_body(lattice), input);
}

}  // namespace
}  // namespace perilink

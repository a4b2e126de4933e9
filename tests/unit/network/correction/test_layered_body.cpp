#include "network/correction/layered_body.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "discretization/lattices/make_body.hpp"
#include "material/critical_stretch.hpp"
#include "network/builder/network_builder.hpp"

namespace perilink {
namespace {

/// Two squares of eight spacings, the upper one three times as stiff, with bonds as they are before
/// calibration.
struct TwoSquares {
  Body body, plain;
  NetworkInput input;
  Network network;
  Joint joint;

  explicit TwoSquares(BondModel model = BondModel::bond_based) {
    LatticeInput lattice;
    lattice.surface = Surface::calibrated;
    lattice.spacing = 0.125;
    lattice.horizon = 0.25;
    lattice.solid = {{{0, 0, 0}, {1, 1, 1}}, {{0, 1, 0}, {1, 2, 1}}};
    lattice.material = {0, 1};
    body = make_body(lattice);
    input.solid = lattice.solid;
    input.horizon = lattice.horizon;
    input.materials = {{1.0}, {3.0}};
    input.model = model;
    if (model == BondModel::micropolar) {
      input.materials[0].poissons_ratio = 0.05;
      input.materials[1].poissons_ratio = 0.15;
    }
    plain = body;
    plain.lattice.surface = Surface::none;
    network = build_network(plain, input);
    joint = *find_joint(
        body.facets, body.particles,
        {lame_constants(input, input.materials[0]), lame_constants(input, input.materials[1])},
        lattice.spacing);
  }
  double height(Index i) const { return body.particles.position(i)[1]; }
};

TEST(LayeredBody, ALayerIsABodyOfOneMaterialWithGluedFaces) {
  const TwoSquares squares;
  for (const std::size_t k : {0, 1}) {
    const LayerBody layer =
        cut_layer(squares.body, squares.input, squares.network, squares.joint, k);
    const Particles& particles = layer.body.particles;
    EXPECT_EQ(particles.size(), 81);
    const double volume = std::accumulate(particles.volumes.begin(), particles.volumes.end(), 0.0);
    EXPECT_NEAR(volume, 1.0, 1e-12);
    for (const Index m : particles.material) EXPECT_EQ(m, squares.joint.layers[k]);
    const Facets& facets = layer.network.facets;
    EXPECT_EQ(facets.size(), 32);
    Vector3 closed{};
    Index tied = 0;
    for (Index f = 0; f < facets.size(); ++f) {
      EXPECT_TRUE(facets.on_surface(f));
      tied += facets.is_tied(f) ? 1 : 0;
      for (int a = 0; a < 2; ++a) closed[a] += facets.area_vector(f)[a];
    }
    EXPECT_EQ(tied, 8);
    EXPECT_NEAR(std::hypot(closed[0], closed[1]), 0.0, 1e-12);
  }
}

/// Those in the plane, too, whose particles belong to the other material.
TEST(LayeredBody, BondsBreakAsTheContinuumOfTheirLayer) {
  TwoSquares squares;
  squares.input.materials[0].fracture_energy = 1.0;
  squares.input.materials[1].fracture_energy = 5.0;
  for (const std::size_t k : {0, 1}) {
    const LayerBody layer =
        cut_layer(squares.body, squares.input, squares.network, squares.joint, k);
    const SolidMaterial& own = squares.input.materials[squares.joint.layers[k]];
    const double stretch = continuum_critical_stretch(
        squares.input.problem, own.fracture_energy,
        moduli_of(squares.body, squares.input, own).micromodulus, squares.input.horizon, 1.0);
    for (const double s : layer.network.critical_stretch) EXPECT_NEAR(s, stretch, 1e-15);
  }
}

/// Bonds with moments end at the plane in hinges, and have the moduli of their layer.
TEST(LayeredBody, ParticlesInThePlaneDoNotTurn) {
  const TwoSquares squares(BondModel::micropolar);
  for (const std::size_t k : {0, 1}) {
    const LayerBody layer =
        cut_layer(squares.plain, squares.input, squares.network, squares.joint, k);
    const Network& own = layer.network;
    ASSERT_EQ(own.hinged.size(), own.bending.size());
    for (Index b = 0; b < own.bonds.size(); ++b) {
      const Index i = layer.particle_of[own.bonds.first[b]];
      const Index j = layer.particle_of[own.bonds.second[b]];
      const auto in_plane = [&](Index p) { return std::abs(squares.height(p) - 1.0) < 1e-9; };
      EXPECT_EQ((own.hinged[b] & first_end) != 0, in_plane(i));
      EXPECT_EQ((own.hinged[b] & second_end) != 0, in_plane(j));
    }
    const Index inner = own.bonds.size() / 2;
    const MicropolarModuli moduli =
        moduli_of(squares.plain, squares.input, squares.input.materials[k]);
    const double length = own.bonds.lengths[inner];
    EXPECT_NEAR(own.bending[inner] / own.stiffness[inner],
                12.0 * moduli.bending_modulus / (moduli.micromodulus * length * length), 1e-12);
  }
}

TEST(LayeredBody, BondsInThePlaneAreThoseOfBothLayersAndNoneCross) {
  TwoSquares squares;
  Index calls = 0;
  const auto calibrate = [&](std::size_t, const Body& body, Network& layer) {
    EXPECT_EQ(body.particles.size(), layer.particles.size());
    layer.stiffness.assign(layer.stiffness.size(), 1.0);
    layer.calibration.emplace();
    layer.calibration->free_bonds = ++calls;
  };
  ASSERT_TRUE(
      calibrate_layers(squares.body, squares.input, squares.joint, calibrate, squares.network));
  EXPECT_EQ(calls, 2);
  EXPECT_EQ(squares.network.calibration->free_bonds, 3);
  for (Index b = 0; b < squares.network.bonds.size(); ++b) {
    const double from = squares.height(squares.network.bonds.first[b]) - 1.0;
    const double to = squares.height(squares.network.bonds.second[b]) - 1.0;
    EXPECT_GT(from * to, -1e-12);
    const bool in_plane = std::abs(from) + std::abs(to) < 1e-9;
    EXPECT_EQ(squares.network.stiffness[b], in_plane ? 2.0 : 1.0);
  }
}

TEST(LayeredBody, ABodyWithoutBalanceStaysAsItWas) {
  TwoSquares squares;
  const std::vector<double> before = squares.network.stiffness;
  const auto calibrate = [](std::size_t, const Body&, Network& layer) {
    layer.calibration.emplace();
    layer.calibration->sum_after = 10.0;
  };
  EXPECT_FALSE(
      calibrate_layers(squares.body, squares.input, squares.joint, calibrate, squares.network));
  EXPECT_EQ(squares.network.stiffness, before);
  EXPECT_FALSE(squares.network.calibration);
}

}  // namespace
}  // namespace perilink

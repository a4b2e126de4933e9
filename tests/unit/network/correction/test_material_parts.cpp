#include "network/correction/material_parts.hpp"

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
  }
  double height(Index i) const { return body.particles.position(i)[1]; }
};

TEST(MaterialParts, AnyPartIsABodyOfOneStiffnessWithTiedFaces) {
  const TwoSquares squares;
  for (const std::size_t k : {0, 1}) {
    const MaterialPart part = cut_parts(squares.body, squares.input, squares.network)[k];
    const Particles& particles = part.body.particles;
    EXPECT_EQ(particles.size(), 81);
    const double volume = std::accumulate(particles.volumes.begin(), particles.volumes.end(), 0.0);
    EXPECT_NEAR(volume, 1.0, 1e-12);
    for (const Index m : particles.material) EXPECT_EQ(m, static_cast<Index>(k));
    const Facets& facets = part.network.facets;
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
TEST(MaterialParts, BondsBreakAsTheContinuumOfTheirPart) {
  TwoSquares squares;
  squares.input.materials[0].fracture_energy = 1.0;
  squares.input.materials[1].fracture_energy = 5.0;
  for (const std::size_t k : {0, 1}) {
    const MaterialPart part = cut_parts(squares.body, squares.input, squares.network)[k];
    const SolidMaterial& own = squares.input.materials[k];
    const double stretch = continuum_critical_stretch(
        squares.input.problem, own.fracture_energy,
        moduli_of(squares.body, squares.input, own).micromodulus, squares.input.horizon, 1.0);
    for (const double s : part.network.critical_stretch) EXPECT_NEAR(s, stretch, 1e-15);
  }
}

/// Bonds with moments end at the plane in hinges, and have the moduli of their part.
TEST(MaterialParts, ParticlesInThePlaneDoNotTurn) {
  const TwoSquares squares(BondModel::micropolar);
  for (const std::size_t k : {0, 1}) {
    const MaterialPart part = cut_parts(squares.plain, squares.input, squares.network)[k];
    const Network& own = part.network;
    ASSERT_EQ(own.hinged.size(), own.bending.size());
    for (Index b = 0; b < own.bonds.size(); ++b) {
      const Index i = part.particle_of[own.bonds.first[b]];
      const Index j = part.particle_of[own.bonds.second[b]];
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

TEST(MaterialParts, BondsAlongTheJointAreThoseOfBothPartsAndNoneCross) {
  TwoSquares squares;
  Index calls = 0;
  const auto calibrate = [&](const Body& body, Network& part) {
    EXPECT_EQ(body.particles.size(), part.particles.size());
    part.stiffness.assign(part.stiffness.size(), 1.0);
    part.report.calibration.emplace();
    part.report.calibration->free_bonds = ++calls;
  };
  ASSERT_TRUE(calibrate_parts(squares.body, squares.input, calibrate, squares.network));
  EXPECT_EQ(calls, 2);
  EXPECT_EQ(squares.network.report.calibration->free_bonds, 3);
  for (Index b = 0; b < squares.network.bonds.size(); ++b) {
    const double from = squares.height(squares.network.bonds.first[b]) - 1.0;
    const double to = squares.height(squares.network.bonds.second[b]) - 1.0;
    EXPECT_GT(from * to, -1e-12);
    const bool in_plane = std::abs(from) + std::abs(to) < 1e-9;
    EXPECT_EQ(squares.network.stiffness[b], in_plane ? 2.0 : 1.0);
  }
}

TEST(MaterialParts, ABodyWithoutBalanceStaysAsItWas) {
  TwoSquares squares;
  const std::vector<double> before = squares.network.stiffness;
  const auto calibrate = [](const Body&, Network& part) {
    part.report.calibration.emplace();
    part.report.calibration->sum_after = 10.0;
  };
  EXPECT_FALSE(calibrate_parts(squares.body, squares.input, calibrate, squares.network));
  EXPECT_EQ(squares.network.stiffness, before);
  EXPECT_FALSE(squares.network.report.calibration);
}

/// A square of nine stiff cells in the middle of a soft one.
struct Inclusion {
  Body body;
  NetworkInput input;
  Network network;

  explicit Inclusion(Pattern pattern = Pattern::rectangular) {
    LatticeInput lattice;
    lattice.pattern = pattern;
    lattice.surface = Surface::calibrated;
    lattice.spacing = 1.0;
    lattice.horizon = 3.0;
    const bool in_space = pattern != Pattern::rectangular;
    const double depth = in_space ? 9.0 : 1.0, from = in_space ? 3.0 : 0.0;
    lattice.solid = {{{0, 0, 0}, {12, 12, depth}}, {{3, 3, from}, {6, 6, from + 3}}};
    lattice.material = {0, 1};
    lattice.unlike_materials = true;
    body = make_body(lattice);
    body.lattice.surface = Surface::none;
    input.problem = in_space ? Problem::three_dimensional : Problem::plane_stress;
    input.solid = {lattice.solid[0]};
    input.horizon = lattice.horizon;
    input.materials = {{1.0}, {3.0}};
    network = build_network(body, input);
  }
};

double volume_of(const MaterialPart& part) {
  const std::vector<double>& volumes = part.body.particles.volumes;
  return std::accumulate(volumes.begin(), volumes.end(), 0.0);
}

TEST(MaterialParts, VolumesOfAnInclusionAndTheBodyAroundItMakeTheWhole) {
  for (const Pattern pattern : {Pattern::rectangular, Pattern::cubic, Pattern::face_centred}) {
    const Inclusion tested(pattern);
    const auto parts = cut_parts(tested.body, tested.input, tested.network);
    ASSERT_EQ(parts.size(), 2u);
    const bool in_plane = tested.body.particles.dim == 2;
    const double size = in_plane ? 9.0 : 27.0, whole = in_plane ? 144.0 : 1296.0;
    EXPECT_NEAR(volume_of(parts[0]) + volume_of(parts[1]), whole, 1e-9);
    // Bonds along an edge count for a half, and longer ones leave the inclusion.
    EXPECT_NEAR(volume_of(parts[1]), size, 0.2 * size);
  }
}

/// No bond of the body around an inclusion passes through the inclusion, whatever its direction.
TEST(MaterialParts, NoBondPassesThroughAnInclusion) {
  for (const Pattern pattern : {Pattern::rectangular, Pattern::cubic, Pattern::face_centred}) {
    const Inclusion tested(pattern);
    const auto parts = cut_parts(tested.body, tested.input, tested.network);
    const int dim = tested.body.particles.dim;
    const auto inside = [&](std::span<const double> x) {
      const bool in_depth = dim == 2 || (x[2] > 3.001 && x[2] < 5.999);
      return x[0] > 3.001 && x[0] < 5.999 && x[1] > 3.001 && x[1] < 5.999 && in_depth;
    };
    const MaterialPart& around = parts[0];
    for (Index b = 0; b < around.network.bonds.size(); ++b) {
      const auto from = around.body.particles.position(around.network.bonds.first[b]);
      const auto to = around.body.particles.position(around.network.bonds.second[b]);
      for (int k = 1; k < 20; ++k) {
        std::vector<double> x;
        for (int a = 0; a < dim; ++a) x.push_back(from[a] + 0.05 * k * (to[a] - from[a]));
        EXPECT_FALSE(inside(x));
      }
    }
    EXPECT_LT(parts[0].network.bonds.size() + parts[1].network.bonds.size(),
              tested.network.bonds.size());
  }
}

}  // namespace
}  // namespace perilink

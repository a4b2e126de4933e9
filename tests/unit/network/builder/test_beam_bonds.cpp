#include "network/builder/beam_bonds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "discretization/lattices/beam_body.hpp"

namespace perilink {
namespace {

constexpr double width = 0.5, fracture_energy = 0.03;

/// Two spans of the heights 2 and 1, the first of three spacings, the second of six; E is 4 and 8.
Body stepped_body() {
  LatticeInput lattice;
  lattice.spacing = 1.0;
  lattice.thickness = width;
  lattice.solid = {{{0, -1, 0}, {3, 1, 0}}, {{3, -0.5, 0}, {9, 0.5, 0}}};
  lattice.material = {0, 1};
  return make_beam_body(lattice);
}

Network stepped_beam(double horizon) {
  NetworkInput input;
  input.model = BondModel::micropolar;
  input.thickness = width;
  input.horizon = horizon;
  input.materials = {{4.0, fracture_energy, 0.0, {}}, {8.0, fracture_energy, 0.0, {}}};
  return make_beam(stepped_body(), input);
}

/// Sums over the bonds that cross the section between each two neighbours.
template <class Value>
std::vector<double> sums_across(const Network& beam, Value value) {
  std::vector<double> sums(static_cast<std::size_t>(beam.particles.size()) - 1, 0.0);
  for (Index e = 0; e < beam.num_elements(); ++e) {
    for (Index s = beam.bonds.first[e]; s < beam.bonds.second[e]; ++s) sums[s] += value(e);
  }
  return sums;
}

/// Sections have E A, E I and G_F A, those at ends too. Tolerance: round-off.
TEST(BeamBonds, ShareEverySection) {
  for (const double horizon : {1.0, 2.0, 3.0, 5.0}) {
    const Network beam = stepped_beam(horizon);
    const Bonds& bonds = beam.bonds;
    const auto tension =
        sums_across(beam, [&](Index e) { return beam.stiffness[e] * bonds.lengths[e]; });
    const auto bending = sums_across(beam, [&](Index e) {
      return beam.bending[e] * bonds.lengths[e] * bonds.lengths[e] * bonds.lengths[e] / 12.0;
    });
    const auto energy = sums_across(beam, [&](Index e) {
      const double stretch = beam.critical_stretch[e] * bonds.lengths[e];
      return 0.5 * beam.stiffness[e] * stretch * stretch;
    });
    for (std::size_t s = 0; s < tension.size(); ++s) {
      const double height = s < 3 ? 2.0 : 1.0, E = s < 3 ? 4.0 : 8.0, area = height * width;
      EXPECT_NEAR(tension[s], E * area, 1e-13) << "horizon " << horizon << ", section " << s;
      EXPECT_NEAR(bending[s], E * area * height * height / 12.0, 1e-13);
      if (horizon > 3.0) continue;  // no section of the first span is far from its ends
      EXPECT_NEAR(energy[s], fracture_energy * area, 1e-15);
    }
  }
}

TEST(BeamBonds, DoNotReachFromSpanToSpan) {
  const Network beam = stepped_beam(3.0);
  for (Index e = 0; e < beam.num_elements(); ++e) {
    EXPECT_FALSE(beam.bonds.first[e] < 3 && beam.bonds.second[e] > 3);
    EXPECT_EQ(beam.half_height[e], beam.bonds.second[e] <= 3 ? 1.0 : 0.5);
  }
  EXPECT_TRUE(beam.is_beam());
  EXPECT_TRUE(beam.has_sections());
}

TEST(BeamBonds, OfMaterialsWithAStrengthSoften) {
  NetworkInput input;
  input.model = BondModel::micropolar;
  input.thickness = width;
  input.horizon = 2.0;
  SofteningMaterial softening;
  softening.shape.kind = Softening::linear;
  softening.tensile_strength = 0.1;
  input.materials = {{4.0, fracture_energy, 0.0, {}}, {8.0, fracture_energy, 0.0, softening}};
  const Network beam = make_beam(stepped_body(), input);
  for (Index e = 0; e < beam.num_elements(); ++e) {
    // The particle between the spans is of the first one, its bonds are each of their own.
    const bool softens = beam.bonds.first[e] >= 3;
    EXPECT_EQ(!beam.law(e).is_brittle(), softens) << e;
    if (!softens) continue;
    EXPECT_NEAR(beam.critical_stretch[e], 0.1 / 8.0, 1e-12);  // beta is one
  }
  EXPECT_NEAR(beam.report.strengths[1].tensile_strength, 0.1, 1e-12);
}

}  // namespace
}  // namespace perilink

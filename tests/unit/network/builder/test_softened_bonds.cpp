#include "network/builder/softened_bonds.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "network/bond_softening.hpp"
#include "network/bond_strength.hpp"
#include "support/small_networks.hpp"

namespace perilink {
namespace {

using namespace test;

constexpr double exact = 1e-12;

NetworkInput softening_input(const LatticeInput& lattice) {
  NetworkInput input = network_input(lattice);
  input.materials[0].softening.shape.kind = Softening::bilinear;
  input.materials[0].softening.tensile_strength = 0.5;
  return input;
}

PropertyField random_in(VaryingProperty property, std::vector<std::uint8_t> materials = {1}) {
  PropertyField field;
  field.property = property;
  field.random.variation = 0.2;
  field.random.correlation_length = 0.7;
  field.varies = std::move(materials);
  return field;
}

/// Returns a field that grows along x to about twice the value of the material.
PropertyField graded_in(VaryingProperty property) {
  return {property, {}, {1}, [](std::span<const double> x) { return 0.7 + 0.6 * x[0]; }};
}

/// Energy of all segments of a bond per stiffness and length.
double energy_of_bond(const Network& network, Index bond) {
  const BondLaw& law = network.law(bond);
  double sum = 0.0;
  for (int k = 0; law.segment(k).secant > 0.0; ++k) {
    sum += 0.5 * std::pow(law.segment(k).limit * network.critical_stretch[bond], 2) *
           (law.segment(k).secant - law.segment(k + 1).secant);
  }
  return sum;
}

/// A class of laws is 2 % wide in its energy, so an energy is off by 1 % at most. The strength of a
/// cell is sought to 1e-4 and changes little with the energy.
TEST(SoftenedBonds, OfRandomStrengthKeepTheirEnergyAndHaveTheirStrength) {
  const LatticeInput lattice = body_input(rectangular, 12);
  const Body body = make_body(lattice);
  NetworkInput input = softening_input(lattice);
  const Network even = build_network(body, input);
  input.fields = {random_in(VaryingProperty::tensile_strength)};
  const Network network = build_network(body, input);
  const std::vector<double> factors = property_factors(input, network).strength;
  ASSERT_EQ(factors.size(), even.critical_stretch.size());
  double least = 10.0, most = 0.0;
  for (Index b = 0; b < network.bonds.size(); ++b) {
    EXPECT_NEAR(energy_of_bond(network, b) / energy_of_bond(even, b), 1.0, 0.0101);
    least = std::min(least, factors[b]);
    most = std::max(most, factors[b]);
  }
  EXPECT_GT(most, 1.5 * least);
  for (const Index b : {Index{0}, network.bonds.size() / 2, network.bonds.size() - 1}) {
    SolidMaterial own = input.materials[0];
    own.softening.tensile_strength *= factors[b];
    const double brittle = std::sqrt(2.0 * energy_of_bond(even, b));
    const MaterialBonds alone = bonds_of_material(body, input, own, brittle);
    EXPECT_NEAR(network.critical_stretch[b] / alone.strength.first_stretch, 1.0, 2e-3);
  }
  EXPECT_EQ(network.stiffness, even.stiffness);
  EXPECT_EQ(network.report.strengths[0].tensile_strength,
            even.report.strengths[0].tensile_strength);
}

TEST(SoftenedBonds, OfRandomEnergyKeepTheirStrength) {
  const LatticeInput lattice = body_input(rectangular, 8);
  const Body body = make_body(lattice);
  NetworkInput input = softening_input(lattice);
  const Network even = build_network(body, input);
  input.fields = {random_in(VaryingProperty::fracture_energy)};
  const Network network = build_network(body, input);
  const std::vector<double> factors = property_factors(input, network).energy;
  for (Index b = 0; b < network.bonds.size(); ++b) {
    EXPECT_NEAR(energy_of_bond(network, b) / (factors[b] * energy_of_bond(even, b)), 1.0, 0.0101);
  }
}

/// The law follows from strength and energy of the material over the modulus of the place.
TEST(SoftenedBonds, OfAGradedModulusKeepTheirStrengthAndEnergy) {
  const LatticeInput lattice = body_input(rectangular, 12);
  const Body body = make_body(lattice);
  NetworkInput input = softening_input(lattice);
  const Network even = build_network(body, input);
  input.fields = {graded_in(VaryingProperty::youngs_modulus)};
  const Network network = build_network(body, input);
  const std::vector<double> factors = property_factors(input, network).modulus;
  const auto energy = [](const Network& of, Index b) {
    return of.stiffness[b] * energy_of_bond(of, b);
  };
  for (Index b = 0; b < network.bonds.size(); ++b) {
    const double middle = 0.5 * (network.particles.position(network.bonds.first[b])[0] +
                                 network.particles.position(network.bonds.second[b])[0]);
    EXPECT_NEAR(factors[b], 0.7 + 0.6 * middle, exact);
    EXPECT_NEAR(network.stiffness[b] / even.stiffness[b], factors[b], exact * factors[b]);
    EXPECT_NEAR(energy(network, b) / energy(even, b), 1.0, 0.0101);
  }
  for (const Index b : {Index{0}, network.bonds.size() / 2, network.bonds.size() - 1}) {
    SolidMaterial own = input.materials[0];
    own.youngs_modulus *= factors[b];
    const double brittle = std::sqrt(2.0 * energy_of_bond(even, b) / factors[b]);
    const MaterialBonds alone = bonds_of_material(body, input, own, brittle);
    EXPECT_NEAR(network.critical_stretch[b] / alone.strength.first_stretch, 1.0, 2e-3);
    EXPECT_NEAR(alone.strength.tensile_strength, own.softening.tensile_strength, 1e-3);
  }
}

/// Brittle bonds release k xi s_c^2 / 2, whatever their stiffness.
TEST(SoftenedBonds, OfAGradedBrittleModulusKeepTheirEnergy) {
  const LatticeInput lattice = body_input(hexagonal, 8);
  const Body body = make_body(lattice);
  NetworkInput input = network_input(lattice);
  const Network even = build_network(body, input);
  input.fields = {graded_in(VaryingProperty::youngs_modulus),
                  graded_in(VaryingProperty::fracture_energy)};
  const Network network = build_network(body, input);
  const BondFactors factors = property_factors(input, network);
  EXPECT_TRUE(network.law_of.empty());
  const auto energy = [](const Network& of, Index b) {
    return of.stiffness[b] * std::pow(of.critical_stretch[b], 2);
  };
  for (Index b = 0; b < network.bonds.size(); ++b) {
    EXPECT_NEAR(energy(network, b) / energy(even, b), factors.energy[b], 1e-11);
  }
}

/// Laws by stretches have no strength that could stay.
TEST(SoftenedBonds, OfGivenStretchesKeepThemWhereTheModulusVaries) {
  const LatticeInput lattice = body_input(rectangular, 8);
  const Body body = make_body(lattice);
  NetworkInput input = softening_input(lattice);
  input.materials[0].softening.tensile_strength = infinity;
  input.materials[0].softening.stretches = {1e-4, 1e-3};
  const Network even = build_network(body, input);
  input.fields = {graded_in(VaryingProperty::youngs_modulus)};
  const Network network = build_network(body, input);
  EXPECT_EQ(network.critical_stretch, even.critical_stretch);
  EXPECT_EQ(network.law_of, even.law_of);
}

/// Brittle bonds: G_F is proportional to the square of the critical stretch.
TEST(SoftenedBonds, OfBrittleMaterialsFollowTheirEnergy) {
  const LatticeInput lattice = body_input(hexagonal, 8);
  const Body body = make_body(lattice);
  NetworkInput input = network_input(lattice);
  const Network even = build_network(body, input);
  input.fields = {random_in(VaryingProperty::fracture_energy)};
  const Network network = build_network(body, input);
  const std::vector<double> factors = property_factors(input, network).energy;
  EXPECT_TRUE(network.law_of.empty());
  for (Index b = 0; b < network.bonds.size(); ++b) {
    const double ratio = network.critical_stretch[b] / even.critical_stretch[b];
    EXPECT_NEAR(ratio * ratio, factors[b], exact);
  }
  const Network again = build_network(body, input);
  EXPECT_EQ(again.critical_stretch, network.critical_stretch);
  input.fields[0].random.seed = 2;
  EXPECT_NE(build_network(body, input).critical_stretch, network.critical_stretch);
}

/// Bonds between two materials take the smaller value, so a material of much higher energy has no
/// effect there.
TEST(SoftenedBonds, OfOtherMaterialsKeepTheirs) {
  LatticeInput lattice = body_input(rectangular, 8);
  Box lower = lattice.solid[0], upper = lower;
  lower.upper[1] = upper.lower[1] = 0.5 * lower.upper[1];
  lattice.solid = {lower, upper};
  lattice.material = {0, 1};
  const Body body = make_body(lattice);
  NetworkInput input = network_input(lattice);
  input.materials.push_back(input.materials[0]);
  input.materials[1].fracture_energy *= 100.0;
  const Network even = build_network(body, input);
  // Whether bonds of a pair of materials keep their values, by the number of ends in the second.
  const auto keep = [&](std::vector<std::uint8_t> varies) {
    input.fields = {random_in(VaryingProperty::fracture_energy, std::move(varies))};
    const Network network = build_network(body, input);
    std::array<Index, 3> kept{}, count{};
    for (Index b = 0; b < network.bonds.size(); ++b) {
      const auto [i, j] = materials_of_bond(network, b);
      count[i + j] += 1;
      kept[i + j] += network.critical_stretch[b] == even.critical_stretch[b] ? 1 : 0;
    }
    EXPECT_GT(count[1], 0);
    return std::array{kept[0] == count[0], kept[1] == count[1], kept[2] == count[2]};
  };
  EXPECT_EQ(keep({1, 0}), (std::array{false, false, true}));
  EXPECT_EQ(keep({0, 1}), (std::array{true, true, false}));
}

/// Two fields of one property are one field of their product.
TEST(SoftenedBonds, MultiplyTheirFields) {
  const LatticeInput lattice = body_input(rectangular, 8);
  const Body body = make_body(lattice);
  NetworkInput input = network_input(lattice);
  const PropertyField random = random_in(VaryingProperty::fracture_energy);
  const PropertyField graded = graded_in(VaryingProperty::fracture_energy);
  input.fields = {random, graded};
  const Network network = build_network(body, input);
  const auto energies = [&](const PropertyField& field) {
    return factors_on(field.property, input, {&field, 1}, network);
  };
  const std::vector<double> first = energies(random), second = energies(graded);
  const std::vector<double> both = property_factors(input, network).energy;
  ASSERT_EQ(both.size(), network.stiffness.size());
  for (std::size_t b = 0; b < both.size(); ++b) {
    EXPECT_NEAR(both[b], first[b] * second[b], exact * both[b]);
  }
}

/// At 0.75 of the largest strength that the fracture energy allows, some bonds would have more.
TEST(SoftenedBonds, RefuseStrengthBeyondTheirEnergy) {
  const LatticeInput lattice = body_input(rectangular, 8);
  const Body body = make_body(lattice);
  NetworkInput input = softening_input(lattice);
  const Network even = build_network(body, input);
  const double largest = std::sqrt(2.0 * energy_of_bond(even, 0)) / even.critical_stretch[0];
  input.materials[0].softening.tensile_strength *= 0.75 * largest;
  EXPECT_NO_THROW(build_network(body, input));
  input.fields = {random_in(VaryingProperty::tensile_strength)};
  input.fields[0].random.variation = 0.3;
  int refused = 0;
  for (input.fields[0].random.seed = 1; input.fields[0].random.seed <= 6;
       ++input.fields[0].random.seed) {
    try {
      build_network(body, input);
    } catch (const TooStrong& error) {
      EXPECT_LT(error.share, 1.0);
      EXPECT_NE(error.scatter, 1.0);
      EXPECT_TRUE(lattice.solid[0].contains(error.place, exact));
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace perilink

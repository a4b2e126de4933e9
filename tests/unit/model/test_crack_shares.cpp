#include "model/crack_shares.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "io/case/case_file.hpp"
#include "model/from_case/configure.hpp"
#include "model/gauges.hpp"
#include "network/bond_softening.hpp"

namespace perilink {
namespace {

/// Fractions of the length by which single straight cracks and their mean may differ: the sum of
/// k xi^2 across a line varies with its direction against the rows.
constexpr double single = 0.12, mean = 0.03;

Model square(const std::string& model, const std::string& pattern, const char* analysis = "") {
  return build_model(parse_case(
      fmt::format(R"([body]
model = "{}"
pattern = "{}"
spacing = 4
horizon_ratio = 3
thickness = 5
[[regions]]
name = "square"
x = [0, 100]
y = [0, 100]
[[regions]]
name = "left"
x = [0, 0]
y = [0, 100]
[[regions]]
name = "right"
x = [100, 100]
y = [0, 100]
[[materials]]
region = "square"
youngs_modulus = 30000
fracture_energy = 0.1
tensile_strength = 3
softening = "linear"
{}[[supports]]
region = "left"
fix = ["x", "y"]
[[displacements]]
region = "right"
x = 1
[[gauges]]
name = "crack"
cracks = "square"
{})",
                  model, pattern, model == "micropolar" ? "poissons_ratio = 0.2\n" : "", analysis),
      ""));
}

/// Returns a secant for the bonds that cross the line through the middle, one for the others.
std::vector<double> across_line(const Network& network, double angle, double secant) {
  const auto side = [&](Index i) {
    const auto x = network.particles.position(i);
    return (x[1] - 50.3) * std::cos(angle) - (x[0] - 49.6) * std::sin(angle) > 0.0;
  };
  std::vector<double> secants(network.stiffness.size(), 1.0);
  for (Index b = 0; b < network.num_bonds(); ++b) {
    if (side(network.bonds.first[b]) != side(network.bonds.second[b])) secants[b] = secant;
  }
  return secants;
}

TEST(CrackShares, AddUpToTheLengthOfAStraightCrack) {
  for (const char* pattern : {"rectangular", "hexagonal", "unstructured"}) {
    for (const char* kind : {"bond_based", "micropolar"}) {
      const Model model = square(kind, pattern);
      double sum = 0.0;
      constexpr int directions = 24;
      for (int k = 0; k < directions; ++k) {
        const double angle = std::numbers::pi * (k + 0.3) / directions;
        const double length =
            100.0 / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
        const double found = crack_size(model.network, model.gauges[0].cracks,
                                        across_line(model.network, angle, 0.0));
        EXPECT_NEAR(found, length, single * length) << pattern << ", " << kind << ", " << angle;
        sum += found / length / directions;
      }
      EXPECT_NEAR(sum, 1.0, mean) << pattern << ", " << kind;
    }
  }
}

/// A case of a damage run can be tried elastically.
TEST(CrackShares, AreNoneInElasticAnalyses) {
  const Model model = square("bond_based", "rectangular", "[analysis]\ntype = \"elastic\"\n");
  Csr neighbourhoods;
  const std::vector<double> motion(model.network.particles.positions.size(), 0.1);
  EXPECT_THAT(gauge_values(model, {{}, motion}, neighbourhoods), testing::ElementsAre(0.0));
}

/// Softened bonds count with the energy that they have dissipated.
TEST(CrackShares, CountDissipatedEnergy) {
  const Model model = square("bond_based", "rectangular");
  const BondLaw& law = model.network.laws[model.network.law_of[0]];
  const auto size_at = [&](double secant) {
    return crack_size(model.network, model.gauges[0].cracks,
                      across_line(model.network, 0.7, secant));
  };
  EXPECT_EQ(size_at(1.0), 0.0);
  for (int segment = 1; law.segment(segment).secant > 0.0; ++segment) {
    const double secant = law.segment(segment).secant;
    EXPECT_NEAR(size_at(secant) / size_at(0.0), energy_until(law, secant) / energy_until(law, 0.0),
                1e-12);
  }
}

}  // namespace
}  // namespace perilink

#include "assembly/results/surface_fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "discretization/bonds.hpp"
#include "support/small_networks.hpp"

namespace perilink {
namespace {

using test::LatticeCase;

constexpr double youngs_modulus = 30.0, poissons_ratio = 0.2;

/// A box of eight spacings with bonds of three and a half, and its surface.
struct Box {
  explicit Box(const LatticeCase& lattice) {
    LatticeInput input = test::body_input(lattice, 8);
    input.horizon = 3.5 * input.spacing;
    network = build_network(make_body(input), test::network_input(input));
    neighbourhoods = bonds_of_particles(network.bonds, network.particles.size());
    problem = dim() == 2 ? Problem::plane_stress : Problem::three_dimensional;
    materials = {hooke_constants(problem, youngs_modulus, poissons_ratio)};
    for (int a = 0; a < dim(); ++a) side[a] = input.solid[0].upper[a];
    surface.dim = dim();
    const auto all = static_cast<std::uint8_t>((1 << dim()) - 1);
    surface.unloaded.assign(network.particles.size(), all);
    for (Index i = 0; i < network.particles.size(); ++i) add_surface(i);
  }

  int dim() const { return network.dim(); }
  StressInput input() const {
    return {network, neighbourhoods, problem, materials, false, {}, &surface};
  }
  StressInput without_surface() const {
    StressInput result = input();
    result.surface = nullptr;
    return result;
  }
  std::vector<double> motion(const std::function<std::array<double, 3>(const double*)>& field) {
    std::vector<double> result;
    for (Index i = 0; i < network.particles.size(); ++i) {
      const std::array<double, 3> u = field(network.particles.position(i).data());
      result.insert(result.end(), u.begin(), u.begin() + dim());
    }
    return result;
  }
  Index at(double x, double y) const {
    for (Index i = 0; i < network.particles.size(); ++i) {
      const auto position = network.particles.position(i);
      if (std::hypot(position[0] - x, position[1] - y) < 1e-9) return i;
    }
    ADD_FAILURE() << "no particle at " << x << ", " << y;
    return 0;
  }

  Network network;
  Csr neighbourhoods;
  Problem problem = Problem::plane_stress;
  std::vector<HookeConstants> materials;
  SurfaceConditions surface;
  std::array<double, 3> side{};

 private:
  void add_surface(Index i) {
    std::array<double, 3> normal{};
    double square = 0.0;
    for (int a = 0; a < dim(); ++a) {
      const double x = network.particles.position(i)[a];
      normal[a] = x < 1e-9 ? -1.0 : x > side[a] - 1e-9 ? 1.0 : 0.0;
      square += normal[a] * normal[a];
    }
    if (square == 0.0) return;
    surface.particles.push_back(i);
    for (int a = 0; a < dim(); ++a) surface.normals.push_back(normal[a] / std::sqrt(square));
  }
};

class SurfaceFit : public testing::TestWithParam<LatticeCase> {};

/// Displacements are the gradient of the harmonic function x^4 - 6 x^2 z^2 + z^4 of the first and
/// the last axis, so they are in equilibrium for any moduli. Nothing is known of the tractions.
TEST_P(SurfaceFit, IsExactForCubicFieldsInEquilibrium) {
  Box box(GetParam());
  const int last = box.dim() - 1;
  for (const Index i : box.surface.particles) box.surface.unloaded[i] = 0;
  const std::vector<double> motion = box.motion([&](const double* position) {
    const double x = position[0], z = position[last];
    std::array<double, 3> u{};
    u[0] = 4.0 * x * x * x - 12.0 * x * z * z;
    u[last] = 4.0 * z * z * z - 12.0 * x * x * z;
    return u;
  });
  double largest_old = 0.0;
  for (const Index i : box.surface.particles) {
    const auto position = box.network.particles.position(i);
    const double x = position[0], z = position[last];
    const double exact = 2.0 * box.materials[0].mu * 12.0 * (x * x - z * z);
    // Round-off of displacements near 30 over distances near 0.5, times the modulus 25 and the
    // condition number of the fit, near 1e2.
    EXPECT_NEAR(stress_at(box.input(), motion, i)[0], exact, 1e-9);
    const double old = stress_at(box.without_surface(), motion, i)[0];
    largest_old = std::max(largest_old, std::abs(old - exact));
  }
  EXPECT_GT(largest_old, 0.1) << "a quadratic fit is not exact";
}

INSTANTIATE_TEST_SUITE_P(
    Lattices, SurfaceFit,
    testing::Values(LatticeCase{"rectangular", Pattern::rectangular, Surface::none},
                    LatticeCase{"hexagonal", Pattern::hexagonal, Surface::none},
                    LatticeCase{"cubic", Pattern::cubic, Surface::none}),
    [](const auto& tested) { return tested.param.name; });

/// sigma_xx = -x y, sigma_xy = (y^2 - c^2) / 2 with y from the middle (Timoshenko & Goodier 1970,
/// art. 21): a beam with free faces.
TEST(SurfaceFitOfBeam, AveragesErrorsAndIsExactAtFreeFaces) {
  Box box(test::rectangular);
  const double c = 0.5 * box.side[1], mu = box.materials[0].mu;
  for (const Index i : box.surface.particles) {
    const double x = box.network.particles.position(i)[0];
    if (x < 1e-9 || x > box.side[0] - 1e-9) box.surface.unloaded[i] = 0;
  }
  const auto beam = [&](const double* position) -> std::array<double, 3> {
    const double x = position[0], y = position[1] - c, e = youngs_modulus;
    return {-x * x * y / (2.0 * e) - poissons_ratio * y * y * y / (6.0 * e) +
                y * y * y / (6.0 * mu) - c * c * y / (2.0 * mu),
            poissons_ratio * x * y * y / (2.0 * e) + x * x * x / (6.0 * e), 0.0};
  };
  std::vector<double> motion = box.motion(beam);
  int exact = 0;
  for (const Index i : box.surface.particles) {
    const auto position = box.network.particles.position(i);
    const Stress stress = stress_at(box.input(), motion, i);
    if (std::abs(position[0] - 0.8) < 0.1) {
      // Round-off of displacements near 0.1, as above.
      EXPECT_NEAR(stress[0], -position[0] * (position[1] - c), 1e-11);
      EXPECT_NEAR(stress[1], 0.0, 1e-11);
      ++exact;
    } else if (box.surface.unloaded[i] != 0) {  // an end of the face within the horizon
      EXPECT_EQ(stress, stress_at(box.without_surface(), motion, i));
    }
  }
  EXPECT_EQ(exact, 2);
  // An error of the particle itself hardly counts, and the traction stays near zero.
  const Index top = box.at(0.8, box.side[1]);
  motion[2 * top + 1] += 0.01;
  const Stress stress = stress_at(box.input(), motion, top);
  const Stress old = stress_at(box.without_surface(), motion, top);
  EXPECT_LT(std::abs(stress[0] + 0.8 * c), 0.2 * std::abs(old[0] + 0.8 * c));
  EXPECT_LT(std::abs(stress[1]), 0.2 * std::abs(old[1]));
}

/// The normal at the end of a right angle lies between those of its sides.
TEST(SurfaceFitOfBeam, NeedsASmoothSurface) {
  Box box(test::rectangular);
  const std::vector<double> motion = test::random_vector(box.network.particles.positions.size(), 3);
  const Index top = box.at(0.8, box.side[1]), next = box.at(1.0, box.side[1]);
  const Stress without = stress_at(box.without_surface(), motion, top);
  const auto stress_with = [&](double x, double y) {
    const auto at =
        std::lower_bound(box.surface.particles.begin(), box.surface.particles.end(), next);
    const auto first = box.surface.normals.begin() + 2 * (at - box.surface.particles.begin());
    first[0] = x;
    first[1] = y;
    return stress_at(box.input(), motion, top);
  };
  EXPECT_EQ(stress_with(-std::sqrt(0.5), std::sqrt(0.5)), without) << "re-entrant";
  EXPECT_NE(stress_with(std::sqrt(0.5), std::sqrt(0.5)), without);
  EXPECT_NE(stress_with(-0.6, 0.8), without) << "a radius of five thirds of the distance";
}

/// Where a load or support acts on a neighbour inside, or a neighbour has a damaged bond, the
/// polynomial is not in equilibrium: the fit is that without a surface.
TEST(SurfaceFitOfBeam, NeedsUnloadedAndIntactNeighbors) {
  Box box(test::rectangular);
  const std::vector<double> motion = test::random_vector(box.network.particles.positions.size(), 3);
  const Index top = box.at(0.8, box.side[1]);
  const Stress with = stress_at(box.input(), motion, top);
  const Stress without = stress_at(box.without_surface(), motion, top);
  EXPECT_NE(with, without);

  const Index inside = box.at(0.8, box.side[1] - 0.4);
  box.surface.unloaded[inside] = 1;
  EXPECT_EQ(stress_at(box.input(), motion, top), without);
  box.surface.unloaded[inside] = 3;

  std::vector<double> secants(box.network.num_elements(), 1.0);
  StressInput input = box.input();
  input.secants = Secants(secants);
  EXPECT_EQ(stress_at(input, motion, top), with);
  const Index far = box.at(0.8, box.side[1] - 0.6);
  for (const Index e : box.neighbourhoods.row(inside)) {
    if (box.network.bonds.other_end(e, inside) == far) secants[e] = 0.5;
  }
  StressInput damaged = box.without_surface();
  damaged.secants = input.secants;
  EXPECT_EQ(stress_at(input, motion, top), stress_at(damaged, motion, top));
  const Index bottom = box.at(0.8, 0.0);
  EXPECT_EQ(stress_at(input, motion, bottom), stress_at(box.input(), motion, bottom))
      << "damage farther away does not count";
}

}  // namespace
}  // namespace perilink

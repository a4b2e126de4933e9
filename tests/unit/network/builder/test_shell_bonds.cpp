#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "assembly/internal_force.hpp"
#include "network/builder/network_builder.hpp"
#include "support/micropolar_networks.hpp"

namespace perilink {
namespace {

using namespace test;

constexpr double E = 30.0, nu = 0.2, thickness = 0.05;

/// A rectangle of a few spacings with a horizon of 2.5, as a shell.
Network make_mid_surface(Pattern pattern, double radius, int columns = 8) {
  const LatticeInput lattice = body_input({"", pattern, Surface::calibrated}, columns);
  LatticeInput thin = lattice;
  thin.thickness = thickness;
  NetworkInput input = micropolar_input(thin, nu);
  input.thickness = thickness;
  input.shell = true;
  input.radius = radius;
  return build_network(make_body(thin), input);
}

InternalForce forces_of(const Network& network, const std::vector<double>& motion) {
  const std::vector<double> secants(static_cast<std::size_t>(network.num_elements()), 1.0);
  return internal_force(network, secants, motion);
}

double area_of(const Network& network) {
  double volume = 0.0;
  for (const double v : network.particles.volumes) volume += v;
  return volume / thickness;
}

bool is_inside(const Network& network, Index i) {
  double lower[2] = {1e9, 1e9}, upper[2] = {-1e9, -1e9};
  for (Index j = 0; j < network.particles.size(); ++j) {
    for (int a = 0; a < 2; ++a) {
      lower[a] = std::min(lower[a], network.places().position(j)[a]);
      upper[a] = std::max(upper[a], network.places().position(j)[a]);
    }
  }
  for (int a = 0; a < 2; ++a) {
    const double x = network.places().position(i)[a];
    if (x < lower[a] + 1e-6 || x > upper[a] - 1e-6) return false;
  }
  return true;
}

class MidSurfaces : public testing::TestWithParam<Pattern> {};
INSTANTIATE_TEST_SUITE_P(Lattices, MidSurfaces,
                         testing::Values(Pattern::rectangular, Pattern::hexagonal));

/// w = -(a x^2 + b y^2 + 2 c x y) / 2, rotations (w_y, -w_x): no shear across the sheet, the energy
/// D (a^2 + b^2 + 2 nu a b + 2 (1 - nu) c^2) / 2 per area (Timoshenko & Woinowsky-Krieger 1959,
/// Eq. 111), D = E t^3 / (12 (1 - nu^2)), and no moment on particles inside.
TEST_P(MidSurfaces, BendAsThePlateDoes) {
  const Network network = make_mid_surface(GetParam(), 0.0);
  const double D = E * std::pow(thickness, 3) / (12.0 * (1.0 - nu * nu));
  for (const auto& [a, b, c] : {Vector3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, -0.5, 0.3}}) {
    std::vector<double> motion;
    for (Index i = 0; i < network.particles.size(); ++i) {
      const double x = network.particles.position(i)[0], y = network.particles.position(i)[1];
      motion.insert(motion.end(), {0.0, 0.0, -0.5 * (a * x * x + b * y * y + 2.0 * c * x * y),
                                   -(b * y + c * x), a * x + c * y, 0.0});
    }
    const InternalForce result = forces_of(network, motion);
    const double density = 0.5 * D * (a * a + b * b + 2.0 * nu * a * b + 2.0 * (1 - nu) * c * c);
    EXPECT_NEAR(result.energy, density * area_of(network), 1e-10 * result.energy);
    double largest = 0.0, scale = 0.0;
    for (Index i = 0; i < network.particles.size(); ++i) {
      for (int k = 0; k < 6; ++k) {
        const double force = std::abs(result.forces[6 * i + k]);
        (is_inside(network, i) ? largest : scale) =
            std::max(is_inside(network, i) ? largest : scale, force);
      }
    }
    EXPECT_LT(largest, 1e-10 * scale);
  }
}

/// In its own plane a flat shell is the plane body in plane stress.
TEST_P(MidSurfaces, StretchAsThePlaneBodyDoes) {
  const Network network = make_mid_surface(GetParam(), 0.0);
  const double exx = 1.0, eyy = -0.3, exy = 0.4;
  std::vector<double> motion;
  for (Index i = 0; i < network.particles.size(); ++i) {
    const double x = network.particles.position(i)[0], y = network.particles.position(i)[1];
    motion.insert(motion.end(), {exx * x + exy * y, exy * x + eyy * y, 0.0, 0.0, 0.0, 0.0});
  }
  const double density = 0.5 * E / (1 - nu * nu) *
                         (exx * exx + eyy * eyy + 2 * nu * exx * eyy + 2 * (1 - nu) * exy * exy);
  const double energy = forces_of(network, motion).energy;
  EXPECT_NEAR(energy, density * thickness * area_of(network), 1e-10 * energy);
}

TEST_P(MidSurfaces, MoveAsRigidBodiesForNothing) {
  for (const double radius : {0.0, 1.1}) {
    const Network network = make_mid_surface(GetParam(), radius);
    const Vector3 w{0.3, -0.7, 0.5};
    std::vector<double> motion;
    for (Index i = 0; i < network.particles.size(); ++i) {
      const auto x = network.particles.position(i);
      motion.insert(motion.end(), {0.1 + w[1] * x[2] - w[2] * x[1], 0.2 + w[2] * x[0] - w[0] * x[2],
                                   0.3 + w[0] * x[1] - w[1] * x[0], w[0], w[1], w[2]});
    }
    const InternalForce result = forces_of(network, motion);
    for (const double force : result.forces) EXPECT_NEAR(force, 0.0, 1e-12 * E);
  }
}

/// The curvature of a cylinder grows everywhere by kappa without stretch: the angle psi of its
/// normal goes from s / R to s / R + kappa s; the energy is D kappa^2 / 2 per area. Without the
/// rise of bonds it would be larger by xi^4 / (12 R^2 t^2) of that, here up to two.
TEST_P(MidSurfaces, OfCylindersBendWithoutStretching) {
  const double radius = 1.0, kappa = 1e-6;
  const Network network = make_mid_surface(GetParam(), radius, 16);
  std::vector<double> motion;
  for (Index i = 0; i < network.particles.size(); ++i) {
    const double s = network.places().position(i)[0], angle = s / radius;
    // Positions are the integrals of (cos psi, -sin psi); their change with the curvature.
    const double along = -(std::sin(angle) - angle * std::cos(angle)) * radius * radius * kappa;
    const double down =
        -(std::cos(angle) + angle * std::sin(angle) - 1.0) * radius * radius * kappa;
    motion.insert(motion.end(), {along, 0.0, down, 0.0, kappa * s, 0.0});
  }
  const double D = E * std::pow(thickness, 3) / (12.0 * (1.0 - nu * nu));
  const double expected = 0.5 * D * kappa * kappa * area_of(network);
  EXPECT_NEAR(forces_of(network, motion).energy, expected, 0.02 * expected);
}

TEST(MidSurface, LongerThanItsCylinderIsAroundIsRefused) {
  EXPECT_THROW(make_mid_surface(Pattern::rectangular, 0.2), std::invalid_argument);
}

}  // namespace
}  // namespace perilink

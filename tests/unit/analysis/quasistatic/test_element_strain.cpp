#include "analysis/quasistatic/element_strain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace perilink {
namespace {

/// Particles at the corners of a box of sides 1, 2, 3.
Particles box(int dim) {
  Particles particles;
  particles.dim = dim;
  for (int corner = 0; corner < (dim == 2 ? 4 : 8); ++corner) {
    for (int a = 0; a < dim; ++a) {
      particles.positions.push_back((corner >> a & 1) != 0 ? a + 1.0 : 0.0);
    }
    particles.volumes.push_back(1.0);
  }
  return particles;
}

std::vector<Index> all(const Particles& particles) {
  std::vector<Index> numbers(particles.volumes.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

/// Stretches 0.01 and 0.03 with a shear of 0.02, and a rotation without strain. Tolerance:
/// round-off.
TEST(ElementStrain, IsThePrincipalOneOfALinearMotion) {
  for (const int dim : {2, 3}) {
    for (const int width : {dim, dim == 2 ? 3 : 6}) {
      const Particles particles = box(dim);
      std::vector<double> motion;
      for (Index i = 0; i < particles.size(); ++i) {
        const auto x = particles.position(i);
        std::vector<double> u(static_cast<std::size_t>(width), 7.0);
        u[0] = 5.0 + 0.01 * x[0] + 0.5 * x[1];
        u[1] = -0.46 * x[0] + 0.03 * x[1];
        if (dim == 3) u[2] = -0.04 * x[2];
        motion.insert(motion.end(), u.begin(), u.end());
      }
      const ElementStrain strain(particles, 4, all(particles));
      EXPECT_EQ(strain.number(), 4);
      EXPECT_NEAR(strain.principal(motion, width), 0.02 + std::hypot(0.01, 0.02), 1e-15);
    }
  }
}

TEST(ElementStrain, OfParticlesInALineIsThatAlongIt) {
  Particles particles;
  particles.dim = 2;
  for (const double x : {0.0, 1.0, 3.0}) {
    particles.positions.insert(particles.positions.end(), {x, 2.0});
    particles.volumes.push_back(1.0);
  }
  const std::vector<double> motion = {0.0, 0.0, 0.1, 0.0, 0.3, 0.0};
  EXPECT_NEAR(ElementStrain(particles, 0, all(particles)).principal(motion, 2), 0.1, 1e-15);
}

}  // namespace
}  // namespace perilink

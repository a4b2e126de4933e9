#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "material/critical_stretch.hpp"
#include "material/micromodulus.hpp"

namespace perilink {
namespace {

// Gerstle, Sau & Silling 2005, Eqs. 7b and 7c.
TEST(ContinuumCriticalStretch, ReleasesTheFractureEnergy) {
  constexpr double c = 12.0;
  constexpr double horizon = 1.7;
  constexpr double energy = 0.4;
  constexpr double thickness = 3.0;
  const double plane =
      continuum_critical_stretch(Problem::plane_stress, energy, c, horizon, thickness);
  EXPECT_NEAR(c * thickness * plane * plane * std::pow(horizon, 4) / 4.0, energy, 1e-15);
  EXPECT_EQ(plane,
            continuum_critical_stretch(Problem::plane_strain, energy, c, horizon, thickness));
  const double solid =
      continuum_critical_stretch(Problem::three_dimensional, energy, c, horizon, thickness);
  EXPECT_NEAR(std::numbers::pi * c * solid * solid * std::pow(horizon, 5) / 10.0, energy, 1e-15);
}

TEST(ContinuumCriticalStretch, InfiniteFractureEnergyNeverBreaks) {
  EXPECT_EQ(continuum_critical_stretch(Problem::plane_stress, infinity, 1.0, 1.0, 1.0), infinity);
  EXPECT_EQ(lattice_critical_stretch(infinity, 2.0), infinity);
}

TEST(LatticeFractureSum, SquareLatticeByHand) {
  const std::vector<Vector3> nearest = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  // One bond of k xi^2 = c V^2 = 4 c per V / xi = 2 of crack: c V xi |xi . e| = 2 c.
  EXPECT_DOUBLE_EQ(lattice_fracture_sum(Problem::plane_stress, nearest, 2.0, 3.0, Vector3{0, 1, 0}),
                   6.0);
  const double half = std::sqrt(0.5);
  EXPECT_DOUBLE_EQ(
      lattice_fracture_sum(Problem::plane_stress, nearest, 2.0, 3.0, Vector3{half, half, 0}),
      12.0 * half);
  EXPECT_DOUBLE_EQ(lattice_fracture_sum(Problem::plane_stress, nearest, 2.0, 3.0),
                   12.0 * 2.0 / std::numbers::pi);
}

TEST(LatticeFractureSum, MeanIsTheMeanOfAllDirections) {
  const std::vector<Vector3> offsets = {{1, 0, 0}, {-1, 0, 0}, {1, 2, 0}, {-1, -2, 0}};
  double mean = 0.0;
  constexpr int directions = 20000;
  for (int n = 0; n < directions; ++n) {
    const double angle = std::numbers::pi * (n + 0.5) / directions;
    mean += lattice_fracture_sum(Problem::plane_stress, offsets, 1.0, 1.0,
                                 Vector3{std::cos(angle), std::sin(angle), 0.0}) /
            directions;
  }
  // Midpoint rule of |cos|: error of the order of 1 / directions^2.
  EXPECT_NEAR(lattice_fracture_sum(Problem::plane_stress, offsets, 1.0, 1.0), mean, 1e-7);
}

TEST(LatticeFractureSum, ApproachesTheContinuum) {
  std::vector<Vector3> disc;
  std::vector<Vector3> ball;
  constexpr int reach = 20;
  for (int k = -reach; k <= reach; ++k) {
    for (int j = -reach; j <= reach; ++j) {
      for (int i = -reach; i <= reach; ++i) {
        if (i * i + j * j + k * k > reach * reach) continue;
        ball.push_back({double(i), double(j), double(k)});
        if (k == 0) disc.push_back(ball.back());
      }
    }
  }
  // Q s^2 / 2 = G of Eqs. 7b and 7c; points counted by their centres leave a percent.
  EXPECT_NEAR(
      lattice_fracture_sum(Problem::plane_stress, disc, 1.0, 1.0) / (0.5 * std::pow(reach, 4)), 1.0,
      1e-2);
  EXPECT_NEAR(lattice_fracture_sum(Problem::three_dimensional, ball, 1.0, 1.0) /
                  (0.2 * std::numbers::pi * std::pow(reach, 5)),
              1.0, 1e-2);
}

TEST(FractureSumOfFamily, IsThatOfTheMicromodulusWhereOneMakesTheStiffness) {
  const std::vector<Vector3> offsets = {{1, 0, 0}, {-1, 0, 0}, {1, 2, 0}, {-1, -2, 0}};
  constexpr double volume = 0.3, micromodulus = 1.7;
  std::vector<double> stiffness;
  for (const Vector3& x : offsets) {
    stiffness.push_back(micromodulus * volume * volume / std::hypot(x[0], x[1]));
  }
  for (const Problem problem : {Problem::plane_stress, Problem::three_dimensional}) {
    EXPECT_NEAR(fracture_sum_of_neighbourhood(problem, offsets, stiffness, volume),
                lattice_fracture_sum(problem, offsets, volume, micromodulus), 1e-12);
  }
}

TEST(LatticeCriticalStretch, ReleasesTheFractureEnergy) {
  const double stretch = lattice_critical_stretch(0.3, 7.0);
  EXPECT_DOUBLE_EQ(7.0 * stretch * stretch / 2.0, 0.3);
}

}  // namespace
}  // namespace perilink

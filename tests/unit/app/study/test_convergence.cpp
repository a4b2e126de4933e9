#include "app/study/convergence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "discretization/lattices/lattice.hpp"
#include "discretization/lattices/make_body.hpp"

namespace perilink {
namespace {

Particles particles_of(Pattern pattern) {
  LatticeInput input;
  input.pattern = pattern;
  input.spacing = 0.25;
  input.solid = {{{0.3, -0.2, 0.1}, {1.3, 0.8, 0.6}}};
  input.material = {0};
  return make_body(input).particles;
}

/// A field at all particles.
template <class Function>
std::vector<double> field(const Particles& particles, Function function) {
  std::vector<double> values;
  for (Index i = 0; i < particles.size(); ++i) {
    const auto x = particles.position(i);
    const Vector3 at = {x[0], x[1], particles.dim == 3 ? x[2] : 0.0};
    const Vector3 u = function(at);
    values.insert(values.end(), u.begin(), u.begin() + particles.dim);
  }
  return values;
}

Vector3 turned(const Vector3& x) {  // translation and the rotation (0.1, -0.2, 0.3) x r
  return {1.0 - 0.2 * x[2] - 0.3 * x[1], -2.0 + 0.3 * x[0] - 0.1 * x[2],
          0.5 + 0.1 * x[1] + 0.2 * x[0]};
}

class RigidMotionKept : public testing::TestWithParam<Pattern> {};

TEST_P(RigidMotionKept, IsTakenOutWhole) {
  const Particles particles = particles_of(GetParam());
  std::vector<double> values = field(particles, [&](Vector3 x) {
    // In the plane only the rotation about the third axis is rigid.
    return particles.dim == 3 ? turned(x) : Vector3{1.0 - 0.3 * x[1], -2.0 + 0.3 * x[0], 0.0};
  });
  remove_rigid_motion(particles, values);
  for (const double value : values)
    EXPECT_NEAR(value, 0.0, 1e-14);  // round-off of numbers of size 3
}

TEST_P(RigidMotionKept, LeavesTheRestAlone) {
  const Particles particles = particles_of(GetParam());
  // A uniform stretch about the centroid has no translation, and no moment by symmetry.
  const Vector3 centre = {0.8, 0.3, 0.35};
  const std::vector<double> stretch = field(particles, [&](Vector3 x) {
    return Vector3{x[0] - centre[0], -2.0 * (x[1] - centre[1]), x[2] - centre[2]};
  });
  std::vector<double> values = stretch;
  remove_rigid_motion(particles, values);
  for (std::size_t k = 0; k < values.size(); ++k) EXPECT_NEAR(values[k], stretch[k], 1e-14);
}

TEST_P(RigidMotionKept, DoesNotCountAsErrorWhereItIsRemoved) {
  const Particles particles = particles_of(GetParam());
  const auto exact = field(particles, [](Vector3 x) { return Vector3{x[0] * x[0], x[1], x[2]}; });
  std::vector<double> moved = exact;
  const auto turn = field(particles, [](Vector3 x) { return Vector3{1.0 - x[1], x[0], 0.0}; });
  for (std::size_t k = 0; k < moved.size(); ++k) moved[k] += turn[k];
  EXPECT_GT(relative_l2_error(particles, moved, exact, false), 0.1);
  EXPECT_LT(relative_l2_error(particles, moved, exact, true), 1e-14);
}

INSTANTIATE_TEST_SUITE_P(Patterns, RigidMotionKept,
                         testing::Values(Pattern::rectangular, Pattern::hexagonal, Pattern::cubic),
                         [](const auto& test) {
                           return std::to_string(static_cast<int>(test.param));
                         });

TEST(RelativeError, WeighsWithTheVolumesOfSolidParticles) {
  Particles particles;
  particles.dim = 2;
  particles.positions = {0, 0, 1, 0, 2, 0};
  particles.volumes = {1.0, 3.0, 5.0};
  particles.material = {0, 0, no_index};
  particles.kind = {ParticleKind::solid, ParticleKind::solid, ParticleKind::ghost};
  const std::vector<double> exact = {2, 0, 0, 1, 7, 7};
  const std::vector<double> found = {2, 1, 1, 1, 0, 0};
  // sqrt((1 * 1 + 3 * 1) / (1 * 4 + 3 * 1))
  EXPECT_DOUBLE_EQ(relative_l2_error(particles, found, exact, false), std::sqrt(4.0 / 7.0));
}

TEST(ObservedOrder, IsTheExponentBetweenTwoPoints) {
  EXPECT_NEAR(observed_order(0.3, 5.0 * std::pow(0.3, 1.7), 0.1, 5.0 * std::pow(0.1, 1.7)), 1.7,
              1e-14);
  EXPECT_TRUE(std::isnan(observed_order(0.2, 1.0, 0.1, 0.0)));
  EXPECT_TRUE(std::isnan(observed_order(0.1, 1.0, 0.1, 0.5)));
}

TEST(Extrapolation, FindsLimitAndOrderForUnequalRatios) {
  const std::array<double, 3> spacings = {0.5, 0.2, 0.13};
  for (const double order : {0.7, 1.0, 2.0, 3.5}) {
    for (const double factor : {-4.0, 0.3}) {
      std::array<double, 3> values{};
      for (int k = 0; k < 3; ++k) values[k] = 7.0 + factor * std::pow(spacings[k], order);
      const auto found = extrapolate(spacings, values);
      ASSERT_TRUE(found.has_value());
      // Differences of 1e-3 between numbers of size 7 leave ten digits.
      EXPECT_NEAR(found->limit, 7.0, 1e-10);
      EXPECT_NEAR(found->order, order, 1e-8);
    }
  }
}

TEST(Extrapolation, RefusesValuesWithoutALimit) {
  const std::array<double, 3> spacings = {0.4, 0.2, 0.1};
  EXPECT_FALSE(extrapolate(spacings, {1.0, 2.0, 1.5}).has_value()) << "oscillates";
  EXPECT_FALSE(extrapolate(spacings, {1.0, 2.0, 4.0}).has_value()) << "runs away";
  EXPECT_FALSE(extrapolate(spacings, {1.0, 1.0, 1.0}).has_value()) << "says nothing of the order";
}

}  // namespace
}  // namespace perilink

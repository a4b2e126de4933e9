// Results of verification/studies/irregular_particles, on its smaller bodies.

#include <gtest/gtest.h>

#include <cmath>

#include "clouds.hpp"

namespace perilink::verification {
namespace {

UnstructuredParticles plane(double scatter, double columns) {
  return {0.15, 0.3, 0.15, Problem::plane_stress, 0.15 / columns, scatter};
}

TEST(IrregularParticles, RegularOnesStretchAsTheSolidButForTheirFaces) {
  const UnstructuredParticles coarse = plane(0.0, 15.0), fine = plane(0.0, 60.0);
  const Stretching a = stretch(coarse, build(coarse)), b = stretch(fine, build(fine));
  // The faces' share falls with the spacing, to some third here.
  EXPECT_LT(std::abs(1.0 - a.modulus), 0.05);
  EXPECT_LT(std::abs(1.0 - b.modulus), 0.4 * std::abs(1.0 - a.modulus));
}

TEST(IrregularParticles, ScatteredOnesAreTooSoftHoweverSmall) {
  const UnstructuredParticles coarse = plane(0.3, 15.0), fine = plane(0.3, 30.0);
  const ParticleNetwork a = build(coarse), b = build(fine);
  const double softer = 1.0 - stretch(coarse, a).modulus, still = 1.0 - stretch(fine, b).modulus;
  EXPECT_GT(softer, 0.05);
  EXPECT_GT(still, 0.7 * softer);
  EXPECT_GT(b.report.mean_residual, 0.1);
  EXPECT_EQ(a.report.singular, 0) << "every strain stretches some bond";
}

TEST(IrregularParticles, TearNearTheirStrength) {
  const UnstructuredParticles particle_set = plane(0.2, 15.0);
  const ExplicitResult result = tear(particle_set, build(particle_set));
  EXPECT_EQ(result.termination, Termination::completed);
  EXPECT_GT(result.last.cracked_particles, 0);
  const double peak =
      std::abs(result.peak_load) / (strength * particle_set.width * particle_set.thickness);
  EXPECT_GT(peak, 0.75);
  EXPECT_LT(peak, 1.05);
  EXPECT_LT(result.largest_surplus, 1e-3);
}

}  // namespace
}  // namespace perilink::verification

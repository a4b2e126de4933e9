#include "assembly/results/section_forces.hpp"

#include <gtest/gtest.h>

#include "discretization/lattices/beam_body.hpp"
#include "network/builder/beam_bonds.hpp"

namespace perilink {
namespace {

/// A beam of the length 6 and the section 1 by 2 with E = 3.
Network plain_beam() {
  LatticeInput lattice;
  lattice.spacing = 1.0;
  lattice.solid = {{{0, -1, 0}, {6, 1, 0}}};
  lattice.material = {0};
  NetworkInput input;
  input.model = BondModel::micropolar;
  input.horizon = 2.0;
  input.materials = {{3.0, 1.0, 0.0, {}}};
  return make_beam(make_beam_body(lattice), input);
}

/// u = a x, v = b x^2 / 2 + c x^3 / 6: N = E A a, M = E I (b + c x), V = E I c. Tolerance:
/// round-off.
TEST(SectionForces, AreThoseOfACubicDeflection) {
  const Network beam = plain_beam();
  const double a = 0.01, b = 0.02, c = 0.003, EA = 6.0, EI = 2.0;
  std::vector<double> motion;
  for (Index i = 0; i < beam.particles.size(); ++i) {
    const double x = beam.particles.position(i)[0];
    motion.insert(motion.end(), {a * x, b * x * x / 2 + c * x * x * x / 6, b * x + c * x * x / 2});
  }
  const std::vector<double> intact(static_cast<std::size_t>(beam.num_elements()), 1.0);
  const SectionForces forces = section_forces(beam, intact, motion);
  for (Index i = 0; i < beam.particles.size(); ++i) {
    const double x = beam.particles.position(i)[0];
    EXPECT_NEAR(forces.normal[i], EA * a, 1e-14);
    EXPECT_NEAR(forces.moment[i], EI * (b + c * x), 1e-14);
    EXPECT_NEAR(forces.shear[i], EI * c, 1e-14);
  }
}

TEST(SectionForces, FallWithTheStiffnessThatIsLeft) {
  const Network beam = plain_beam();
  std::vector<double> motion(std::size_t{3} * beam.particles.size(), 0.0);
  for (Index i = 0; i < beam.particles.size(); ++i) {
    motion[std::size_t{3} * i] = 0.1 * beam.particles.position(i)[0];
  }
  const std::vector<double> half(static_cast<std::size_t>(beam.num_elements()), 0.5);
  for (const double normal : section_forces(beam, half, motion).normal) {
    EXPECT_NEAR(normal, 0.5 * 6.0 * 0.1, 1e-14);
  }
}

}  // namespace
}  // namespace perilink

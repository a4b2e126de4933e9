#include "analysis/dynamics/bonds/state_particles.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "analysis/dynamics/bonds/bond_forces.hpp"
#include "analysis/dynamics/inertia.hpp"
#include "analysis/dynamics/time_state.hpp"
#include "assembly/internal_force.hpp"
#include "assembly/stiffness.hpp"
#include "support/particle_clouds.hpp"

namespace perilink {
namespace {

using test::random_numbers;
using test::unstructured_particles;

constexpr double strength = 0.003, dt = 0.1;

StateMaterial concrete(bool breakable) {
  StateMaterial material;
  material.youngs_modulus = test::soft_solid.youngs_modulus;
  material.poissons_ratio = test::soft_solid.poissons_ratio;
  material.breakable = breakable;
  material.softening = {strength, 0.25, 1e-3, 1e-2};
  return material;
}

class ExplicitParticles : public testing::TestWithParam<int> {
 protected:
  ExplicitParticles()
      : network_(unstructured_particles(GetParam(), GetParam() == 2 ? 7 : 4).network),
        size_(network_.particles.size()),
        problem_(GetParam() == 2 ? Problem::plane_stress : Problem::three_dimensional),
        hooke_(hooke_constants(problem_, 30.0, 0.2)) {}

  std::unique_ptr<ExplicitBonds> make(bool breakable) const {
    return make_explicit_particles(network_, problem_, std::vector{concrete(breakable)}, 1.0);
  }

  /// At rest under a uniform strain with these principal values along the axes.
  BondMotion strained(const Vector3& strain) const {
    BondMotion motion;
    for (Index i = 0; i < size_; ++i) {
      for (int a = 0; a < network_.dim(); ++a) {
        motion.displacement.push_back(strain[a] * network_.particles.position(i)[a]);
      }
    }
    motion.velocity.assign(motion.displacement.size(), 0.0);
    return motion;
  }

  /// Under a stress along x and one along the other axes.
  BondMotion stressed(double along, double across) const {
    const double e = 30.0, nu = 0.2;
    const double others = network_.dim() == 3 ? 2.0 : 1.0;
    const double x = (along - nu * others * across) / e;
    const double y = (across - nu * along - nu * (others - 1.0) * across) / e;
    return strained({x, y, y});
  }

  /// Forces and energy of particles that are damaged so in the present directions of their bonds:
  /// d k e^2 / 2 of every bond and K s^2 / 2 of every particle's weighted sum of extensions.
  InternalForce weakened(const std::vector<double>& damage, const std::vector<double>& u) const {
    const Bonds& bonds = network_.bonds;
    const auto dim = static_cast<std::size_t>(network_.dim());
    std::vector<double> extension, sum(static_cast<std::size_t>(size_), 0.0);
    for (Index e = 0; e < network_.num_elements(); ++e) {
      const Index i = bonds.first[e], j = bonds.second[e];
      double along = 0.0;
      for (std::size_t c = 0; c < dim; ++c) {
        along += bonds.direction(e)[c] * (u[j * dim + c] - u[i * dim + c]);
      }
      extension.push_back(along);
      const double mine = half_bond_weight(damage[i], damage[j]);
      const double other = half_bond_weight(damage[j], damage[i]);
      if (network_.counts_for(e, first_end)) sum[i] += mine * along;
      if (network_.counts_for(e, second_end)) sum[j] += other * along;
    }
    InternalForce result;
    result.forces.assign(u.size(), 0.0);
    for (Index i = 0; i < size_; ++i) {
      result.energy += 0.5 * network_.states->stiffness[i] * sum[i] * sum[i];
    }
    for (Index e = 0; e < network_.num_elements(); ++e) {
      const Index i = bonds.first[e], j = bonds.second[e];
      double pull = two_spring_factor(damage[i], damage[j]) * network_.stiffness[e] * extension[e];
      result.energy += 0.5 * pull * extension[e];
      if (network_.counts_for(e, first_end)) {
        pull += half_bond_weight(damage[i], damage[j]) * network_.states->stiffness[i] * sum[i];
      }
      if (network_.counts_for(e, second_end)) {
        pull += half_bond_weight(damage[j], damage[i]) * network_.states->stiffness[j] * sum[j];
      }
      for (std::size_t c = 0; c < dim; ++c) {
        result.forces[i * dim + c] -= pull * bonds.direction(e)[c];
        result.forces[j * dim + c] += pull * bonds.direction(e)[c];
      }
    }
    return result;
  }

  BondLosses step(ExplicitBonds& bonds, const BondMotion& motion,
                  std::vector<double>* force = nullptr) const {
    const BondLosses losses = bonds.prepare(0, size_, dt, motion);
    std::vector<double> own(motion.displacement.size(), 0.0);
    bonds.forces(0, size_, dt, motion, force != nullptr ? std::span(*force) : std::span(own));
    return losses;
  }

  Network network_;
  Index size_;
  Problem problem_;
  HookeConstants hooke_;
};

TEST_P(ExplicitParticles, ForcesAreThoseOfTheNetwork) {
  BondMotion motion;
  const std::size_t slots = network_.particles.positions.size();
  motion.displacement = random_numbers(slots, 3, -1.0, 1.0);
  motion.velocity.assign(slots, 0.0);
  const std::vector<double> intact(static_cast<std::size_t>(network_.num_elements()), 1.0);
  const InternalForce expected = internal_force(network_, intact, motion.displacement);
  double largest = 0.0;
  for (const double f : expected.forces) largest = std::max(largest, std::abs(f));
  const auto bonds = make(false);
  ASSERT_TRUE(bonds->has_states());
  std::vector<double> force(slots);
  EXPECT_EQ(step(*bonds, motion, &force).fractured, 0.0);
  // Round-off of sums of some forty forces.
  for (std::size_t k = 0; k < slots; ++k)
    EXPECT_NEAR(force[k], expected.forces[k], 1e-13 * largest);
  EXPECT_NEAR(bonds->stored(0, size_, dt, motion), expected.energy, 1e-13 * expected.energy);
}

TEST_P(ExplicitParticles, CrackWhereTheFirstPrincipalStressReachesTheStrength) {
  // The fitted strain of a uniform one is exact, so every particle cracks at once.
  for (const auto& [along, cracks] : {std::pair{0.999, false}, {1.001, true}}) {
    const auto bonds = make(true);
    step(*bonds, stressed(along * strength, 0.0));
    bonds->finish_step();
    const std::vector<double> damage = bonds->damage();
    const auto cracked =
        std::count_if(damage.begin(), damage.end(), [](double d) { return d > 0; });
    EXPECT_EQ(cracked, cracks ? size_ : 0);
  }
}

TEST_P(ExplicitParticles, DoNotCrackUnderAStrongPressureAcross) {
  const auto bonds = make(true);
  step(*bonds, stressed(1.5 * strength, -6.1 * strength));
  bonds->finish_step();
  for (const double damage : bonds->damage()) EXPECT_EQ(damage, 0.0);
  step(*bonds, stressed(1.5 * strength, -5.9 * strength));
  bonds->finish_step();
  for (const double damage : bonds->damage()) EXPECT_GT(damage, 0.0);
}

/// With lambda = -11.1 and mu = 25 equal strains in the plane make 27.8 of each there, -22.2 normal
/// to it.
TEST_P(ExplicitParticles, DoNotCrackUnderAStrongPressureOutOfThePlane) {
  if (GetParam() == 3) return;
  StateMaterial material = concrete(true);
  material.poissons_ratio = -0.4;
  const double strain = 2.0 * strength / 27.8;
  for (const auto& [ratio, cracks] : {std::pair{1.5, false}, {1.7, true}}) {
    material.softening.compression_ratio = ratio;
    const auto bonds =
        make_explicit_particles(network_, Problem::plane_strain, std::vector{material}, 1.0);
    step(*bonds, strained({strain, strain, 0.0}));
    bonds->finish_step();
    for (const double damage : bonds->damage()) EXPECT_EQ(damage > 0.0, cracks) << ratio;
  }
}

TEST_P(ExplicitParticles, DamageIsThatOfTheBand) {
  const StateMaterial material = concrete(true);
  const auto bonds = make(true);
  const double strain = 3.0 * strength / 30.0;
  step(*bonds, stressed(3.0 * strength, 0.0));
  bonds->finish_step();
  const std::vector<double> damage = bonds->damage();
  for (Index i = 0; i < size_; ++i) {
    const double volume = network_.particles.volumes[i];
    const double band = network_.dim() == 2 ? std::sqrt(volume) : std::cbrt(volume);
    EXPECT_NEAR(damage[i], band_damage(material.softening, 30.0, strain, band), 1e-9);
    EXPECT_GT(damage[i], 0.1);
  }
}

TEST_P(ExplicitParticles, DamagedForcesAreThoseOfTheEnergyThatIsLeft) {
  const auto bonds = make(true);
  const BondMotion motion = strained({3e-4, 3e-4, 3e-4});  // all bonds stretch
  step(*bonds, motion);
  const double before = bonds->stored(0, size_, dt, motion);
  bonds->finish_step();
  std::vector<double> force(motion.displacement.size());
  const BondLosses losses = step(*bonds, motion, &force);
  const double after = bonds->stored(0, size_, dt, motion);
  EXPECT_GT(losses.fractured, 0.0);
  EXPECT_NEAR(losses.fractured, before - after, 1e-13 * before);
  const InternalForce expected = weakened(bonds->damage(), motion.displacement);
  EXPECT_NEAR(after, expected.energy, 1e-13 * before);
  double largest = 0.0;
  for (const double f : expected.forces) largest = std::max(largest, std::abs(f));
  for (std::size_t k = 0; k < force.size(); ++k) {
    EXPECT_NEAR(force[k], expected.forces[k], 1e-12 * largest);
  }
  const std::vector<double> secants = bonds->secants();
  EXPECT_LT(*std::min_element(secants.begin(), secants.end()), 1.0);
}

/// Pressed after they have cracked, bonds are weaker by the damage in compression.
TEST_P(ExplicitParticles, CracksThatCloseCarryPressureUpToTheThreshold) {
  for (const double stretching : {1.2, 30.0}) {
    const auto bonds = make(true);
    step(*bonds, stressed(stretching * strength, 0.0));
    bonds->finish_step();
    const std::vector<double> damage = bonds->damage();
    const BondMotion pressed = strained({-1e-4, -1e-4, -1e-4});
    std::vector<double> force(pressed.displacement.size());
    step(*bonds, pressed, &force);
    std::vector<double> weaker;
    for (const double each : damage) weaker.push_back(compressive_damage(each, 1.0 / 3.0));
    const double most = *std::max_element(weaker.begin(), weaker.end());
    if (stretching < 2.0) {
      EXPECT_EQ(most, 0.0) << "below the threshold nothing is lost";
    } else {
      EXPECT_GT(most, 0.5);
    }
    const InternalForce expected = weakened(weaker, pressed.displacement);
    double largest = 0.0;
    for (const double f : expected.forces) largest = std::max(largest, std::abs(f));
    for (std::size_t k = 0; k < force.size(); ++k) {
      EXPECT_NEAR(force[k], expected.forces[k], 1e-12 * largest);
    }
    EXPECT_NEAR(bonds->stored(0, size_, dt, pressed), expected.energy, 1e-12 * expected.energy);
  }
}

TEST_P(ExplicitParticles, DamageNeverHeals) {
  const auto bonds = make(true);
  step(*bonds, stressed(3.0 * strength, 0.0));
  bonds->finish_step();
  const std::vector<double> most = bonds->damage();
  for (int n = 0; n < 3; ++n) {
    step(*bonds, stressed(0.1 * strength, 0.0));
    bonds->finish_step();
    EXPECT_EQ(bonds->damage(), most);
  }
}

/// Between the steps damage has grown that the factors of the bonds do not yet have.
TEST_P(ExplicitParticles, RestoredOnesPullAsTheSavedOnes) {
  const auto bonds = make(true), restored = make(true);
  for (const double stretching : {3.0, 5.0}) {
    step(*bonds, stressed(stretching * strength, 0.0));
    bonds->finish_step();
  }
  MovingElements state;
  bonds->save(state);
  ASSERT_NE(state.damage, state.last_damage);
  restored->restore(state);
  EXPECT_EQ(restored->secants(), bonds->secants());
  const BondMotion motion = stressed(7.0 * strength, 0.0);
  std::vector<double> expected(motion.displacement.size()), found = expected;
  const double lost = bonds->prepare(0, size_, dt, motion).fractured;
  EXPECT_GT(lost, 0.0);
  EXPECT_EQ(restored->prepare(0, size_, dt, motion).fractured, lost);
  bonds->forces(0, size_, dt, motion, expected);
  restored->forces(0, size_, dt, motion, found);
  EXPECT_EQ(found, expected);
  EXPECT_THROW(make(false)->restore(state), std::invalid_argument) << "which cannot crack";
}

/// The bound of the frequency is one: the largest eigenvalue of K over M is below it.
TEST_P(ExplicitParticles, NoVibrationIsFasterThanTheBound) {
  for (const double ratio : {-0.3, 0.2, 0.45}) {
    const Network network =
        unstructured_particles(GetParam(), GetParam() == 2 ? 6 : 3, {30.0, ratio}).network;
    const Inertia inertia = lumped_inertia(network, std::vector{2.5});
    const std::size_t slots = network.particles.positions.size();
    const Unknowns unknowns = number_unknowns(network.dim(), std::vector<std::uint8_t>(slots, 0),
                                              std::vector<double>(slots, 0.0));
    const std::vector<double> intact(static_cast<std::size_t>(network.num_elements()), 1.0);
    Eigen::MatrixXd matrix = Eigen::MatrixXd(assemble_stiffness(network, intact, unknowns))
                                 .selfadjointView<Eigen::Lower>();
    const Eigen::VectorXd root =
        Eigen::Map<const Eigen::VectorXd>(inertia.mass.data(), matrix.rows()).cwiseSqrt();
    matrix = root.cwiseInverse().asDiagonal() * matrix * root.cwiseInverse().asDiagonal();
    const double largest =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly)
            .eigenvalues()
            .maxCoeff();
    EXPECT_LT(std::sqrt(largest), inertia.frequency_bound);
    EXPECT_GT(std::sqrt(largest), 0.3 * inertia.frequency_bound) << "of use as a bound";
  }
}

TEST_P(ExplicitParticles, RefuseBandsThatReleaseMoreThanTheyDissipate) {
  StateMaterial brittle = concrete(true);
  brittle.softening.knee_opening *= 1e-3;
  brittle.softening.critical_opening *= 1e-3;
  EXPECT_THROW(make_explicit_particles(network_, problem_, std::vector{brittle}, 1.0),
               std::invalid_argument);
  EXPECT_THROW(make_explicit_bonds(network_), std::invalid_argument) << "which have no states";
}

INSTANTIATE_TEST_SUITE_P(Dimensions, ExplicitParticles, testing::Values(2, 3));

}  // namespace
}  // namespace perilink

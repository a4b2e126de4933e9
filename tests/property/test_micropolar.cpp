// Micropolar bonds: invariants of every lattice, and one bond compared with textbook beams.

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "analysis/quasistatic/events/frame_limit_search.hpp"
#include "assembly/element_vector.hpp"
#include "assembly/fields.hpp"
#include "assembly/internal_force.hpp"
#include "assembly/stiffness.hpp"
#include "discretization/lattices/make_body.hpp"
#include "network/rigid_modes.hpp"
#include "support/clouds.hpp"
#include "support/micropolar_networks.hpp"
#include "support/textbook_beams.hpp"

namespace perilink {
namespace {

using namespace test;

/// Round-off of a sum over the bonds of a particle, relative to the stiffest bond.
constexpr double turning_round_off = 1e-12;

double largest_of(const std::vector<double>& values) {
  double result = 0.0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

std::size_t num_slots(const Network& network) {
  return static_cast<std::size_t>(network.particles.size()) * network.width();
}

Unknowns all_free(const Network& network) {
  std::vector<std::uint8_t> held(num_slots(network), 0);
  hold_idle_rotations(network, held);
  return number_unknowns(network.width(), held, std::vector<double>(held.size(), 0.0));
}

Eigen::MatrixXd dense(const Network& network, const std::vector<double>& secants,
                      const Unknowns& unknowns) {
  const Eigen::MatrixXd lower(assemble_stiffness(network, secants, unknowns));
  return lower.selfadjointView<Eigen::Lower>();
}

TEST(OneFrame, HasTheStiffnessOfABeam) {
  constexpr double L = 5.0, EA = 70.0, EI = 11.0;
  const Network network = single_frame(2, {3.0, 4.0}, EA / L, 12.0 * EI / (L * L * L));
  const Eigen::MatrixXd expected = element_stiffness(network, 0);
  const Eigen::MatrixXd stiffness = dense(network, {1.0}, all_free(network));
  EXPECT_LT((stiffness - expected).cwiseAbs().maxCoeff(), 1e-14 * expected.maxCoeff());
  EXPECT_EQ(dense(network, {0.0}, all_free(network)).norm(), 0.0);  // broken
}

TEST(OneFrame, HasTheStiffnessOfABeamInSpace) {
  Network network = single_frame(3, {2.0, -3.0, 6.0}, 14.0, 3.0);
  network.torsion = 0.4;
  const Eigen::MatrixXd expected = element_stiffness(network, 0);
  const Eigen::MatrixXd stiffness = dense(network, {1.0}, all_free(network));
  EXPECT_LT((stiffness - expected).cwiseAbs().maxCoeff(), 1e-14 * expected.maxCoeff());
}

TEST(OneFrame, IsACantilever) {
  constexpr double L = 5.0, EI = 11.0, P = 0.3;
  const Network network = single_frame(2, {3.0, 4.0}, 14.0, 12.0 * EI / (L * L * L));
  const Unknowns unknowns = number_unknowns(3, {1, 1, 1, 0, 0, 0}, std::vector<double>(6, 0.0));
  const Eigen::Vector3d load(-0.8 * P, 0.6 * P, 0.0);  // across the bond
  const Eigen::Vector3d motion = dense(network, {1.0}, unknowns).ldlt().solve(load);
  EXPECT_NEAR(-0.8 * motion[0] + 0.6 * motion[1], P * L * L * L / (3.0 * EI), 1e-12);
  EXPECT_NEAR(0.6 * motion[0] + 0.8 * motion[1], 0.0, 1e-13);
  EXPECT_NEAR(motion[2], P * L * L / (2.0 * EI), 1e-12);
}

TEST(OneFrame, BendsAlikeInEveryPlaneAndTwistsInSpace) {
  constexpr double L = 7.0, EI = 11.0, P = 0.3;
  Network network = single_frame(3, {2.0, 3.0, 6.0}, 14.0, 12.0 * EI / (L * L * L));
  network.torsion = 0.4;
  std::vector<std::uint8_t> held(12, 0);
  std::fill_n(held.begin(), 6, 1);
  const Unknowns unknowns = number_unknowns(6, held, std::vector<double>(12, 0.0));
  const Eigen::MatrixXd stiffness = dense(network, {1.0}, unknowns);
  const Eigen::Vector3d n = Eigen::Vector3d(2.0, 3.0, 6.0) / L;
  for (const Eigen::Vector3d& t : {Eigen::Vector3d(3.0, -2.0, 0.0).normalized(),
                                   Eigen::Vector3d(6.0, 2.0, -3.0).normalized()}) {
    Eigen::VectorXd load = Eigen::VectorXd::Zero(6);
    load.head<3>() = P * t;
    const Eigen::VectorXd motion = stiffness.ldlt().solve(load);
    const Eigen::Vector3d deflection = P * L * L * L / (3.0 * EI) * t;
    const Eigen::Vector3d rotation = P * L * L / (2.0 * EI) * n.cross(t);
    EXPECT_LT((motion.head<3>() - deflection).norm(), 1e-12);
    EXPECT_LT((motion.tail<3>() - rotation).norm(), 1e-12);
  }
  Eigen::VectorXd twist = Eigen::VectorXd::Zero(6);
  twist.tail<3>() = P * n;
  const Eigen::VectorXd motion = stiffness.ldlt().solve(twist);
  EXPECT_LT((motion.tail<3>() - P * L / (0.4 * EI) * n).norm(), 1e-13);
  EXPECT_LT(motion.head<3>().norm(), 1e-13);
}

class MicropolarLattice : public testing::TestWithParam<LatticeCase> {
 protected:
  /// Adds a bar across, whose ties and segments have no moments.
  void SetUp() override {
    const LatticeInput input = body_input(GetParam(), 3);
    NetworkInput constants = micropolar_input(input);
    const Vector3 end = input.solid[0].upper;
    constants.bars = {{{0.03, 0.45 * end[1], 0.4 * end[2]}, {end[0], 0.55 * end[1], 0.5 * end[2]}}};
    constants.bar_materials = {{200.0, 0.001, 0.5, true}};
    network_ = build_network(make_body(input), constants);
    scale_ = largest_of(network_.stiffness);
  }

  Network network_;
  double scale_ = 0.0;
};

TEST_P(MicropolarLattice, RigidMotionsTakeNoForceAndNoEnergy) {
  const std::vector<double> intact(static_cast<std::size_t>(network_.num_elements()), 1.0);
  std::vector<std::array<Vector3, 3>> spins = {{{{0, -1, 0}, {1, 0, 0}, {0, 0, 0}}}};
  if (network_.dim() == 3) spins.push_back({{{0, 0.3, -2}, {-0.3, 0, 1}, {2, -1, 0}}});
  for (const auto& spin : spins) {
    std::vector<double> motion = linear_motion(network_, spin);
    for (std::size_t slot = 0; slot < motion.size(); slot += network_.width()) motion[slot] += 0.7;
    const InternalForce result = internal_force(network_, intact, motion);
    EXPECT_LT(largest_of(result.forces), turning_round_off * scale_);
    EXPECT_LT(result.energy,
              turning_round_off * turning_round_off * scale_ * network_.num_elements());
  }
}

TEST_P(MicropolarLattice, ForceIsTheDerivativeOfTheEnergyAndStiffnessThatOfTheForce) {
  const auto secants = random_secants(network_.num_elements(), 1);
  std::vector<double> motion = random_vector(num_slots(network_), 2);
  const Unknowns unknowns = all_free(network_);
  const Eigen::MatrixXd stiffness = dense(network_, secants, unknowns);
  const InternalForce result = internal_force(network_, secants, motion);
  // The energy is quadratic, so differences have only cancellation errors.
  const double step = 1e-2;
  for (std::size_t slot = 0; slot < motion.size(); slot += 5) {
    const double middle = motion[slot];
    motion[slot] = middle + step;
    const InternalForce above = internal_force(network_, secants, motion);
    motion[slot] = middle - step;
    const InternalForce below = internal_force(network_, secants, motion);
    motion[slot] = middle;
    EXPECT_NEAR((above.energy - below.energy) / (2.0 * step), result.forces[slot],
                1e-12 * result.energy / step);
    const Index column = unknowns.number[slot];
    if (column == no_index) continue;
    for (std::size_t row = 0; row < motion.size(); ++row) {
      if (unknowns.number[row] == no_index) continue;
      ASSERT_NEAR((above.forces[row] - below.forces[row]) / (2.0 * step),
                  stiffness(unknowns.number[row], column), 1e-10 * scale_);
    }
  }
}

TEST_P(MicropolarLattice, ForcesAndMomentsOfTheElementsAreInBalance) {
  const auto secants = random_secants(network_.num_elements(), 3);
  Loads internal;
  internal.forces = internal_force(network_, secants, random_vector(num_slots(network_), 4)).forces;
  const LoadResultant sum = load_resultant(network_, internal);
  EXPECT_LT(largest_of(sum.force), turning_round_off * sum.scale);
  EXPECT_LT(largest_of(sum.moment), turning_round_off * sum.scale);
}

TEST_P(MicropolarLattice, StiffnessIsTheSumOfTheElementVectors) {
  const auto secants = random_secants(network_.num_elements(), 5);
  const Unknowns unknowns = all_free(network_);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(unknowns.count, unknowns.count);
  for (Index e = 0; e < network_.num_elements(); ++e) {
    const ElementVectors parts = element_vectors(network_, unknowns, e, secants[e]);
    EXPECT_EQ(parts.count, e >= network_.first_slip_spring ? 1 : network_.width());
    for (int m = 0; m < parts.count; ++m) {
      for (int a = 0; a < parts.x[m].size(); ++a) {
        for (int b = 0; b < parts.x[m].size(); ++b) {
          sum(parts.x[m].rows[a], parts.x[m].rows[b]) +=
              parts.x[m].values[a] * parts.x[m].values[b];
        }
      }
    }
  }
  EXPECT_LT((sum - dense(network_, secants, unknowns)).cwiseAbs().maxCoeff(),
            turning_round_off * scale_);
}

TEST_P(MicropolarLattice, PrescribedPartsAddToTheDeformation) {
  std::vector<std::uint8_t> held(num_slots(network_), 0);
  for (std::size_t slot = 0; slot < held.size(); slot += 4) held[slot] = 1;
  std::vector<double> motion = random_vector(held.size(), 6), prescribed(held.size(), 0.0);
  for (std::size_t slot = 0; slot < held.size(); slot += 4) prescribed[slot] = motion[slot];
  const Unknowns unknowns = number_unknowns(network_.width(), held, prescribed);
  const std::vector<double> intact(static_cast<std::size_t>(network_.num_elements()), 1.0);
  double energy = 0.0;
  for (Index e = 0; e < network_.num_elements(); ++e) {
    const ElementVectors parts = element_vectors(network_, unknowns, e, 1.0);
    for (int m = 0; m < parts.count; ++m) {
      double deformation = parts.prescribed[m];
      for (int a = 0; a < parts.x[m].size(); ++a) {
        for (std::size_t slot = 0; slot < motion.size(); ++slot) {
          if (unknowns.number[slot] == parts.x[m].rows[a]) {
            deformation += parts.x[m].values[a] * motion[slot];
          }
        }
      }
      energy += 0.5 * deformation * deformation;
    }
  }
  const double expected = internal_force(network_, intact, motion).energy;
  EXPECT_NEAR(energy, expected, 1e-12 * expected);
  const Csr neighbourhoods = bonds_of_particles(network_.bonds, network_.particles.size());
  const auto density = strain_energy_density(network_, intact, motion);
  double sum = 0.0;
  for (Index i = 0; i < network_.particles.size(); ++i) {
    sum += density[i] * network_.particles.volumes[i];
  }
  EXPECT_NEAR(sum, expected, 1e-12 * expected);
}

/// A free body has exactly its rigid modes: displacements determine rotations of particles.
TEST_P(MicropolarLattice, OnlyRigidMotionsAreFree) {
  const std::vector<double> intact(static_cast<std::size_t>(network_.num_elements()), 1.0);
  const Eigen::VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense(network_, intact, all_free(network_)))
          .eigenvalues();
  const int modes = network_.dim() == 2 ? 3 : 6;
  EXPECT_LT(eigenvalues[modes - 1], turning_round_off * scale_);
  EXPECT_GT(eigenvalues[modes], 1e-6 * scale_);
  std::vector<std::uint8_t> held(num_slots(network_), 0);
  const auto fragments = find_fragments(network_, held);
  ASSERT_EQ(fragments.size(), 1U);
  EXPECT_EQ(fragments[0].free_modes, modes);
  pin_rigid_modes(network_, fragments[0], held);
  EXPECT_EQ(std::count(held.begin(), held.end(), 1), modes);
  hold_idle_rotations(network_, held);
  const Unknowns unknowns =
      number_unknowns(network_.width(), held, std::vector<double>(held.size(), 0.0));
  const Eigen::VectorXd pinned =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense(network_, intact, unknowns))
          .eigenvalues();
  EXPECT_GT(pinned[0], 1e-6 * scale_);
}

/// Particles with ties and bar segments only have no unknown rotations.
TEST_P(MicropolarLattice, NodesOfBarsDoNotRotate) {
  const Unknowns unknowns = all_free(network_);
  int bars = 0;
  for (Index i = 0; i < network_.particles.size(); ++i) {
    const bool bar = network_.particles.kind[i] == ParticleKind::rebar;
    bars += bar;
    for (int a = 0; a < network_.width(); ++a) {
      EXPECT_EQ(unknowns.at(i, a) == no_index, bar && a >= network_.dim());
    }
  }
  EXPECT_GT(bars, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Lattices, MicropolarLattice,
    testing::Values(LatticeCase{"rectangular", Pattern::rectangular, Surface::none},
                    LatticeCase{"hexagonal", Pattern::hexagonal, Surface::none},
                    LatticeCase{"hexagonal_ghost", Pattern::hexagonal, Surface::ghost},
                    LatticeCase{"cubic", Pattern::cubic, Surface::none},
                    LatticeCase{"face_centred", Pattern::face_centred, Surface::none}),
    [](const auto& tested) { return tested.param.name; });

/// An interior particle in a homogeneous strain without rotation has no force and no moment. Its
/// energy equals the energy of the given solid.
TEST(MicropolarBulk, HasYoungsModulusAndPoissonsRatio) {
  for (const double nu : {-0.2, 0.0, 0.2, 0.3}) {
    const LatticeInput body = body_input({"", Pattern::hexagonal, Surface::none}, 10);
    const Network network = build_network(make_body(body), micropolar_input(body, nu));
    const std::vector<double> intact(static_cast<std::size_t>(network.num_elements()), 1.0);
    const Csr neighbourhoods = bonds_of_particles(network.bonds, network.particles.size());
    const auto from_middle = [&](Index i) {
      const auto x = network.particles.position(i);
      return std::hypot(x[0] - 0.5 * body.solid[0].upper[0], x[1] - 0.5 * body.solid[0].upper[1]);
    };
    Index middle = 0;
    for (Index i = 0; i < network.particles.size(); ++i) {
      if (from_middle(i) < from_middle(middle)) middle = i;
    }
    const auto energy = [&](double exx, double eyy, double exy) {
      const auto motion = linear_motion(network, {{{exx, exy, 0}, {exy, eyy, 0}, {0, 0, 0}}});
      const auto forces = internal_force(network, intact, motion).forces;
      for (int a = 0; a < 3; ++a) EXPECT_LT(std::abs(forces[3 * middle + a]), 1e-11);
      return strain_energy_density(network, intact, motion)[middle];
    };
    const double C11 = 2.0 * energy(1, 0, 0), C22 = 2.0 * energy(0, 1, 0),
                 C66 = 0.5 * energy(0, 0, 1);
    const double C12 = energy(1, 1, 0) - 0.5 * (C11 + C22);
    EXPECT_NEAR(C12 / C11, nu, 1e-12);
    EXPECT_NEAR(C11 - C12 * C12 / C22, 30.0, 1e-11);
    EXPECT_NEAR(C22, C11, 1e-11);
    EXPECT_NEAR(C66, 15.0 / (1.0 + nu), 1e-11);
  }
}

/// Single bond with its inflection away from the middle; forces from the matrix of its modes.
class Inflected : public testing::TestWithParam<int> {
 protected:
  Network make(double inflection) const {
    const int dim = GetParam();
    Network network = single_frame(
        dim, dim == 2 ? std::vector{0.6, 0.8} : std::vector{0.48, 0.64, -0.6}, 3.0, 0.7);
    network.inflection = {inflection};
    return network;
  }
};

TEST_P(Inflected, BondsResistNoRigidMotion) {
  const Network network = make(-0.3);
  const auto motion = linear_motion(network, {{{0, 0.4, -0.2}, {-0.4, 0, 0.9}, {0.2, -0.9, 0}}});
  const std::vector<double> intact = {1.0};
  for (const double f : internal_force(network, intact, motion).forces) EXPECT_NEAR(f, 0.0, 1e-15);
}

/// In a uniform strain without rotations the inflection divides the couple k_b xi^2 n x (eps n)
/// between the ends. Forces do not depend on it.
TEST_P(Inflected, EndsShareTheCouple) {
  const std::array<Vector3, 3> strain = {{{1.0, 0.3, -0.2}, {0.3, -0.5, 0.1}, {-0.2, 0.1, 0.4}}};
  const std::vector<double> intact = {1.0};
  const Network middle = make(0.5), moved = make(0.8);
  const int dim = middle.dim(), width = middle.width();
  const auto motion = linear_motion(middle, strain);
  const auto half = internal_force(middle, intact, motion).forces;
  const auto split = internal_force(moved, intact, motion).forces;
  for (int end = 0; end < 2; ++end) {
    for (int a = 0; a < width; ++a) {
      const double share = a < dim ? 1.0 : end == 0 ? 1.6 : 0.4;
      EXPECT_NEAR(split[end * width + a], share * half[end * width + a], 1e-15);
    }
  }
}

/// The equivalent stretch of the search is sqrt(2 U / (k xi^2)).
TEST_P(Inflected, SearchMeasuresTheEnergy) {
  const Network network = make(0.2);
  const std::vector<double> intact = {1.0};
  std::vector<double> motion = {0.1, -0.3, 0.2, 0.5, 0.4, 0.3};
  if (GetParam() == 3) motion = {0.1, -0.3, 0.2, 0.5, 0.1, -0.2, 0.4, 0.3, -0.6, 0.1, 0.7, 0.2};
  const auto forces = internal_force(network, intact, motion).forces;
  double work = 0.0;
  for (std::size_t k = 0; k < motion.size(); ++k) work += forces[k] * motion[k];
  FrameLimitSearch search(network);
  const BreakSearch::Hit hit = search.find(motion, 0.0, 1);
  ASSERT_EQ(hit.element, 0);
  EXPECT_NEAR(hit.ratio, std::sqrt(work / 3.0) / network.critical_stretch[0], 1e-11);
}

INSTANTIATE_TEST_SUITE_P(InPlaneAndSpace, Inflected, testing::Values(2, 3));

/// In a homogeneous strain the bonds of a calibrated body break by direction and length, not by
/// their calibrated stiffness. Bonds break in the order of s^2 + b (g / xi)^2 / xi^2. Here s =
/// n.eps n, g / xi = t.eps n, and b is one number for the body.
TEST(UnstructuredMicropolar, BreaksByTheStrainAlone) {
  const Network network =
      build_network(make_unstructured(1, 10), unstructured_micropolar_input(10));
  ASSERT_LT(network.report.calibration->smallest_weight, 0.5);
  const double b = network.ratio_of_bending(0) * std::pow(network.bonds.lengths[0], 2);
  const auto measure = [&](Index e, double exx, double eyy, double exy) {
    const auto n = network.bonds.direction(e);
    const double s = exx * n[0] * n[0] + eyy * n[1] * n[1] + 2.0 * exy * n[0] * n[1];
    const double g = (eyy - exx) * n[0] * n[1] + exy * (n[0] * n[0] - n[1] * n[1]);
    return s > 0.0 ? std::sqrt(s * s + b * std::pow(g / network.bonds.lengths[e], 2)) : 0.0;
  };
  for (const auto& [exx, eyy, exy] :
       {std::array{1.0, -0.2, 0.0}, {1.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}) {
    const auto motion = linear_motion(network, {{{exx, exy, 0}, {exy, eyy, 0}, {0, 0, 0}}});
    FrameLimitSearch search(network);
    std::vector<double> found, expected;
    for (Index e = 0; e < network.num_elements(); ++e) {
      const BreakSearch::Hit hit = search.find(motion, 0.0, 1);
      if (hit.element == no_index) break;
      found.push_back(hit.ratio * network.critical_stretch[hit.element]);
      expected.push_back(measure(hit.element, exx, eyy, exy));
      search.set_limit(hit.element, INFINITY);
    }
    EXPECT_GT(found.size(), 0.3 * network.num_elements());
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_NEAR(found[k], expected[k], turning_round_off * expected.front());
    }
  }
}

}  // namespace
}  // namespace perilink

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "assembly/fields.hpp"
#include "assembly/internal_force.hpp"
#include "assembly/stiffness.hpp"
#include "discretization/lattices/make_body.hpp"
#include "material/critical_stretch.hpp"
#include "material/micromodulus.hpp"
#include "support/small_networks.hpp"

namespace perilink {
namespace {

using namespace test;

/// Round-off of a sum over the bonds of a particle, relative to the stiffest bond times
/// displacement.
constexpr double round_off = 1e-12;

double largest(const std::vector<double>& values) {
  double result = 0.0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

class NetworkProperty : public testing::TestWithParam<LatticeCase> {
 protected:
  void SetUp() override {
    // A bar across adds ties and segments where the surface allows it; it passes between particles.
    const LatticeInput input = body_input(GetParam(), 4);
    NetworkInput constants = network_input(input);
    const Vector3 end = input.solid[0].upper;
    constants.bars = {{{0.03, 0.45 * end[1], 0.4 * end[2]}, {end[0], 0.55 * end[1], 0.5 * end[2]}}};
    constants.bar_materials = {{200.0, 0.001, 0.5, true}};
    network_ = build_network(make_body(input), constants);
    intact_.assign(static_cast<std::size_t>(network_.num_elements()), 1.0);
    scale_ = largest(network_.stiffness);
  }

  std::size_t num_slots() const { return network_.particles.positions.size(); }

  Unknowns all_free() const {
    return number_unknowns(network_.dim(), std::vector<std::uint8_t>(num_slots(), 0),
                           std::vector<double>(num_slots(), 0.0));
  }

  Eigen::MatrixXd dense_stiffness(const std::vector<double>& secants) const {
    const auto lower = assemble_stiffness(network_, secants, all_free());
    return Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>();
  }

  Network network_;
  std::vector<double> intact_;
  double scale_ = 0.0;
};

TEST_P(NetworkProperty, RigidMotionsTakeNoForceAndNoEnergy) {
  const int dim = network_.dim();
  std::vector<std::vector<double>> motions;
  for (int axis = 0; axis < dim; ++axis) {
    std::vector<double> translation(num_slots(), 0.0);
    for (std::size_t slot = axis; slot < num_slots(); slot += dim) translation[slot] = 1.0;
    motions.push_back(translation);
    if (dim == 2 && axis == 1) continue;
    std::array<Vector3, 3> spin{};
    const int next = (axis + 1) % 3;
    const int last = dim == 2 ? 0 : (axis + 2) % 3;
    spin[next][dim == 2 ? 0 : last] = 1.0;
    spin[dim == 2 ? 0 : last][next] = -1.0;
    motions.push_back(linear_field(network_.particles, spin));
  }
  for (const auto& motion : motions) {
    const InternalForce result = internal_force(network_, intact_, motion);
    EXPECT_LT(largest(result.forces), round_off * scale_);
    EXPECT_LT(result.energy, round_off * round_off * scale_ * network_.num_elements());
  }
}

TEST_P(NetworkProperty, ForcesAndMomentsOfAnyDisplacementBalance) {
  const auto displacement = random_vector(num_slots(), 3);
  const auto secants = random_secants(network_.num_elements(), 4);
  const InternalForce result = internal_force(network_, secants, displacement);
  const int dim = network_.dim();
  Vector3 force{};
  Vector3 moment{};
  for (Index i = 0; i < network_.particles.size(); ++i) {
    Vector3 x{};
    Vector3 f{};
    for (int axis = 0; axis < dim; ++axis) {
      x[axis] = network_.particles.position(i)[axis];
      f[axis] = result.forces[static_cast<std::size_t>(i) * dim + axis];
    }
    for (int k = 0; k < 3; ++k) {
      force[k] += f[k];
      moment[k] += x[(k + 1) % 3] * f[(k + 2) % 3] - x[(k + 2) % 3] * f[(k + 1) % 3];
    }
  }
  for (int k = 0; k < 3; ++k) {
    EXPECT_LT(std::abs(force[k]), round_off * scale_ * network_.particles.size());
    EXPECT_LT(std::abs(moment[k]), round_off * scale_ * network_.particles.size());
  }
}

TEST_P(NetworkProperty, ForceIsTheDerivativeOfTheEnergy) {
  auto displacement = random_vector(num_slots(), 5);
  for (const auto& secants : {intact_, random_secants(network_.num_elements(), 6)}) {
    const InternalForce result = internal_force(network_, secants, displacement);
    constexpr double step = 1e-2;  // the energy is quadratic: no truncation error
    for (std::size_t slot = 0; slot < num_slots(); slot += 7) {
      const double kept = displacement[slot];
      displacement[slot] = kept + step;
      const double above = internal_force(network_, secants, displacement).energy;
      displacement[slot] = kept - step;
      const double below = internal_force(network_, secants, displacement).energy;
      displacement[slot] = kept;
      // Cancellation of the total energy over the step.
      EXPECT_NEAR((above - below) / (2.0 * step), result.forces[slot],
                  1e-14 * result.energy / step + round_off * scale_);
    }
  }
}

TEST_P(NetworkProperty, StiffnessIsTheDerivativeOfTheForce) {
  for (const auto& secants : {intact_, random_secants(network_.num_elements(), 8)}) {
    const Eigen::MatrixXd stiffness = dense_stiffness(secants);
    std::vector<double> displacement(num_slots(), 0.0);
    for (std::size_t column = 0; column < num_slots(); ++column) {
      displacement[column] = 0.5;  // force is linear and odd, so one difference is exact
      const InternalForce result = internal_force(network_, secants, displacement);
      displacement[column] = 0.0;
      for (std::size_t row = 0; row < num_slots(); ++row) {
        ASSERT_NEAR(stiffness(row, column), 2.0 * result.forces[row], round_off * scale_);
      }
    }
  }
}

TEST_P(NetworkProperty, StiffnessHasOnlyTheRigidModesForZeroModes) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(dense_stiffness(intact_),
                                                             Eigen::EigenvaluesOnly);
  const auto& eigenvalues = modes.eigenvalues();
  const Index rigid = network_.dim() == 2 ? 3 : 6;
  const double top = eigenvalues[eigenvalues.size() - 1];
  // Backward error of the dense solver; the softest elastic mode of these bodies is above 1e-4.
  EXPECT_LT(std::abs(eigenvalues[0]), 1e-13 * top);
  EXPECT_LT(std::abs(eigenvalues[rigid - 1]), 1e-13 * top);
  EXPECT_GT(eigenvalues[rigid], 1e-6 * top);
}

TEST_P(NetworkProperty, StiffnessOfADamagedNetworkHasNoNegativeModes) {
  const auto secants = random_secants(network_.num_elements(), 9);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(dense_stiffness(secants),
                                                             Eigen::EigenvaluesOnly);
  const auto& eigenvalues = modes.eigenvalues();
  EXPECT_GT(eigenvalues[0], -1e-13 * eigenvalues[eigenvalues.size() - 1]);
}

TEST_P(NetworkProperty, BreakingElementsKeepsThePattern) {
  const auto whole = assemble_stiffness(network_, intact_, all_free());
  const auto damaged =
      assemble_stiffness(network_, random_secants(network_.num_elements(), 10), all_free());
  ASSERT_EQ(whole.nonZeros(), damaged.nonZeros());
  for (Index entry = 0; entry < whole.nonZeros(); ++entry) {
    ASSERT_EQ(whole.innerIndexPtr()[entry], damaged.innerIndexPtr()[entry]);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Lattices, NetworkProperty,
    testing::Values(LatticeCase{"rectangular", Pattern::rectangular, Surface::none},
                    LatticeCase{"rectangular_ghost", Pattern::rectangular, Surface::ghost},
                    LatticeCase{"hexagonal", Pattern::hexagonal, Surface::none},
                    LatticeCase{"hexagonal_ghost", Pattern::hexagonal, Surface::ghost},
                    LatticeCase{"cubic", Pattern::cubic, Surface::none},
                    LatticeCase{"face_centred", Pattern::face_centred, Surface::none}),
    [](const auto& tested) { return tested.param.name; });

class BulkProperty : public testing::TestWithParam<LatticeCase> {
 protected:
  static constexpr int columns = 10;

  /// Returns a particle farther than the horizon from every surface.
  static Index middle(const Particles& particles, const Box& box) {
    Index best = 0;
    double least = 1e300;
    for (Index i = 0; i < particles.size(); ++i) {
      double distance = 0.0;
      for (int axis = 0; axis < particles.dim; ++axis) {
        distance +=
            std::pow(particles.position(i)[axis] - 0.5 * (box.lower[axis] + box.upper[axis]), 2);
      }
      if (distance < least) {
        least = distance;
        best = i;
      }
    }
    return best;
  }

  static double bulk_energy(const LatticeInput& body, Problem problem,
                            const std::array<Vector3, 3>& strain) {
    NetworkInput constants = network_input(body);
    constants.problem = problem;
    const Network network = build_network(make_body(body), constants);
    const std::vector<double> secants(static_cast<std::size_t>(network.num_elements()), 1.0);
    const Csr neighbourhoods = bonds_of_particles(network.bonds, network.particles.size());
    const auto density =
        strain_energy_density(network, secants, linear_field(network.particles, strain));
    return density[middle(network.particles, body.solid[0])];
  }
};

TEST_P(BulkProperty, HomogeneousStrainHasTheEnergyOfTheContinuum) {
  const LatticeInput body = body_input(GetParam(), columns);
  const Lattice lattice = make_body(body).lattice;
  const InteriorNeighbourhood neighbourhood = interior_neighbourhood(lattice, body.horizon);
  const double modulus = network_input(body).materials[0].youngs_modulus;
  const auto poisson = [&](Problem problem) {
    return lattice_moduli(problem, neighbourhood.offsets, lattice.cell_volume).poissons_ratio;
  };
  if (!is_plane(body.pattern)) {
    const double nu = poisson(Problem::three_dimensional);
    const std::array<Vector3, 3> swelling = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const double bulk_modulus = modulus / (3.0 * (1.0 - 2.0 * nu));
    EXPECT_NEAR(bulk_energy(body, Problem::three_dimensional, swelling), 4.5 * bulk_modulus,
                round_off * modulus);
    return;
  }
  // Uniaxial stress along an axis of the lattice: E / 2 per unit strain squared.
  const double nu = poisson(Problem::plane_stress);
  const std::array<Vector3, 3> uniaxial = {{{1, 0, 0}, {0, -nu, 0}, {}}};
  EXPECT_NEAR(bulk_energy(body, Problem::plane_stress, uniaxial), 0.5 * modulus,
              round_off * modulus);
  // Uniaxial strain: (lambda + 2 mu) / 2.
  const double nu3 = poisson(Problem::plane_strain);
  const std::array<Vector3, 3> confined = {{{1, 0, 0}, {}, {}}};
  EXPECT_NEAR(bulk_energy(body, Problem::plane_strain, confined),
              0.5 * modulus * (1.0 - nu3) / ((1.0 + nu3) * (1.0 - 2.0 * nu3)), round_off * modulus);
}

TEST_P(BulkProperty, AStraightCrackReleasesTheFractureSum) {
  const LatticeInput input = body_input(GetParam(), 14);
  const Body body = make_body(input);
  const NetworkInput constants = network_input(input);
  const Network network = build_network(body, constants);
  const Lattice& lattice = body.lattice;
  const int dim = lattice.dim;
  const int normal = dim - 1;
  // The crack runs between two rows in the middle. Bonds with their lower end in a window of whole
  // periods, away from the surfaces, belong to the window's part of the crack.
  const auto middle_row = std::floor(0.5 * input.solid[0].upper[normal] / lattice.step[normal]);
  const double crack = (middle_row + 0.5) * lattice.step[normal];
  double area = dim == 2 ? input.thickness : 1.0;
  Box window = {{-1e9, -1e9, -1e9}, {1e9, 1e9, 1e9}};
  for (int axis = 0; axis < normal; ++axis) {
    const double middle = 0.5 * input.solid[0].upper[axis];
    window.lower[axis] = middle - 1.1 * lattice.step[axis];
    window.upper[axis] = middle + 0.9 * lattice.step[axis];
    area *= 2.0 * lattice.step[axis];
  }
  double released = 0.0;  // at unit stretch
  for (Index b = 0; b < network.num_elements(); ++b) {
    auto low = network.particles.position(network.bonds.first[b]);
    auto high = network.particles.position(network.bonds.second[b]);
    if (low[normal] > high[normal]) std::swap(low, high);
    if (low[normal] > crack || high[normal] < crack || !window.contains(low, 0.0)) continue;
    const double length = network.bonds.lengths[b];
    released += 0.5 * network.stiffness[b] * length * length;
  }
  const InteriorNeighbourhood neighbourhood = interior_neighbourhood(lattice, input.horizon);
  const double c = moduli_of(body, constants, constants.materials[0]).micromodulus;
  Vector3 direction{};
  direction[normal] = 1.0;
  const double sum = lattice_fracture_sum(constants.problem, neighbourhood.offsets,
                                          lattice.cell_volume, c, direction);
  EXPECT_NEAR(released / area, 0.5 * sum, round_off * sum);
}

INSTANTIATE_TEST_SUITE_P(
    Lattices, BulkProperty,
    testing::Values(LatticeCase{"rectangular", Pattern::rectangular, Surface::none},
                    LatticeCase{"hexagonal", Pattern::hexagonal, Surface::none},
                    LatticeCase{"cubic", Pattern::cubic, Surface::none},
                    LatticeCase{"face_centred", Pattern::face_centred, Surface::none}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace perilink

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <vector>

#include "assembly/internal_force.hpp"
#include "assembly/stiffness.hpp"
#include "support/lattice_networks.hpp"
#include "support/small_networks.hpp"

namespace perilink {
namespace {

using namespace test;

/// Two particles a distance 5 apart in the direction (0.6, 0.8), joined by `count` elements.
Network pair_network(int count) {
  Network network;
  network.particles.dim = 2;
  network.particles.positions = {0.0, 0.0, 3.0, 4.0};
  network.particles.volumes = {1.0, 1.0};
  network.particles.material = {0, 0};
  network.particles.kind = {ParticleKind::solid, ParticleKind::solid};
  for (int n = 0; n < count; ++n) network.bonds.append(network.particles, 0, 1);
  network.stiffness.assign(static_cast<std::size_t>(count), 100.0);
  network.critical_stretch.assign(static_cast<std::size_t>(count), 1e-3);
  network.first_slip_spring = network.first_bar_element = count;
  return network;
}

Eigen::MatrixXd dense(const Eigen::SparseMatrix<double, Eigen::ColMajor, Index>& lower) {
  return Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>();
}

TEST(Stiffness, OfOneElementIsItsDirectionSquared) {
  const Network network = pair_network(1);
  const Unknowns unknowns = number_unknowns(2, {0, 0, 0, 0}, {0, 0, 0, 0});
  const auto lower = assemble_stiffness(network, std::vector<double>{0.5}, unknowns);
  const Eigen::Vector4d b(-0.6, -0.8, 0.6, 0.8);
  EXPECT_LT((dense(lower) - 50.0 * b * b.transpose()).cwiseAbs().maxCoeff(), 1e-13);
}

// A bar along a row of particles doubles the bonds there.
TEST(Stiffness, ElementsBetweenTheSamePairAddUp) {
  const Network network = pair_network(3);
  const Unknowns unknowns = number_unknowns(2, {0, 0, 0, 0}, {0, 0, 0, 0});
  const auto lower = assemble_stiffness(network, std::vector<double>{1.0, 0.0, 1.0}, unknowns);
  EXPECT_EQ(lower.nonZeros(), 10);
  const Eigen::Vector4d b(-0.6, -0.8, 0.6, 0.8);
  EXPECT_LT((dense(lower) - 200.0 * b * b.transpose()).cwiseAbs().maxCoeff(), 1e-13);
}

class StiffnessOfLattice : public testing::TestWithParam<LatticeCase> {};

TEST_P(StiffnessOfLattice, LeavesOutHeldUnknownsAndSortsItsRows) {
  const Network network = make_network(GetParam(), 4);
  const std::size_t slots = network.particles.positions.size();
  std::vector<std::uint8_t> held(slots, 0);
  for (std::size_t slot = 0; slot < slots; slot += 3) held[slot] = 1;
  const std::vector<double> secants = random_secants(network.num_elements(), 1);
  const std::vector<double> zero(slots, 0.0);
  const Unknowns all = number_unknowns(network.dim(), std::vector<std::uint8_t>(slots, 0), zero);
  const Unknowns some = number_unknowns(network.dim(), held, zero);
  const Eigen::MatrixXd whole = dense(assemble_stiffness(network, secants, all));
  const auto lower = assemble_stiffness(network, secants, some);
  const Eigen::MatrixXd part = dense(lower);
  ASSERT_EQ(part.rows(), some.count);
  for (std::size_t row = 0; row < slots; ++row) {
    for (std::size_t col = 0; col < slots; ++col) {
      if (some.number[row] == no_index || some.number[col] == no_index) continue;
      ASSERT_EQ(part(some.number[row], some.number[col]), whole(row, col));
    }
  }
  for (Index column = 0; column < lower.cols(); ++column) {
    Index before = column - 1;  // the diagonal comes first
    for (Index entry = lower.outerIndexPtr()[column]; entry < lower.outerIndexPtr()[column + 1];
         ++entry) {
      ASSERT_GT(lower.innerIndexPtr()[entry], before);
      before = lower.innerIndexPtr()[entry];
    }
    ASSERT_EQ(lower.innerIndexPtr()[lower.outerIndexPtr()[column]], column);
  }
}

TEST_P(StiffnessOfLattice, SolvesADrivenBodyToEquilibrium) {
  const Network network = make_network(GetParam(), 4);
  const int dim = network.dim();
  const std::size_t slots = network.particles.positions.size();
  const std::vector<double> secants(static_cast<std::size_t>(network.num_elements()), 1.0);
  // Left face held, right face driven, a force on every other particle.
  std::vector<std::uint8_t> held(slots, 0);
  std::vector<double> prescribed(slots, 0.0);
  Loads loads{random_vector(slots, 2)};
  double right = 0.0;
  for (Index i = 0; i < network.particles.size(); ++i) {
    right = std::max(right, network.particles.position(i)[0]);
  }
  for (Index i = 0; i < network.particles.size(); ++i) {
    const double x = network.particles.position(i)[0];
    if (x > 1e-9 && x < right - 1e-9) continue;
    for (int axis = 0; axis < dim; ++axis) {
      const std::size_t slot = static_cast<std::size_t>(i) * dim + axis;
      held[slot] = 1;
      prescribed[slot] = x > 1e-9 ? 0.01 * (axis + 1) : 0.0;
    }
  }
  const Unknowns unknowns = number_unknowns(dim, held, prescribed);
  const Eigen::MatrixXd stiffness = dense(assemble_stiffness(network, secants, unknowns));
  const auto f = assemble_right_hand_side(network, secants, unknowns, loads);
  const Eigen::VectorXd solution =
      stiffness.llt().solve(Eigen::Map<const Eigen::VectorXd>(f.data(), unknowns.count));
  const auto displacement =
      unknowns.expand({solution.data(), static_cast<std::size_t>(solution.size())});
  const auto forces = internal_force(network, secants, displacement).forces;
  for (std::size_t slot = 0; slot < slots; ++slot) {
    if (held[slot]) {
      EXPECT_EQ(displacement[slot], prescribed[slot]);
    } else {
      // Backward error of the dense solve: condition below 1e4 here, forces of order one.
      EXPECT_NEAR(forces[slot], loads.forces[slot], 1e-10);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Lattices, StiffnessOfLattice,
    testing::Values(LatticeCase{"rectangular", Pattern::rectangular, Surface::none},
                    LatticeCase{"hexagonal", Pattern::hexagonal, Surface::none},
                    LatticeCase{"cubic", Pattern::cubic, Surface::none}),
    [](const auto& tested) { return tested.param.name; });

TEST(StiffnessOfElasticSupports, IsOnTheDiagonalOfWhatIsFree) {
  Network network = make_network({"", Pattern::cubic, Surface::none}, 2);
  const std::size_t slots = network.particles.positions.size();
  const auto secants = random_secants(network.num_elements(), 1);
  std::vector<std::uint8_t> held(slots, 0);
  held[4] = 1;
  const Unknowns unknowns = number_unknowns(3, held, std::vector<double>(slots, 0.0));
  const Eigen::MatrixXd without = dense(assemble_stiffness(network, secants, unknowns));
  network.support_stiffness.assign(slots, 0.0);
  network.support_stiffness[3] = 2.0;
  network.support_stiffness[4] = 4.0;  // at a held displacement: no unknown feels it
  network.support_stiffness[5] = 8.0;
  const Eigen::MatrixXd added = dense(assemble_stiffness(network, secants, unknowns)) - without;
  for (Index row = 0; row < unknowns.count; ++row) {
    for (Index col = 0; col < unknowns.count; ++col) {
      const double expected = row != col ? 0.0 : row == 3 ? 2.0 : row == 4 ? 8.0 : 0.0;
      EXPECT_NEAR(added(row, col), expected, 1e-12);
    }
  }
}

class StateStiffness : public testing::TestWithParam<testing_support::StateLatticeCase> {
 protected:
  StateStiffness()
      : network_(lattice_network(testing_support::state_block(GetParam(), 2.1)).network) {
    const auto elements = static_cast<std::size_t>(network_.num_elements());
    secants_ = testing_support::random_values(elements, 1, 0.0, 1.0);
    for (std::size_t e = 0; e < elements; e += 5) secants_[e] = 0.0;
    slots_ = network_.particles.positions.size();
  }

  Eigen::MatrixXd dense(const std::vector<std::uint8_t>& held) const {
    const Unknowns unknowns =
        number_unknowns(network_.dim(), held, std::vector<double>(slots_, 0.0));
    return Eigen::MatrixXd(assemble_stiffness(network_, secants_, unknowns))
        .selfadjointView<Eigen::Lower>();
  }

  Network network_;
  std::vector<double> secants_;
  std::size_t slots_ = 0;
};

TEST_P(StateStiffness, IsTheMatrixOfTheInternalForces) {
  const Eigen::MatrixXd matrix = dense(std::vector<std::uint8_t>(slots_, 0));
  double worst = 0.0;
  for (std::size_t column = 0; column < slots_; ++column) {
    std::vector<double> unit(slots_, 0.0);
    unit[column] = 1.0;
    const std::vector<double> forces = internal_force(network_, secants_, unit).forces;
    for (std::size_t row = 0; row < slots_; ++row) {
      worst = std::max(worst, std::abs(matrix(row, column) - forces[row]));
    }
  }
  // Sums of up to 400 products, in another order; the matrix is symmetric by storage, so that the
  // forces are seen to derive from an energy.
  EXPECT_LT(worst, 1e-13 * matrix.cwiseAbs().maxCoeff());
}

TEST_P(StateStiffness, HasItsSupportsOnTheDiagonal) {
  const Eigen::MatrixXd without = dense(std::vector<std::uint8_t>(slots_, 0));
  network_.support_stiffness = testing_support::random_values(slots_, 2, 1.0, 2.0);
  const Eigen::MatrixXd with = dense(std::vector<std::uint8_t>(slots_, 0));
  const double size = without.cwiseAbs().maxCoeff();
  for (std::size_t slot = 0; slot < slots_; ++slot) {
    EXPECT_NEAR(with(slot, slot) - without(slot, slot), network_.support_stiffness[slot],
                1e-15 * size);
  }
}

TEST_P(StateStiffness, LeavesOutHeldUnknownsAndSortsItsRows) {
  std::vector<std::uint8_t> held(slots_, 0);
  for (std::size_t slot = 0; slot < slots_; slot += 3) held[slot] = 1;
  const std::vector<double> zero(slots_, 0.0);
  const Unknowns some = number_unknowns(network_.dim(), held, zero);
  const auto lower = assemble_stiffness(network_, secants_, some);
  const Eigen::MatrixXd whole = dense(std::vector<std::uint8_t>(slots_, 0));
  const Eigen::MatrixXd part = Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>();
  ASSERT_EQ(part.rows(), some.count);
  for (std::size_t row = 0; row < slots_; ++row) {
    for (std::size_t col = 0; col < slots_; ++col) {
      if (some.number[row] == no_index || some.number[col] == no_index) continue;
      ASSERT_EQ(part(some.number[row], some.number[col]),
                row >= col ? whole(row, col) : whole(col, row));
    }
  }
  for (Index column = 0; column < lower.cols(); ++column) {
    Index before = column - 1;  // the diagonal comes first
    for (Index entry = lower.outerIndexPtr()[column]; entry < lower.outerIndexPtr()[column + 1];
         ++entry) {
      ASSERT_GT(lower.innerIndexPtr()[entry], before);
      before = lower.innerIndexPtr()[entry];
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, StateStiffness,
                         testing::ValuesIn(testing_support::state_lattice_cases()),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace perilink

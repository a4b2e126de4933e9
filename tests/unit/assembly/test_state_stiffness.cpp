#include "assembly/state_stiffness.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <vector>

#include "assembly/internal_force.hpp"
#include "assembly/stiffness.hpp"
#include "support/lattice_networks.hpp"

namespace perilink {
namespace {

using namespace testing_support;

class StateStiffness : public testing::TestWithParam<StateLatticeCase> {
 protected:
  StateStiffness() : network_(lattice_network(state_block(GetParam(), 2.1)).network) {
    const auto elements = static_cast<std::size_t>(network_.num_elements());
    secants_ = random_values(elements, 1, 0.0, 1.0);
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
  network_.support_stiffness = random_values(slots_, 2, 1.0, 2.0);
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
  const auto lower = assemble_state_stiffness(network_, secants_, some);
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

INSTANTIATE_TEST_SUITE_P(All, StateStiffness, testing::ValuesIn(state_lattice_cases()),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace perilink

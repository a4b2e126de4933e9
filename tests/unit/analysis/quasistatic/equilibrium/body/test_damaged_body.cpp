#include "analysis/quasistatic/equilibrium/body/damaged_body.hpp"

#include <gtest/gtest.h>

#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

class DamagedBodies : public testing::Test {
 protected:
  DamagedBodies()
      : problem_(make_block({hexagonal, false, false, 6, 0.1, false, true, true})),
        body_(problem_, problem_.unknowns, nullptr) {
    while (!problem_.network.has_limit(bond_)) ++bond_;
  }

  AnalysisBody problem_;
  DamagedBody body_;
  Index bond_ = 0;
};

TEST_F(DamagedBodies, MultiplyByTheStiffnessOfPresentElements) {
  body_.weaken(bond_, 0.3);
  body_.turn(bond_);
  body_.weaken(bond_ + 1, 0.0);
  body_.add_ground_spring(3, 7.0);
  std::vector<double> q(body_.num_unknowns()), result(q.size());
  for (std::size_t k = 0; k < q.size(); ++k) q[k] = std::cos(static_cast<double>(k));
  body_.multiply(q, result);
  const Eigen::VectorXd expected =
      Eigen::MatrixXd(body_.stiffness()).selfadjointView<Eigen::Lower>() *
      Eigen::Map<const Eigen::VectorXd>(q.data(), static_cast<Index>(q.size()));
  // Round-off of the sums over the bonds of a particle.
  for (std::size_t k = 0; k < q.size(); ++k) EXPECT_NEAR(result[k], expected[k], 1e-13 * 7.0) << k;
}

TEST_F(DamagedBodies, KeepUnilateralElementsInTheOrderOfDamage) {
  body_.weaken(bond_ + 2, 0.5);
  body_.weaken(bond_, 0.5);
  body_.weaken(bond_ + 2, 0.2);
  ASSERT_EQ(body_.unilateral().size(), 2u);
  EXPECT_EQ(body_.unilateral()[0].element, bond_ + 2);
  EXPECT_EQ(body_.unilateral()[1].element, bond_);
  EXPECT_FALSE(body_.is_closed(bond_));
  body_.turn(bond_);
  EXPECT_TRUE(body_.is_closed(bond_));
  EXPECT_EQ(body_.secants()[bond_], 0.5);
  EXPECT_EQ(body_.secants().axial(bond_), 1.0);
  body_.take_back(bond_, 1.0, true);
  ASSERT_EQ(body_.unilateral().size(), 1u);
  EXPECT_EQ(body_.unilateral()[0].element, bond_ + 2);
}

TEST_F(DamagedBodies, AreRebuiltFromTheirState) {
  body_.weaken(bond_, 0.5);
  body_.weaken(bond_ + 1, 0.0);
  body_.turn(bond_ + 1);
  body_.add_ground_spring(1, 2.0);
  const ElementState state = body_.state();
  const DamagedBody again(problem_, problem_.unknowns, &state);
  EXPECT_EQ(again.state().secants, state.secants);
  EXPECT_EQ(again.state().axial, state.axial);
  EXPECT_EQ(again.state().damaged, (std::vector<Index>{bond_, bond_ + 1}));
  EXPECT_EQ(again.ground_stiffness(), state.ground_stiffness);
  EXPECT_TRUE(again.is_closed(bond_ + 1));
}

TEST_F(DamagedBodies, AreGroundedAtTheEndsOfASpring) {
  EXPECT_FALSE(body_.is_grounded(bond_));
  const Index end = problem_.network.bonds.first[bond_];
  body_.add_ground_spring(problem_.unknowns.at(end, 1), 1.0);
  for (Index e = 0; e < problem_.network.num_elements(); ++e) {
    const Bonds& bonds = problem_.network.bonds;
    EXPECT_EQ(body_.is_grounded(e), bonds.first[e] == end || bonds.second[e] == end) << e;
  }
}

}  // namespace
}  // namespace perilink

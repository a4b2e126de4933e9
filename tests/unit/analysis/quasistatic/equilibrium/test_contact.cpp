// Contact only reads: a chain's damaged bond, closed or open, under tension or compression.

#include "analysis/quasistatic/equilibrium/contact.hpp"

#include <gtest/gtest.h>

#include "analysis/quasistatic/equilibrium/update/make_update.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// Two chains of two bonds of stiffness 2 under the force 1. The first bond keeps half of its
/// stiffness when it is open, so that it extends by 1.
class ContactOfAChain : public testing::Test {
 protected:
  ContactOfAChain() : problem_(chain()), body_(problem_, problem_.unknowns, nullptr) {
    bond_ = bonds_of_row(problem_.network, 0.0).front();
    body_.weaken(bond_, 0.5);
    solve(problem_);
  }

  static AnalysisBody chain() {
    AnalysisBody body = make_chains(2, 2, false, 2.0, 0.01);
    body.network.laws.front() = three_segments().closing();
    return body;
  }

  void solve(const AnalysisBody& problem) {
    update_ = make_update(body_, problem, {});
    solution_.emplace(body_, *update_, problem.loads, std::vector<double>());
    solution_->begin(true, true);
    solution_->find();
  }

  AnalysisBody problem_;
  DamagedBody body_;
  std::unique_ptr<Update> update_;
  std::optional<Solution> solution_;
  Index bond_ = 0;
};

TEST_F(ContactOfAChain, OpenInTensionIsRight) {
  const Contact contact(*solution_);
  EXPECT_NEAR(contact.extension_of(bond_).now, 1.0, 1e-14);
  EXPECT_TRUE(contact.violated({}).empty());
}

TEST_F(ContactOfAChain, ClosedInTensionIsViolated) {
  body_.turn(bond_);
  solve(problem_);
  const Contact contact(*solution_);
  EXPECT_NEAR(contact.extension_of(bond_).now, 0.5, 1e-14);
  EXPECT_EQ(contact.violated({}), std::vector<Index>{bond_});
  EXPECT_TRUE(contact.violated({.noise = 0.6}).empty()) << "within the round-off of all motions";
}

TEST_F(ContactOfAChain, OpenInCompressionIsViolatedUnlessASpringHoldsIt) {
  for (double& force : problem_.loads.forces) force = -force;
  solve(problem_);
  EXPECT_EQ(Contact(*solution_).violated({}), std::vector<Index>{bond_});
  body_.add_ground_spring(problem_.unknowns.at(problem_.network.bonds.second[bond_], 0), 1.0);
  EXPECT_TRUE(Contact(*solution_).violated({}).empty());
}

/// Under permanent loads -0.3 and the load factor 0, the open bond changes at the load factor 0.3.
TEST_F(ContactOfAChain, ChangesWhereTheExtensionPassesZero) {
  ConstantLoads permanent{problem_.unknowns, problem_.loads};
  for (double& force : permanent.loads.forces) force *= -0.3;
  solution_->begin_stage(problem_.loads, permanent);
  solution_->find();
  const Contact contact(*solution_);
  EXPECT_NEAR(contact.extension_of(bond_).now, -0.3, 1e-14);
  EXPECT_EQ(contact.next_change(1.0).element, no_index) << "it opens further";
  body_.turn(bond_);
  solution_->renew();
  const Contact::Change change = contact.next_change(1.0);
  EXPECT_EQ(change.element, bond_);
  EXPECT_NEAR(change.distance, 0.3, 1e-14);
  EXPECT_EQ(contact.next_change(0.2).element, no_index) << "beyond the step";
  solution_->permanent()->move_to(0.3);
  EXPECT_EQ(contact.violated({.direction = 1.0}), std::vector<Index>{bond_});
  EXPECT_TRUE(contact.violated({.direction = -1.0}).empty());
}

/// The bond closes in the first round and is right in the second.
TEST_F(ContactOfAChain, RoundsEndWhereNothingIsViolated) {
  for (double& force : problem_.loads.forces) force = -force;
  solve(problem_);
  const Contact contact(*solution_);
  ContactRounds rounds(contact, 0.0);
  EXPECT_EQ(rounds.next(), std::vector<Index>{bond_});
  body_.turn(bond_);
  solution_->renew();
  EXPECT_TRUE(rounds.next().empty());
}

/// States that nobody changes are violated in every round; line searches then reach the aim.
TEST_F(ContactOfAChain, RoundsAreLimited) {
  body_.turn(bond_);
  solve(problem_);
  const Contact contact(*solution_);
  ContactRounds rounds(contact, 0.0);
  EXPECT_THROW(for (int round = 0; round < 2000; ++round) ASSERT_FALSE(rounds.next().empty()),
               SolverError);
}

}  // namespace
}  // namespace perilink

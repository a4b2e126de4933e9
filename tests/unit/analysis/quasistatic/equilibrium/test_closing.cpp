#include <gtest/gtest.h>

#include "analysis/quasistatic/equilibrium/equilibrium.hpp"
#include "base/error.hpp"
#include "support/analysis_bodies.hpp"
#include "support/staged_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// Makes contact springs of some bonds of a truss body; they become its last elements.
void make_contacts(Network& network, const std::vector<Index>& of) {
  std::vector<Index> order;
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (std::ranges::find(of, e) == of.end()) order.push_back(e);
  }
  order.insert(order.end(), of.begin(), of.end());
  const Network before = network;
  network.bonds = {};
  network.bonds.dim = before.dim();
  for (std::size_t e = 0; e < order.size(); ++e) {
    const Bonds& bonds = before.bonds;
    network.bonds.append(bonds.first[order[e]], bonds.second[order[e]], bonds.length(order[e]),
                         bonds.direction(order[e]));
    network.stiffness[e] = before.stiffness[order[e]];
    network.critical_stretch[e] = before.critical_stretch_of(order[e]);
    if (!before.law_of.empty()) network.law_of[e] = before.law_of[order[e]];
  }
  network.num_contacts = static_cast<Index>(of.size());
  for (const Index e : network.contacts()) {
    network.critical_stretch[e] = std::numeric_limits<double>::infinity();
  }
}

/// Displacement over load of two chains of two bonds, of stiffness 2 and three segments from the
/// stretch 0.01 on. They are stretched by 0.021, released, and pushed by 0.1. A bond of each chain
/// passes one segment and keeps 0.6 of its stiffness.
std::pair<double, double> pull_and_push(bool closes) {
  AnalysisBody body = make_chains(2, 2, true, 2.0, 0.01);
  body.network.laws.front() = closes ? three_segments().closing() : three_segments();
  body.sets = {set_of(body)};
  double pulled = 0.0, pushed = 0.0;
  Recorder recorder([&](const StepRecord& row, StateSource&) {
    if (row.stage == 2 && row.load_factor == 0.01) pulled = row.displacement / row.load;
    if (row.load_factor == -0.1) pushed = row.displacement / row.load;
  });
  const DamageResult result =
      run(body, in_stages({{0, 0.021, {}}, {0, 0.01, {}}, {0, -0.1, {}}}), recorder);
  EXPECT_EQ(result.termination, Termination::completed) << result.reason;
  EXPECT_LT(result.energy_error, 1e-12);
  return {pulled, pushed};
}

TEST(Closing, ADamagedBondIsWholeInCompression) {
  const auto [pulled, pushed] = pull_and_push(true);
  EXPECT_NEAR(pulled, 0.5 * (1.0 / 2.0 + 1.0 / 1.2), 1e-14);
  EXPECT_NEAR(pushed, 0.5 * (1.0 / 2.0 + 1.0 / 2.0), 1e-14);
}

TEST(Closing, OneThatDoesNotCloseIsNot) {
  const auto [pulled, pushed] = pull_and_push(false);
  EXPECT_NEAR(pulled, 0.5 * (1.0 / 2.0 + 1.0 / 1.2), 1e-14);
  EXPECT_NEAR(pushed, pulled, 1e-14);
}

/// The square of make_square() without its lower horizontal bond, which a pre-crack has broken: the
/// right corner below moves by 2 where it is pulled and by 2/3 where it is pushed.
TEST(Closing, CutBondsCarryCompressionOnly) {
  for (const double sign : {1.0, -1.0}) {
    AnalysisBody body = make_square();
    for (double& force : body.loads.forces) force *= sign;
    body.network.laws = {BondLaw::brittle().closing()};
    make_contacts(body.network, {bond_between(body.network, {0, 0}, {1, 0})});
    const Index cut = bond_between(body.network, {0, 0}, {1, 0});
    Equilibrium equilibrium(body, {});
    const double moved = equilibrium.displacement()[slot(body, body.network.bonds.second[cut], 0)];
    EXPECT_NEAR(moved, sign > 0 ? 2.0 : -2.0 / 3.0, 1e-14);
    EXPECT_EQ(equilibrium.secants()[cut], 0.0);
    EXPECT_EQ(equilibrium.secants().axial(cut), sign > 0 ? 0.0 : 1.0);
    EXPECT_LT(equilibrium.check().residual, 1e-14);
  }
}

/// Each third bond of a block is cut. Those under tension open together, with one new factor, or
/// each would change the factor that the closed ones had.
TEST(Closing, ManyCutBondsOpenWithOneFactor) {
  AnalysisBody body = make_block({{"hexagonal", Pattern::hexagonal, Surface::none},
                                  false,
                                  false,
                                  12,
                                  0.1,
                                  false,
                                  false,
                                  true});
  std::vector<Index> cut;
  for (Index e = 0; e < body.network.first_slip_spring; e += 3) {
    if (body.network.has_limit(e)) cut.push_back(e);
  }
  make_contacts(body.network, cut);
  for (const LinearSolver solver : {LinearSolver::direct, LinearSolver::iterative}) {
    Equilibrium equilibrium(body, {.solver = solver, .subdomains = {.tolerance = 1e-12}});
    Index opened = 0;
    for (const Index e : body.network.contacts()) {
      const double extension = extension_of(body.network, equilibrium.displacement(), e);
      const bool is_open = equilibrium.secants().axial(e) == 0.0;
      EXPECT_EQ(is_open, extension > 0.0) << "bond " << e;
      opened += is_open;
    }
    EXPECT_GT(opened, 50);
    // One at first, and one for each of the few rounds in which sides are settled.
    EXPECT_GE(equilibrium.factor().factorizations(), 2);
    EXPECT_LE(equilibrium.factor().factorizations(), 4);
    // Round-off of a body of a few hundred unknowns.
    EXPECT_LT(
        difference(equilibrium.displacement(), dense_displacement(body, equilibrium.secants())),
        1e-10);
  }
}

/// Two halves, with all bonds between them cut: round-off leaves a factor of the open body, if any,
/// that must not be believed.
TEST(Closing, ManyCutBondsThatHoldTheBodyAreFoundOut) {
  for (const double sign : {1.0, -1.0}) {
    AnalysisBody body = make_block({{"hexagonal", Pattern::hexagonal, Surface::none},
                                    false,
                                    false,
                                    12,
                                    0.1,
                                    false,
                                    false,
                                    true});
    for (double& force : body.loads.forces) force *= sign;
    const Bonds& bonds = body.network.bonds;
    double middle = 0.0;
    for (Index i = 0; i < body.network.particles.size(); ++i) {
      middle += body.network.particles.position(i)[0] / body.network.particles.size();
    }
    const auto right = [&](Index i) { return body.network.particles.position(i)[0] > middle; };
    std::vector<Index> cut;
    for (Index e = 0; e < body.network.first_slip_spring; ++e) {
      if (right(bonds.first[e]) != right(bonds.second[e])) cut.push_back(e);
    }
    make_contacts(body.network, cut);
    ASSERT_GT(body.network.num_contacts, 20);
    if (sign > 0.0) {
      EXPECT_THROW(Equilibrium(body, {}), CracksSeparate);
    } else {
      EXPECT_NO_THROW(Equilibrium(body, {}));
    }
  }
}

TEST(Closing, RefusesWhatTheLoadsPullApart) {
  AnalysisBody body = make_chains(1, 2, false, 2.0, 0.01);
  body.network.laws = {BondLaw::brittle().closing()};
  make_contacts(body.network, {bonds_of_row(body.network, 0.0).front()});
  EXPECT_THROW(Equilibrium(body, {}), SolverError);
  for (double& force : body.loads.forces) force = -force;
  EXPECT_NO_THROW(Equilibrium(body, {}));
}

}  // namespace
}  // namespace perilink

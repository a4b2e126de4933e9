#include "analysis/quasistatic/events/single_event_engine.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

SingleEventEngine make_engine(const AnalysisBody& body, const EquilibriumOptions& options = {}) {
  return {body, options};
}

double force_work(const AnalysisBody& body, const Eigen::VectorXd& u) {
  return Eigen::Map<const Eigen::VectorXd>(body.loads.forces.data(), u.size()).dot(u);
}

/// Only bonds in the middle can break, so the engine need not follow the ends.
/// \param part  where they can, over the length
AnalysisBody make_partly_unbreakable(const LatticeCase& lattice, double part = 0.25) {
  AnalysisBody body = make_block({lattice, false, false, 12});
  Network& network = body.network;
  for (Index e = 0; e < network.num_elements(); ++e) {
    for (const Index i : {network.bonds.first[e], network.bonds.second[e]}) {
      const double x = network.particles.position(i)[0] / 2.4;
      if (std::abs(x - 0.5) > 0.5 * part) network.critical_stretch[e] = infinity;
    }
  }
  return body;
}

/// The loaded face lies in a part that is not followed: f'u comes from the growth at each event,
/// and displacement() brings the rest of the body up to date whenever it is asked.
TEST(Equilibrium, UnbreakablePartsAreBroughtUpToDateWhenAsked) {
  for (const FactorRoute route : routes) {
    const AnalysisBody body = make_partly_unbreakable(rectangular);
    SingleEventEngine engine = make_engine(body, with_route(route));
    for (int k = 1; k <= 30; ++k) {
      const Event event = engine.next_event();
      ASSERT_FALSE(engine.apply(event).mechanism);
      const Eigen::VectorXd expected = dense_displacement(body, engine.secants());
      // Each event adds round-off times the condition number (1e4) to f'u.
      const double work = force_work(body, expected);
      EXPECT_NEAR(engine.load_work().forces, work, 1e-11 * work) << k;
      if (k % 7 == 0) {
        EXPECT_LT(difference(engine.displacement(), expected), 1e-11);
        EXPECT_NEAR(engine.load_work().forces, work, 1e-11 * work) << k;
      }
      if (k % 10 == 0) {
        const Balance balance = engine.check_equilibrium();
        EXPECT_LT(balance.residual, 1e-10);
        EXPECT_NEAR(balance.stored_energy, 0.5 * work, 1e-10 * work);
      }
    }
  }
}

/// A cheap residual check measures forces where bonds can break, and keeps the other displacements.
/// If these are out of balance, a full check of the body follows.
TEST(Equilibrium, AGlanceCostsNoSolve) {
  AnalysisBody body = make_partly_unbreakable(rectangular, 0.7);
  body.network.support_stiffness.assign(body.unknowns.number.size(), 0.05);
  Equilibrium equilibrium(body, {});
  EXPECT_FALSE(std::isnan(equilibrium.check_cheaply().stored_energy))
      << "all is current at the start";
  std::vector<double> first(equilibrium.displacement().begin(), equilibrium.displacement().end());
  Index weakened = 0;
  while (!body.network.has_limit(weakened)) ++weakened;
  ASSERT_FALSE(equilibrium.weaken(weakened, 0.5).mechanism);
  const Balance balance = equilibrium.check_cheaply();
  EXPECT_TRUE(std::isnan(balance.stored_energy));
  EXPECT_LT(balance.residual, 1e-12);
  Index stale = 0;
  const auto seen = equilibrium.where_elements_fail();
  for (std::size_t slot = 0; slot < first.size(); ++slot) stale += seen[slot] == first[slot];
  EXPECT_GT(stale, 10);
  EquilibriumOptions strict;
  strict.residual_tolerance = 1e-30;  // no arithmetic meets it
  Equilibrium doubted(body, strict);
  ASSERT_FALSE(doubted.weaken(weakened, 0.5).mechanism);
  EXPECT_FALSE(std::isnan(doubted.check_cheaply().stored_energy));
}

/// Elements without a limit are where displacements may be those of an earlier event.
TEST(Equilibrium, WeakensElementsWithoutALimitByPresentDisplacements) {
  const AnalysisBody body = make_partly_unbreakable(rectangular);
  Equilibrium equilibrium(body, {});
  Index limited = 0, endless = 0;
  while (!body.network.has_limit(limited)) ++limited;
  while (body.network.has_limit(endless)) ++endless;
  ASSERT_FALSE(equilibrium.weaken(limited, 0.0).mechanism);
  const double before = force_work(body, dense_displacement(body, equilibrium.secants()));
  const double growth = equilibrium.weaken(endless, 0.5).compliance_growth;
  const double after = force_work(body, dense_displacement(body, equilibrium.secants()));
  EXPECT_NEAR(growth, after - before, 1e-11 * after);  // round-off times the condition number, 1e4
}

TEST(Equilibrium, UnknownsThatHoldNothingAreNotTaken) {
  for (const FactorRoute route : routes) {
    const AnalysisBody body = make_partly_unbreakable(rectangular);
    EquilibriumOptions options;
    options.route = route;
    Equilibrium equilibrium(body, options);
    Index limited = 0;
    while (!body.network.has_limit(limited)) ++limited;
    ASSERT_FALSE(equilibrium.weaken(limited, 0.5).mechanism);
    const std::vector<std::uint8_t> nothing(body.unknowns.number.size(), 0);
    const Unknowns free = number_unknowns(2, nothing, body.unknowns.prescribed);
    EXPECT_THROW(equilibrium.change_motion(free), SolverError);
    ASSERT_FALSE(equilibrium.weaken(limited, 0.0).mechanism);
    const Eigen::VectorXd expected = dense_displacement(body, equilibrium.secants());
    EXPECT_LT(difference(equilibrium.displacement(), expected), 1e-11);
  }
}

/// The reactions of a displacement-controlled body follow the events and equal those of the
/// elements at any event.
TEST(Equilibrium, WorkOfADrivenBodyFollowsItsEvents) {
  for (const bool micropolar : {false, true}) {
    BlockCase block{rectangular, true};
    block.columns = 10;
    block.micropolar = micropolar;
    const AnalysisBody body = make_block(block);
    SingleEventEngine engine = make_engine(body);
    for (int k = 0; k < 40; ++k) {
      const Event event = engine.next_event();
      ASSERT_NE(event.element, no_index);
      const LoadWork work = engine.load_work();
      const Eigen::VectorXd u = dense_displacement(body, engine.secants());
      const double stored = stored_energy(body.network, engine.secants(),
                                          {u.data(), static_cast<std::size_t>(u.size())});
      // Round-off of 1e-16 times the condition number, some 1e4, per event.
      EXPECT_NEAR(work.forces + work.supports, 2.0 * stored, 1e-10 * stored) << k;
      if (engine.apply(event).mechanism) break;
    }
  }
}

TEST(Equilibrium, PartialDisplacementsFindTheSameEvents) {
  AnalysisBody body = make_partly_unbreakable(hexagonal);
  SingleEventEngine partial = make_engine(body);
  SingleEventEngine whole = make_engine(body);
  for (int k = 0; k < 30; ++k) {
    whole.displacement();  // brings all of it up to date before each event
    const Event expected = whole.next_event();
    const Event event = partial.next_event();
    ASSERT_EQ(event.element, expected.element) << k;
    EXPECT_NEAR(event.load_factor, expected.load_factor, 1e-11 * expected.load_factor);
    whole.apply(expected);
    partial.apply(event);
  }
}

/// With a tolerance below round-off, each check factorises at most once, and not again while the
/// residual stays near that of the fresh factor.
TEST(Equilibrium, FactorizesAtMostOncePerLook) {
  const AnalysisBody body = make_block({rectangular, false, false, 8});
  EquilibriumOptions options;
  options.residual_tolerance = 1e-30;
  SingleEventEngine engine = make_engine(body, options);
  EXPECT_EQ(engine.factor_statistics().factorizations, 1);
  engine.check_equilibrium();
  EXPECT_EQ(engine.factor_statistics().factorizations, 2);
  engine.check_equilibrium();
  EXPECT_EQ(engine.factor_statistics().factorizations, 2);
  for (int k = 0; k < 20; ++k) {
    engine.apply(engine.next_event());
    const int before = engine.factor_statistics().factorizations;
    engine.check_equilibrium();
    EXPECT_LE(engine.factor_statistics().factorizations, before + 1);
  }
}

/// Removing an element 1e4 times as stiff as the others costs four of sixteen digits. One step of
/// refinement restores the tolerance; without need there is no factorisation.
TEST(Equilibrium, RefinementRestoresLostDigits) {
  AnalysisBody body = make_block({rectangular, false, false, 8});
  Network& network = body.network;
  const Index element = network.num_elements() / 2;
  network.stiffness[element] *= 1e4;
  network.critical_stretch[element] = 1e-9;
  SingleEventEngine engine = make_engine(body);
  const Event event = engine.next_event();
  ASSERT_EQ(event.element, element);
  EXPECT_FALSE(engine.apply(event).mechanism);
  EXPECT_LT(engine.check_equilibrium().residual, 1e-10);
  const Eigen::VectorXd expected = dense_displacement(body, engine.secants());
  EXPECT_LT(difference(engine.displacement(), expected), 1e-10);
  EXPECT_LE(engine.factor_statistics().factorizations, 2);
}

TEST(Equilibrium, RefusesABodyThatNothingHolds) {
  AnalysisBody body = make_block({rectangular});
  number(body, [](Index, int) { return false; });
  EXPECT_THROW(make_engine(body), SolverError);
}

/// Elements that join particles within `radius` of the particle nearest to the middle of the block
/// with the rest, and the components of these particles.
struct Cluster {
  std::vector<Index> members;
  std::vector<Index> bonds;
  std::vector<std::uint8_t> components;
};

Cluster make_cluster(const Network& network, double radius) {
  const Particles& particles = network.particles;
  std::vector<double> middle(2, 0.0);
  for (Index i = 0; i < particles.size(); ++i) {
    for (int a = 0; a < 2; ++a) middle[a] += particles.position(i)[a] / particles.size();
  }
  const auto distance = [&](Index i, std::span<const double> from) {
    return std::hypot(particles.position(i)[0] - from[0], particles.position(i)[1] - from[1]);
  };
  Index center = 0;
  for (Index i = 0; i < particles.size(); ++i) {
    if (distance(i, middle) < distance(center, middle)) center = i;
  }
  Cluster cluster;
  cluster.components.assign(particles.positions.size(), 0);
  for (Index i = 0; i < particles.size(); ++i) {
    if (distance(i, particles.position(center)) > 1.01 * radius) continue;
    cluster.members.push_back(i);
    cluster.components[2 * i] = cluster.components[2 * i + 1] = 1;
  }
  for (Index e = 0; e < network.num_elements(); ++e) {
    const bool first = cluster.components[2 * network.bonds.first[e]] != 0;
    const bool second = cluster.components[2 * network.bonds.second[e]] != 0;
    if (first != second) cluster.bonds.push_back(e);
  }
  return cluster;
}

struct CutCase {
  double radius;  ///< in spacings
  std::size_t members;
  int springs;
};

/// A particle has two rigid-body modes, a cluster three: as many ground springs, and the rest of
/// the body does not feel them.
TEST(Equilibrium, CutHoldsWhatComesLooseWithoutDisturbingTheRest) {
  const AnalysisBody body = make_block({hexagonal, false, false, 12});
  for (const FactorRoute route : routes) {
    for (const CutCase& cut : {CutCase{0.0, 1, 2}, CutCase{1.0, 7, 3}, CutCase{2.0, 19, 3}}) {
      const Cluster cluster = make_cluster(body.network, cut.radius * 0.2);
      ASSERT_EQ(cluster.members.size(), cut.members);
      SingleEventEngine engine = make_engine(body, with_route(route));
      EXPECT_EQ(engine.cut(cluster.bonds), cut.springs) << cut.members;
      EXPECT_EQ(engine.cut(cluster.bonds), 0) << "gone already";
      // Round-off of the downdates times the condition number of the block, 1e3.
      const auto& loose = cluster.components;
      const Eigen::VectorXd expected = dense_displacement(body, engine.secants(), loose);
      EXPECT_LT(difference(engine.displacement(), expected, loose), 1e-12);
      EXPECT_LT(engine.check_equilibrium().residual, 1e-12);
      // Events go on in the rest.
      for (int k = 0; k < 5; ++k) ASSERT_FALSE(engine.apply(engine.next_event()).mechanism);
      EXPECT_LT(difference(engine.displacement(), dense_displacement(body, engine.secants(), loose),
                           loose),
                1e-11);
    }
  }
}

TEST(Equilibrium, CutInABodyThatIsFollowedInPart) {
  const AnalysisBody body = make_partly_unbreakable(hexagonal);
  const Cluster cluster = make_cluster(body.network, 0.2);
  SingleEventEngine engine = make_engine(body);
  for (int k = 0; k < 3; ++k) engine.apply(engine.next_event());
  EXPECT_EQ(engine.cut(cluster.bonds), 3);
  const auto& loose = cluster.components;
  const Eigen::VectorXd expected = dense_displacement(body, engine.secants(), loose);
  EXPECT_LT(difference(engine.displacement(), expected, loose), 1e-12);
  EXPECT_NEAR(engine.load_work().forces, force_work(body, expected),
              1e-12 * force_work(body, expected));
}

TEST(Equilibrium, CutRefusesALoadedPart) {
  AnalysisBody body = make_block({hexagonal, false, false, 12});
  const Cluster cluster = make_cluster(body.network, 0.2);
  body.loads.forces[slot(body, cluster.members[3], 0)] = 0.01 * body.reference.value;
  SingleEventEngine engine = make_engine(body);
  EXPECT_THROW(engine.cut(cluster.bonds), SolverError);
}

/// The last bond that holds a loaded particle may be all but at right angles to an axis: the force
/// in it counts, not its component along that axis.
TEST(Equilibrium, CutRefusesALoadedPartWhateverTheDirectionOfItsLastBond) {
  AnalysisBody body = make_block({rectangular, false, false, 8});
  Network& network = body.network;
  const Cluster cluster = make_cluster(network, 0.0);
  const Index particle = cluster.members[0];
  std::vector<Index> order;
  Index upright = no_index, level = no_index;
  for (const Index e : cluster.bonds) {
    if (network.bonds.first[e] != particle || network.bonds.lengths[e] > 0.21) {
      order.push_back(e);
    } else if (std::abs(network.bonds.direction(e)[0]) < 0.5) {
      upright = e;
    } else {
      level = e;
    }
  }
  ASSERT_NE(upright, no_index);
  ASSERT_NE(level, no_index);
  network.bonds.directions[2 * upright] = 1e-17;
  order.push_back(upright);
  order.push_back(level);
  body.loads.forces[slot(body, particle, 1)] = body.reference.value;
  SingleEventEngine engine = make_engine(body);
  EXPECT_THROW(engine.cut(order), SolverError);
}

}  // namespace
}  // namespace perilink

#include <gtest/gtest.h>

#include "analysis/quasistatic/events/single_event_engine.hpp"
#include "base/error.hpp"
#include "io/case/case_words.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// Particle 0 at the origin with a micropolar bond (k = 1, kb = 2) to particle 1 at (0, 1) and
/// trusses of stiffness 1 and 3 to particles 2 at (-1, 0) and 3 at (0, -1), all held.
AnalysisBody make_joint() {
  Network network;
  network.particles.dim = network.bonds.dim = 2;
  network.particles.positions = {0, 0, 0, 1, -1, 0, 0, -1};
  network.particles.volumes.assign(4, 1.0);
  network.particles.material.assign(4, 0);
  network.particles.kind.assign(4, ParticleKind::solid);
  for (const Index other : {1, 2, 3}) network.bonds.append(network.particles, 0, other);
  network.stiffness = {1.0, 1.0, 3.0};
  network.bending = {2.0, 0.0, 0.0};
  network.critical_stretch = {1e-3, infinity, infinity};
  network.first_slip_spring = 1;
  network.first_bar_element = 3;
  AnalysisBody body = free_body(std::move(network));
  body.loads.forces[0] = 1.0;
  body.loads.forces[1] = -1.0;
  number(body, [](Index i, int) { return i > 0; });
  body.reference = {false, std::sqrt(2.0)};
  return body;
}

/// Only the bond turned the particle; without it the rotation is idle, not a mechanism. By hand,
/// with theta = kb u / 2 / (kb / 3) from moment balance, the frame gives kb / 4 = 1/2 across: u = 1
/// / (1 + 1/2), v = -1 / (1 + 3); without it u = 1, v = -1/3.
TEST(Weakening, ABondThatAloneTurnedAParticleMayBreak) {
  const AnalysisBody body = make_joint();
  for (const FactorRoute route : routes) {
    SCOPED_TRACE(word_of(route));
    SingleEventEngine engine(body, with_route(route));
    EXPECT_NEAR(engine.displacement()[0], 1.0 / 1.5, 1e-14);
    EXPECT_NEAR(engine.displacement()[1], -0.25, 1e-14);
    const Event event = engine.next_event();
    ASSERT_EQ(event.element, 0);
    const double before = engine.load_work().forces;
    const EventOutcome outcome = engine.apply(event);
    EXPECT_FALSE(outcome.mechanism);
    EXPECT_NEAR(engine.displacement()[0], 1.0, 1e-14);
    EXPECT_NEAR(engine.displacement()[1], -1.0 / 3.0, 1e-14);
    EXPECT_NEAR(outcome.compliance_growth, engine.load_work().forces - before, 1e-14);
    EXPECT_NEAR(engine.load_work().forces, 4.0 / 3.0, 1e-14);
    EXPECT_LT(engine.check_equilibrium().residual, 1e-14);
    EXPECT_EQ(engine.next_event().element, no_index);
  }
}

/// Joint with a moment on it: the rotation carries load.
TEST(Weakening, ABondThatAloneCarriesAMomentLeavesAMechanism) {
  AnalysisBody body = make_joint();
  body.loads.forces[2] = 0.01;
  for (const FactorRoute route : routes) {
    SingleEventEngine engine(body, with_route(route));
    const std::vector<double> before(engine.displacement().begin(), engine.displacement().end());
    const EventOutcome outcome = engine.apply(engine.next_event());
    EXPECT_TRUE(outcome.mechanism);
    EXPECT_EQ(outcome.pivot, 0.0);
    EXPECT_EQ(engine.secants()[0], 1.0);  // nothing was changed
    for (std::size_t slot = 0; slot < before.size(); ++slot) {
      EXPECT_NEAR(engine.displacement()[slot], before[slot], 1e-14);
    }
  }
}

/// A chain of two: the part beyond the broken bond carries the load.
TEST(Weakening, TheLastBondOfALoadedPartLeavesAMechanism) {
  Network network = single_frame(3, {1.0, 2.0, 2.0}, 1.0, 2.0);
  AnalysisBody body = free_body(std::move(network));
  body.loads.forces[6] = 1.0;
  number(body, [](Index i, int) { return i == 0; });
  body.reference = {false, 1.0};
  for (const FactorRoute route : routes) {
    SingleEventEngine engine(body, with_route(route));
    const EventOutcome outcome = engine.apply(engine.next_event());
    EXPECT_TRUE(outcome.mechanism);
    EXPECT_NEAR(outcome.released, 0.5 * engine.load_work().forces, 1e-13);  // all of the energy
  }
}

/// Two prescribed particles stretch (1), shear (0.5 - 0.2 / 2 = 0.4) and bend (0.2) the bond
/// between them. It holds no unknown, so breaking it changes only the reactions.
TEST(Weakening, ABondBetweenPrescribedParticlesBreaksAndNothingMoves) {
  Network network = single_frame(2, {1.0, 0.0}, 1.0, 3.0);
  network.particles.positions.insert(network.particles.positions.end(), {0.0, 1.0});
  network.particles.volumes.push_back(1.0);
  network.particles.material.push_back(0);
  network.particles.kind.push_back(ParticleKind::solid);
  network.bonds.append(network.particles, 1, 2);  // its end moves with the controlled one
  network.stiffness.push_back(1.0);
  network.bending.push_back(3.0);
  network.critical_stretch.push_back(1e-3);
  network.first_slip_spring = network.first_bar_element = 2;
  AnalysisBody body = free_body(std::move(network));
  const double driven[] = {1.0, 0.5, 0.2};
  for (int a = 0; a < 3; ++a) body.unknowns.prescribed[slot(body, 1, a)] = driven[a];
  number(body, [](Index i, int) { return i < 2; });
  body.reference = {true, 1.0};
  const double twice_energy = 1.0 + 3.0 * 0.16 + 3.0 * 0.04 / 12.0;
  for (const FactorRoute route : routes) {
    SCOPED_TRACE(word_of(route));
    SingleEventEngine engine(body, with_route(route));
    EXPECT_NEAR(engine.load_work().supports, twice_energy, 1e-14);
    const Event event = engine.next_event();
    ASSERT_EQ(event.element, 0);
    EXPECT_NEAR(event.load_factor, 1e-3 / std::sqrt(twice_energy), 1e-16);
    const std::vector<double> before(engine.displacement().begin(), engine.displacement().end());
    const EventOutcome outcome = engine.apply(event);
    EXPECT_EQ(outcome.pivot, 1.0);
    EXPECT_NEAR(outcome.released, 0.5 * twice_energy, 1e-14);
    EXPECT_NEAR(outcome.compliance_growth, twice_energy, 1e-14);
    EXPECT_LT(std::abs(engine.load_work().supports), 1e-14);
    for (std::size_t k = 0; k < before.size(); ++k) {
      EXPECT_NEAR(engine.displacement()[k], before[k], 1e-14);
    }
  }
}

/// Bonds of the particle nearest the middle.
std::vector<Index> bonds_of_middle(const Network& network) {
  const Particles& particles = network.particles;
  Vector3 middle{};
  for (Index i = 0; i < particles.size(); ++i) {
    for (int a = 0; a < particles.dim; ++a) {
      middle[a] += particles.position(i)[a] / static_cast<double>(particles.size());
    }
  }
  const auto distance = [&](Index i) {
    double square = 0.0;
    for (int a = 0; a < particles.dim; ++a) {
      square += std::pow(particles.position(i)[a] - middle[a], 2);
    }
    return square;
  };
  Index center = 0;
  for (Index i = 0; i < particles.size(); ++i) center = distance(i) < distance(center) ? i : center;
  std::vector<Index> bonds;
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (network.bonds.first[e] == center || network.bonds.second[e] == center) bonds.push_back(e);
  }
  return bonds;
}

/// A particle that rotates has three rigid-body modes in the plane and six in space.
TEST(Weakening, CutHoldsAParticleAndItsRotationsWithoutDisturbingTheRest) {
  for (const Pattern pattern : {Pattern::hexagonal, Pattern::cubic}) {
    const bool plane = is_plane(pattern);
    const AnalysisBody body =
        make_block({{"", pattern, Surface::none}, false, false, plane ? 8 : 4, 0.1, true});
    const std::vector<Index> bonds = bonds_of_middle(body.network);
    std::vector<std::uint8_t> loose(body.unknowns.number.size(), 0);
    const int width = body.network.width();
    const auto other = [&](Index e) {
      return std::pair(body.network.bonds.first[e], body.network.bonds.second[e]);
    };
    const auto [a, b] = other(bonds[0]);
    const auto [c, d] = other(bonds[1]);
    const Index center = a == c || a == d ? a : b;
    std::fill_n(loose.begin() + center * width, width, 1);
    for (const FactorRoute route : routes) {
      SCOPED_TRACE(word_of(route));
      SingleEventEngine engine(body, with_route(route));
      EXPECT_EQ(engine.cut(bonds), width);
      EXPECT_EQ(engine.cut(bonds), 0) << "gone already";
      // Round-off of the downdates times the condition number of the block, 1e4.
      EXPECT_LT(difference(engine.displacement(), dense_displacement(body, engine.secants(), loose),
                           loose),
                1e-11);
      EXPECT_LT(engine.check_equilibrium().residual, 1e-11);
      for (int k = 0; k < 5; ++k) ASSERT_FALSE(engine.apply(engine.next_event()).mechanism);
      EXPECT_LT(difference(engine.displacement(), dense_displacement(body, engine.secants(), loose),
                           loose),
                1e-10);
    }
  }
}

/// Particle 1 is pulled to the left and takes particle 2 along by a bond with shear retention,
/// which has lost half of its stiffness. Particle 2 has a force to the right and presses on a
/// broken bond that closes. Without the first bond only this one would hold it: nothing changes.
TEST(Weakening, AMechanismLeavesASoftenedBondWithShearRetentionAsItWas) {
  Network network;
  network.particles.dim = network.bonds.dim = 2;
  network.particles.positions = {-1, 0, 0, 0, 1, 0};
  network.particles.volumes.assign(3, 1.0);
  network.particles.material.assign(3, 0);
  network.particles.kind.assign(3, ParticleKind::solid);
  for (const auto& [first, second] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 2)}) {
    network.bonds.append(network.particles, first, second);
  }
  network.stiffness = {1.0, 1.0, 1.0};
  network.critical_stretch = {infinity, 1e-3, 1e-3};
  const std::vector<Segment> segments = {{1.0, 1.0}, {0.5, 2.0}};
  network.laws = {BondLaw::saw_tooth(segments).crushing(segments, 1.0, true),
                  BondLaw::brittle().closing()};
  network.law_of = {0, 0, 1};
  network.first_slip_spring = network.first_bar_element = 3;
  AnalysisBody body = free_body(std::move(network));
  body.loads.forces[slot(body, 1, 0)] = -1.0;
  body.loads.forces[slot(body, 2, 0)] = 0.1;
  number(body, [](Index i, int axis) { return i == 0 || axis > 0; });
  body.reference = {false, 1.0};
  Equilibrium equilibrium(body, {});
  ASSERT_FALSE(equilibrium.weaken(2, 0.0).mechanism);
  ASSERT_FALSE(equilibrium.weaken(1, 0.5).mechanism);
  const std::vector<double> before(equilibrium.displacement().begin(),
                                   equilibrium.displacement().end());
  // By hand: 1.5 u_1 - 0.5 u_2 = -1 and 1.5 u_2 - 0.5 u_1 = 0.1.
  ASSERT_NEAR(before[slot(body, 2, 0)], -0.175, 1e-14);
  EXPECT_TRUE(equilibrium.weaken(1, 0.0).mechanism);
  EXPECT_EQ(equilibrium.secants().axial(1), 0.5);
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_NEAR(equilibrium.displacement()[k], before[k], 1e-14);
  }
}

TEST(Weakening, CutRefusesALoadedPart) {
  AnalysisBody body =
      make_block({{"", Pattern::hexagonal, Surface::none}, false, false, 8, 0.1, true});
  const std::vector<Index> bonds = bonds_of_middle(body.network);
  const Index a = body.network.bonds.first[bonds[0]], b = body.network.bonds.second[bonds[0]];
  const Index c = body.network.bonds.first[bonds[1]], d = body.network.bonds.second[bonds[1]];
  body.loads.forces[slot(body, a == c || a == d ? a : b, 2)] = 0.01 * body.reference.value;
  SingleEventEngine engine(body, {});
  EXPECT_THROW(engine.cut(bonds), SolverError);
}

}  // namespace
}  // namespace perilink

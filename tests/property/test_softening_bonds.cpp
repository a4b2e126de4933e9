// Bonds that soften in segments: energies, forces and stiffnesses are consistent on every segment.
// A bond in tension follows its curve and dissipates its energy.

#include <gtest/gtest.h>

#include <ostream>

#include "analysis/dynamics/bonds/bond_forces.hpp"
#include "assembly/internal_force.hpp"
#include "material/softening.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

struct LawCase {
  std::string name;
  SofteningShape shape;
  double energy;
  double overshoot;
};

std::ostream& operator<<(std::ostream& out, const LawCase& law) { return out << law.name; }

std::vector<LawCase> laws() {
  return {{"linear", {Softening::linear}, 3.0, 0.07},
          {"linear_coarse", {Softening::linear}, 4.0, 0.6},
          {"bilinear", {Softening::bilinear}, 3.0, 0.07},
          {"exponential", {Softening::exponential}, 2.5, 0.07}};
}

class SofteningBonds : public testing::TestWithParam<LawCase> {
 protected:
  BondLaw law() const { return saw_tooth_of(curve(), GetParam().overshoot); }
  SofteningCurve curve() const { return {GetParam().shape, GetParam().energy}; }
};

/// Two parallel bonds of stiffness 10, length one and critical stretch 1/2.
struct PulledBonds {
  AnalysisBody body = make_chains(1, 2, true, stiffness, critical);
  std::unique_ptr<ExplicitBonds> bonds;
  double lost = 0.0;  ///< by both bonds

  static constexpr double stiffness = 10.0, critical = 0.5;

  explicit PulledBonds(const BondLaw& law) {
    body.network.laws.front() = law;
    bonds = make_explicit_bonds(body.network);
  }
  BondMotion at(double x) const {
    BondMotion motion;
    motion.displacement = linear_field(body.network.particles, {{{x * critical, 0, 0}, {}, {}}});
    motion.velocity.assign(motion.displacement.size(), 0.0);
    return motion;
  }
  /// Returns the force of one bond over the force at the critical stretch.
  double pull(double x) {
    std::vector<double> force(8, 0.0);
    lost += bonds->forces(0, 4, 0.0, at(x), force).fractured;
    double sum = 0.0;
    for (const double f : force) sum += 0.5 * std::abs(f);
    return 0.5 * sum / (stiffness * critical);
  }
  /// Returns the energy of one bond over k s_c^2.
  double stored(double x) const {
    return 0.5 * bonds->stored(0, 4, 0.0, at(x)) / (stiffness * critical * critical);
  }
  double dissipated() const { return 0.5 * lost / (stiffness * critical * critical); }
};

TEST_P(SofteningBonds, FollowTheirCurveAndTakeItsEnergy) {
  PulledBonds pulled(law());
  const double end = 1.1 * law().segment(0).limit * curve().end();
  double work = 0.0, before = 0.0;
  constexpr int steps = 20000;
  for (int i = 1; i <= steps; ++i) {
    const double x = i * end / steps;
    const double force = pulled.pull(x);
    EXPECT_LT(force, curve().force(x) + GetParam().overshoot * (1.0 + 1e-8)) << x;
    work += 0.5 * (before + force) * end / steps;
    before = force;
  }
  EXPECT_EQ(before, 0.0) << "broken";
  // A segment drops at the end of the step that contains its limit. Steps are at most 1e-3 of the
  // critical stretch.
  EXPECT_NEAR(2.0 * pulled.dissipated(), GetParam().energy, 0.001 * GetParam().energy);
  EXPECT_NEAR(2.0 * work, GetParam().energy, 0.002 * GetParam().energy);
}

/// Tests stretches just below, at and above the event of every segment.
TEST_P(SofteningBonds, FallToTheNextToothAtTheirLimitOnly) {
  const BondLaw law = this->law();
  PulledBonds pulled(law);
  for (int k = 0; law.segment(k).secant > 0.0; ++k) {
    const Segment now = law.segment(k), next = law.segment(k + 1);
    EXPECT_NEAR(pulled.pull(now.limit * (1.0 - 1e-9)), now.secant * now.limit, 1e-8) << k;
    EXPECT_NEAR(pulled.pull(now.limit * (1.0 + 1e-9)), next.secant * now.limit, 1e-8) << k;
    // Back to zero along the secant, and into compression.
    for (const double x : {0.5 * now.limit, 0.0, -now.limit}) {
      EXPECT_NEAR(pulled.pull(x), next.secant * std::abs(x), 1e-12) << k;
      EXPECT_NEAR(pulled.stored(x), 0.5 * next.secant * x * x, 1e-12) << k;
    }
  }
}

/// Bodies have intact, softened and broken bonds.
TEST_P(SofteningBonds, ForceIsTheDerivativeOfTheEnergyAndStiffnessThatOfTheForce) {
  for (const bool micropolar : {false, true}) {
    AnalysisBody body = make_block(
        {{"plane", Pattern::rectangular, Surface::none}, false, false, 5, 0.1, micropolar});
    Network& network = body.network;
    network.laws.front() = law();
    const auto bonds = make_explicit_bonds(network);
    const Index particles = network.particles.size();
    const auto slots = body.unknowns.number.size();
    BondMotion motion{random_vector(slots, 4), std::vector<double>(slots, 0.0)};
    for (double& u : motion.displacement) u *= 0.05;
    std::vector<double> force(slots, 0.0);
    bonds->forces(0, particles, 0.0, motion, force);
    const std::vector<double> secants = bonds->secants();
    const auto count = [&](auto is) { return std::count_if(secants.begin(), secants.end(), is); };
    EXPECT_GT(count([](double a) { return a == 1.0; }), 10);
    EXPECT_GT(count([](double a) { return a > 0.0 && a < 1.0; }), 10);
    EXPECT_GT(count([](double a) { return a == 0.0; }), 10);

    // Compared with implicit runs: round-off of about forty bonds per particle.
    const InternalForce expected = internal_force(network, secants, motion.displacement);
    const double scale = *std::max_element(network.stiffness.begin(), network.stiffness.end());
    for (std::size_t k = 0; k < slots; ++k) {
      EXPECT_NEAR(force[k], expected.forces[k], 1e-12 * scale);
    }
    const double whole = bonds->stored(0, particles, 0.0, motion);
    EXPECT_NEAR(whole, expected.energy, 1e-12 * whole);

    const Eigen::MatrixXd stiffness = dense_stiffness(network, secants);
    const Eigen::VectorXd linear =
        stiffness *
        Eigen::Map<const Eigen::VectorXd>(motion.displacement.data(), static_cast<Index>(slots));
    constexpr double step = 1e-3;  // energy of a state is quadratic: no truncation error
    for (std::size_t k = 0; k < slots; k += 5) {
      EXPECT_NEAR(linear[static_cast<Index>(k)], force[k], 1e-12 * scale);
      BondMotion above = motion, below = motion;
      above.displacement[k] += step;
      below.displacement[k] -= step;
      const double difference =
          bonds->stored(0, particles, 0.0, above) - bonds->stored(0, particles, 0.0, below);
      EXPECT_NEAR(0.5 * difference / step, force[k], 1e-14 * whole / step + 1e-12 * scale);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Curves, SofteningBonds, testing::ValuesIn(laws()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace perilink

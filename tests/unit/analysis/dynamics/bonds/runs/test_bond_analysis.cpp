#include "analysis/dynamics/bonds/runs/bond_analysis.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "analysis/dynamics/fundamental_period.hpp"
#include "app/process/serve.hpp"
#include "support/analysis_bodies.hpp"
#include "support/particle_clouds.hpp"
#include "support/thread_ranks.hpp"

namespace perilink {
namespace {

using namespace test;

const std::vector densities = {1.0, 1.0};  // by material

/// Keeps the rows and the last state.
class Recorder final : public BondRunObserver {
 public:
  void on_row(const ExplicitRecord& record, const BondRunState& state) override {
    rows.push_back(record);
    motion = state.motion;
    secants = state.bonds.secants();
    broken = state.broken;
    for (Index e = 0; e < state.network.first_bar_element; ++e) {
      if (secants[e] == 0.0 && !std::count(seen.begin(), seen.end(), e)) seen.push_back(e);
    }
  }
  void on_end(const ExplicitRecord&, const BondRunState&) override { ++ends; }
  bool stop_requested() override { return stop_after > 0 && rows.size() >= stop_after; }

  std::size_t stop_after = 0;
  int ends = 0;
  std::vector<ExplicitRecord> rows;
  BondMotion motion;
  std::vector<double> secants;
  std::vector<Index> broken;
  std::vector<Index> seen;  ///< to be broken, row after row, in a row by their numbers
};

struct Outcome {
  ExplicitResult result;
  Recorder recorder;
};

Outcome run(const AnalysisBody& body, const ExplicitOptions& options, const BondRunRules& rules,
            std::size_t stop_after = 0) {
  const Inertia inertia = lumped_inertia(body.network, densities, MassScaling::none, rules.strain);
  Outcome outcome;
  outcome.recorder.stop_after = stop_after;
  outcome.result = run_explicit_bonds(body, inertia, rules, options, outcome.recorder);
  return outcome;
}

ExplicitOptions slow_options(const AnalysisBody& body, double periods, double reference) {
  const Inertia inertia = lumped_inertia(body.network, std::vector{1.0});
  const double period = fundamental_period(body.network, body.unknowns, inertia);
  ExplicitOptions options;
  options.duration = periods * period;
  options.ramp = 0.8 * options.duration;
  options.reference = reference;
  options.rows = 400;
  return options;
}

AnalysisBody scaled(AnalysisBody body, double factor) {
  for (double& value : body.unknowns.prescribed) value *= factor;
  for (double& value : body.loads.forces) value *= factor;
  body.reference.value *= factor;
  return body;
}

/// Loaded twice as much as the first bond carries in static equilibrium.
AnalysisBody overloaded(const AnalysisBody& body) {
  const Network& network = body.network;
  const Eigen::VectorXd motion = dense_displacement(body, intact(network));
  double largest = 0.0;
  for (Index e = 0; e < network.first_bar_element; ++e) {
    double extension = 0.0;
    for (int a = 0; a < network.dim(); ++a) {
      extension += network.bonds.direction(e)[a] *
                   (motion[static_cast<Index>(slot(body, network.bonds.second[e], a))] -
                    motion[static_cast<Index>(slot(body, network.bonds.first[e], a))]);
    }
    largest =
        std::max(largest, extension / (network.bonds.lengths[e] * network.critical_stretch[e]));
  }
  return scaled(body, 2.0 / largest);
}

const LatticeCase square{"square", Pattern::rectangular, Surface::none};
const LatticeCase cube{"cube", Pattern::cubic, Surface::none};

class BondRuns : public testing::TestWithParam<BlockCase> {};

/// The balance is exact except for round-off, elastic or breaking, damped or not.
TEST_P(BondRuns, EnergyIsAccountedFor) {
  const AnalysisBody body = overloaded(make_block(GetParam()));
  for (const double rate : {0.0, 3.0}) {
    const Outcome outcome = run(body, slow_options(body, 4.0, body.reference.value), {rate});
    EXPECT_EQ(outcome.result.termination, Termination::completed) << outcome.result.reason;
    EXPECT_GT(outcome.result.last.broken_bonds, 0);
    EXPECT_GT(outcome.result.last.energy.fractured, 0.0);
    EXPECT_EQ(outcome.result.last.energy.external_damping > 0.0, rate > 0.0);
    // Round-off of energies over some thousand steps.
    EXPECT_LT(outcome.result.largest_surplus, 1e-11);
  }
}

TEST_P(BondRuns, ThreadsChangeNothing) {
  AnalysisBody body = overloaded(make_block(GetParam()));
  ExplicitOptions options = slow_options(body, 1.0, body.reference.value);
  const Outcome one = run(body, options, {1.0});
  options.threads = 2;
  const Outcome two = run(body, options, {1.0});
  EXPECT_EQ(one.recorder.motion.displacement, two.recorder.motion.displacement);
  ASSERT_EQ(one.recorder.rows.size(), two.recorder.rows.size());
  for (std::size_t r = 0; r < one.recorder.rows.size(); ++r) {
    EXPECT_EQ(one.recorder.rows[r].load, two.recorder.rows[r].load);
    EXPECT_EQ(one.recorder.rows[r].energy.surplus(), two.recorder.rows[r].energy.surplus());
  }
}

/// A run with a row at every step shows which bond broke in which step. A run with almost no rows
/// reports this order too.
TEST_P(BondRuns, KnowInWhichOrderBondsBroke) {
  AnalysisBody body = overloaded(make_block(GetParam()));
  ExplicitOptions options = slow_options(body, 1.0, body.reference.value);
  options.rows = 1000000000;
  const Outcome all = run(body, options, {1.0});
  ASSERT_GT(all.recorder.seen.size(), 2U);
  options.rows = 1;
  const Outcome few = run(body, options, {1.0});
  EXPECT_EQ(few.recorder.broken, all.recorder.seen);
  EXPECT_EQ(all.recorder.broken, all.recorder.seen);
  EXPECT_FALSE(std::is_sorted(few.recorder.broken.begin(), few.recorder.broken.end()))
      << "else the test shows nothing";
  EXPECT_EQ(few.result.last.broken_bonds, static_cast<Index>(few.recorder.broken.size()));
}

/// An elastic body loaded slowly and damped reaches static equilibrium.
TEST_P(BondRuns, ComeToRestInEquilibrium) {
  AnalysisBody body = make_block(GetParam());
  std::fill(body.network.critical_stretch.begin(), body.network.critical_stretch.end(), INFINITY);
  ExplicitOptions options = slow_options(body, 40.0, body.reference.value);
  options.ramp = 0.3 * options.duration;
  const double rate = 2.0 * 2.0 * 3.14159 * 40.0 / options.duration;  // critical damping
  const Outcome outcome = run(body, options, {rate});
  const Eigen::VectorXd statics = dense_displacement(body, intact(body.network));
  // exp(-28 periods' damping) is left of the motion; 1e-6 is far above and far below errors.
  EXPECT_LT(difference(outcome.recorder.motion.displacement, statics), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, BondRuns,
    testing::Values(BlockCase{{"plane", Pattern::rectangular, Surface::none}, true},
                    BlockCase{{"plane", Pattern::rectangular, Surface::none}, false, true},
                    BlockCase{{"space", Pattern::cubic, Surface::none}, true, false, 4},
                    BlockCase{
                        {"plane", Pattern::rectangular, Surface::none}, true, false, 6, 0.1, true},
                    BlockCase{{"space", Pattern::cubic, Surface::none}, true, false, 4, 0.1, true}),
    [](const auto& body) { return to_string(body.param) + std::to_string(body.index); });

/// Springs in series break at the force k xi s_c. Under slow loading the support carries this force
/// before they break.
TEST(ExplicitBondAnalysis, AChainBreaksAtItsStrength) {
  const double stiffness = 10.0, limit = 0.01;
  const AnalysisBody body = scaled(make_chains(6, 2, true, stiffness, limit), 0.1);
  const Outcome outcome = run(body, slow_options(body, 300.0, 0.1), {});
  EXPECT_EQ(outcome.result.termination, Termination::completed);
  EXPECT_GE(outcome.result.last.broken_bonds, 2);  // the waves of the first break others
  // Vibration excited by the ramp in a chain of this length; longer ramps excite less.
  EXPECT_NEAR(std::abs(outcome.result.peak_load), 2.0 * stiffness * limit,
              0.02 * stiffness * limit);
  EXPECT_NEAR(outcome.result.peak_displacement, 6.0 * limit, 0.02 * 6.0 * limit);
}

TEST(ExplicitBondAnalysis, StepsBeyondTheCriticalOneAreRefused) {
  const AnalysisBody body = make_chains(6, 2, true, 10.0, INFINITY);
  const Inertia inertia = lumped_inertia(body.network, std::vector{1.0});
  ExplicitOptions options;
  options.duration = 100.0;
  options.ramp = 50.0;
  options.time_step = 1.01 * inertia.critical_time_step();
  EXPECT_THROW(run(body, options, {}), std::invalid_argument);
  options.time_step = 0.99 * inertia.critical_time_step();
  EXPECT_EQ(run(body, options, {}).result.termination, Termination::completed);
  options.duration = 0.0;
  EXPECT_THROW(run(body, options, {}), std::invalid_argument);
}

/// The bound of a chain is that of an endless one. Slightly beyond it the motion grows, and the run
/// fails with a message instead of NaN.
TEST(ExplicitBondAnalysis, UnstableRunsEnd) {
  const AnalysisBody body = make_chains(40, 2, true, 10.0, INFINITY);
  const Inertia inertia = lumped_inertia(body.network, std::vector{1.0});
  ExplicitOptions options;
  options.time_step = 1.05 * inertia.critical_time_step();
  options.duration = 5000.0 * options.time_step;
  options.ramp = options.duration;
  options.refuse_unstable = false;
  const Outcome outcome = run(body, options, {});
  EXPECT_EQ(outcome.result.termination, Termination::failed);
  EXPECT_NE(outcome.result.reason.find("time step"), std::string::npos);
  EXPECT_LT(outcome.result.steps, 5000);
}

/// Breaking at stretches of some thousandths, the energies balance to a part of the kinetic one as
/// small as that.
TEST(ExplicitBondAnalysis, EnergyOfGreenStrainsIsAccountedFor) {
  AnalysisBody body =
      overloaded(make_block({{"plane", Pattern::rectangular, Surface::none}, true}));
  const double largest_stretch =
      *std::max_element(body.network.critical_stretch.begin(), body.network.critical_stretch.end());
  const ExplicitOptions options = slow_options(body, 4.0, body.reference.value);
  const Outcome outcome = run(body, options, {0.0, Strain::green});
  EXPECT_EQ(outcome.result.termination, Termination::completed) << outcome.result.reason;
  EXPECT_GT(outcome.result.last.broken_bonds, 0);
  EXPECT_LT(outcome.result.largest_surplus, largest_stretch);
}

TEST(ExplicitBondAnalysis, VelocitiesAreConstant) {
  AnalysisBody body = scaled(make_chains(6, 2, true, 10.0, INFINITY), 0.3);
  ExplicitOptions options = slow_options(body, 2.0, 0.3);
  options.rows = 10;
  BondRunRules rules;
  rules.constant_velocity = true;
  const Outcome outcome = run(body, options, rules);
  EXPECT_EQ(outcome.result.termination, Termination::completed) << outcome.result.reason;
  const double speed = 0.3 / options.duration;
  for (const ExplicitRecord& row : outcome.recorder.rows) {
    EXPECT_NEAR(row.displacement, speed * row.time, 1e-12);
  }
  const BondMotion& motion = outcome.recorder.motion;
  for (std::size_t slot = 0; slot < motion.velocity.size(); ++slot) {
    if (body.unknowns.prescribed[slot] == 0.0) continue;
    EXPECT_NEAR(motion.velocity[slot], speed, 1e-12 * speed);
    EXPECT_NEAR(motion.displacement[slot], speed * outcome.result.last.time, 1e-12);
  }
  // The blow of the first step is accounted for as well.
  EXPECT_LT(outcome.result.largest_surplus, 1e-11);
}

void expect_the_same(const Outcome& found, const Outcome& alone) {
  EXPECT_EQ(found.recorder.motion.displacement, alone.recorder.motion.displacement);
  EXPECT_EQ(found.recorder.motion.velocity, alone.recorder.motion.velocity);
  EXPECT_EQ(found.recorder.secants, alone.recorder.secants);
  EXPECT_EQ(found.recorder.broken, alone.recorder.broken);
  EXPECT_EQ(found.recorder.ends, 1);
  EXPECT_EQ(found.result.peak_load, alone.result.peak_load);
  EXPECT_EQ(found.result.peak_displacement, alone.result.peak_displacement);
  EXPECT_EQ(found.result.termination, alone.result.termination);
  EXPECT_EQ(found.recorder.rows, alone.recorder.rows);
}

bool has_fallen_slip_spring(const Network& network, const std::vector<double>& secants) {
  const auto first = secants.begin();
  return std::any_of(first + network.first_embedded_slip_spring, first + network.first_bar_element,
                     [](double secant) { return secant < 1.0; });
}

/// Some hundred steps in which bonds break along a path through the parts of several ranks.
void expect_ranks_to_change_nothing(const AnalysisBody& body, Strain strain) {
  const Inertia inertia = lumped_inertia(body.network, densities, MassScaling::none, strain);
  ExplicitOptions options;
  options.duration = 400.0 * inertia.critical_time_step();
  options.ramp = 0.8 * options.duration;
  options.rows = 20;
  const BondRunRules rules{.damping_rate = 0.1 / options.duration, .strain = strain};
  for (const std::size_t stop_after : {0, 7}) {
    const Outcome alone = run(body, options, rules, stop_after);
    EXPECT_GT(alone.recorder.broken.size(), 20U);
    if (body.network.embedded_points.size() > 0) {
      EXPECT_TRUE(has_fallen_slip_spring(body.network, alone.recorder.secants));
    }
    for (const int count : {2, 3}) {
      with_thread_ranks(
          count,
          [&](Ranks& ranks) {
            ExplicitOptions shared = options;
            shared.ranks = &ranks;
            const Outcome found = run(body, shared, rules, stop_after);
            dismiss(ranks);
            EXPECT_EQ(found.result.ranks, count);
            expect_the_same(found, alone);
          },
          serve);
    }
  }
}

class SharedBondRuns : public testing::TestWithParam<std::tuple<BlockCase, Strain>> {};

TEST_P(SharedBondRuns, RanksChangeNothing) {
  const auto& [block, strain] = GetParam();
  const AnalysisBody body = make_block(block);
  const auto limits = body.network.critical_stretch.begin();
  const double stretch = *std::min_element(limits, limits + body.network.first_slip_spring);
  expect_ranks_to_change_nothing(
      scaled(body, block.driven ? 2.0 * stretch * block.columns : 600.0 * stretch), strain);
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, SharedBondRuns,
    testing::Values(
        std::tuple{BlockCase{.lattice = square, .driven = true, .columns = 30}, Strain::small},
        std::tuple{BlockCase{.lattice = square, .columns = 30, .scatter = 0.0}, Strain::small},
        std::tuple{
            BlockCase{
                .lattice = cube, .driven = true, .columns = 9, .scatter = 0.0, .closing = true},
            Strain::small},
        std::tuple{BlockCase{.lattice = cube, .driven = true, .columns = 9, .scatter = 0.0},
                   Strain::small},
        std::tuple{BlockCase{.lattice = square,
                             .driven = true,
                             .columns = 30,
                             .micropolar = true,
                             .toothed = true},
                   Strain::small},
        std::tuple{BlockCase{.lattice = square, .driven = true, .columns = 30}, Strain::green},
        std::tuple{
            BlockCase{
                .lattice = square, .driven = true, .bar = true, .columns = 30, .slipping = true},
            Strain::small}),
    [](const auto& instance) {
      return to_string(std::get<0>(instance.param)) + std::to_string(instance.index);
    });

/// A square or cube of two materials that crack differently, fixed and displaced at opposite faces.
TEST(ExplicitBondAnalysis, ParticlesCrackOnTheWay) {
  for (const int dim : {2, 3}) {
    AnalysisBody body = free_body(unstructured_particles(dim, dim == 2 ? 30 : 9).network);
    const Particles& particles = body.network.particles;
    const auto x = [&](Index i) { return particles.position(i)[0]; };
    for (Index i = 0; i < particles.size(); ++i) {
      if (x(i) == 1.0) body.unknowns.prescribed[slot(body, i, 0)] = 4e-3;
      body.network.particles.material[i] = i % 3 == 0 ? 1 : 0;
    }
    number(body, [&](Index i, int) { return x(i) == 0.0 || x(i) == 1.0; });
    body.reference = {true, 4e-3};
    BondRunRules rules;
    rules.states.problem = dim == 2 ? Problem::plane_stress : Problem::three_dimensional;
    // Strains reach 40 times those at the strength.
    for (const double strength : {0.003, 0.005}) {
      rules.states.materials.push_back(
          {soft_solid.youngs_modulus,
           soft_solid.poissons_ratio,
           true,
           {.strength = strength, .knee_opening = 2e-5, .critical_opening = 2e-4}});
    }
    const Inertia inertia = lumped_inertia(body.network, densities);
    ExplicitOptions options;
    options.duration = 400.0 * inertia.critical_time_step();
    options.ramp = 0.8 * options.duration;
    options.rows = 20;
    const Outcome outcome = run(body, options, rules);
    EXPECT_EQ(outcome.result.termination, Termination::completed) << outcome.result.reason;
    EXPECT_GT(outcome.recorder.broken.size(), 20U);
    EXPECT_EQ(outcome.result.last.cracked_particles, outcome.recorder.broken.size());
    EXPECT_GT(outcome.result.last.energy.fractured, 0.0);
    // Bonds stiffen where cracks close (docs/theory/explicit_bonds.md): 2.5e-4 was measured.
    EXPECT_LT(outcome.result.largest_surplus, 1e-3);
  }
}

TEST(ExplicitBondAnalysis, StopsWhenAsked) {
  const AnalysisBody body = make_chains(6, 2, true, 10.0, INFINITY);
  ExplicitOptions options;
  options.duration = options.ramp = 10.0;
  options.rows = 10;
  const Outcome outcome = run(body, options, {}, 3);
  EXPECT_EQ(outcome.result.termination, Termination::interrupted);
  EXPECT_EQ(outcome.recorder.rows.size(), 4U) << "asked before a row, which is the last";
  EXPECT_EQ(outcome.recorder.ends, 1);
}

}  // namespace
}  // namespace perilink

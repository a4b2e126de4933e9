// A run over time that is saved, read again and continued in a new body repeats the run that was
// never stopped: every row, every state and every later checkpoint, bit for bit.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "analysis/dynamics/bonds/runs/bond_analysis.hpp"
#include "analysis/dynamics/bonds/runs/dynamic_relaxation.hpp"
#include "analysis/dynamics/lattice/lattice_analysis.hpp"
#include "app/process/serve.hpp"
#include "support/analysis_bodies.hpp"
#include "support/lattice_models.hpp"
#include "support/particle_clouds.hpp"
#include "support/saved_states.hpp"
#include "support/thread_ranks.hpp"

namespace perilink {
namespace {

using namespace test;

/// All that a run shows.
struct Shown {
  std::vector<ExplicitRecord> rows;
  std::vector<std::size_t> states;           ///< hashes of the observed state, per row
  std::map<Index, std::string> checkpoints;  ///< by the step of the last row
  std::string result;                        ///< its bytes
};

/// Saves checkpoints after random rows.
template <class State>
class Saver final : public RunObserver<State> {
 public:
  using Look = std::function<std::string(const State&)>;
  Saver(bool saves, Look look) : saves_(saves), look_(std::move(look)) {}

  void on_row(const ExplicitRecord& record, const State& state) override {
    shown.rows.push_back(record);
    shown.states.push_back(std::hash<std::string>{}(look_(state)));
  }
  bool wants_checkpoint(const ExplicitRecord& last) override {
    return saves_ && std::mt19937(static_cast<unsigned>(last.step))() % 2 == 0;
  }
  void on_checkpoint(const TimeState& state) override {
    shown.checkpoints[shown.rows.back().step] = bytes_of(state);
  }

  Shown shown;

 private:
  bool saves_;
  Look look_;
};

/// Builds a body and runs it; saves no checkpoints with `saves` false.
using Run = std::function<Shown(int threads, bool saves, const TimeState* from)>;

double lost_in(const ExplicitRecord& row) { return row.energy.fractured + row.energy.plastic; }

void expect_end_of(const Shown& whole, const Shown& resumed) {
  ASSERT_LE(resumed.rows.size(), whole.rows.size());
  const std::size_t first = whole.rows.size() - resumed.rows.size();
  for (std::size_t k = 0; k < resumed.rows.size(); ++k) {
    EXPECT_EQ(resumed.rows[k], whole.rows[first + k]) << "row " << first + k;
    EXPECT_TRUE(resumed.states[k] == whole.states[first + k]) << "row " << first + k;
  }
  for (const auto& [step, bytes] : resumed.checkpoints) {
    EXPECT_TRUE(bytes == whole.checkpoints.at(step)) << "checkpoint after the row of step " << step;
  }
  EXPECT_TRUE(resumed.result == whole.result);
}

/// \param changes  bonds break, particles crack or yield before some checkpoint and after it
void expect_to_go_on(const Run& run, bool changes = true) {
  const Shown never_saved = run(1, false, nullptr);
  EXPECT_TRUE(never_saved.checkpoints.empty());
  for (const int threads : {1, 2}) {
    const Shown whole = run(threads, true, nullptr);
    expect_end_of(whole, never_saved);
    ASSERT_EQ(whole.rows.size(), never_saved.rows.size());
    ASSERT_GE(whole.checkpoints.size(), 3U);
    bool changed = false;
    const std::size_t apart = 1 + whole.checkpoints.size() / 5;
    std::size_t number = 0;
    for (const auto& [step, bytes] : whole.checkpoints) {
      if (++number % apart != 0) continue;
      const TimeState from = state_of(bytes);
      EXPECT_EQ(bytes_of(from), bytes);
      const Shown resumed = run(3 - threads, true, &from);
      ASSERT_FALSE(resumed.rows.empty());
      EXPECT_GT(resumed.rows.front().step, step);
      expect_end_of(whole, resumed);
      const double before = lost_in(from.record);
      changed |= before != 0.0 && before != lost_in(whole.rows.back());
    }
    EXPECT_EQ(changed, changes);
  }
}

std::string look_at(const BondRunState& state) {
  return bytes_of(state.motion.displacement) + bytes_of(state.motion.velocity) +
         bytes_of(state.bonds.secants()) + bytes_of(state.bonds.damage()) + bytes_of(state.broken) +
         bytes_of(state.reactions());
}

AnalysisBody scaled_loads(AnalysisBody body, double factor) {
  for (double& value : body.unknowns.prescribed) value *= factor;
  for (double& value : body.loads.forces) value *= factor;
  body.reference.value *= factor;
  return body;
}

/// Loads at which bonds of a block break.
AnalysisBody breaking_block(const BlockCase& block) {
  const AnalysisBody body = make_block(block);
  const auto limits = body.network.critical_stretch.begin();
  const double stretch = *std::min_element(limits, limits + body.network.first_slip_spring);
  return scaled_loads(body, block.driven ? 2.0 * stretch * block.columns : 600.0 * stretch);
}

Shown run_bonds(const AnalysisBody& body, BondRunRules rules, int rows, int threads, bool saves,
                const TimeState* from) {
  const Inertia inertia =
      lumped_inertia(body.network, std::vector{1.0, 1.0}, MassScaling::none, rules.strain);
  ExplicitOptions options;
  options.duration = 400.0 * inertia.critical_time_step();
  options.ramp = 0.8 * options.duration;
  options.rows = rows;
  options.threads = threads;
  rules.damping_rate /= options.duration;
  Saver<BondRunState> saver(saves, look_at);
  const ExplicitResult result = run_explicit_bonds(body, inertia, rules, options, saver, from);
  EXPECT_EQ(result.termination, Termination::completed) << result.reason;
  saver.shown.result = bytes_of(result);
  return saver.shown;
}

struct BlockRun {
  BlockCase block;
  BondRunRules rules;  ///< damping rate over the duration [-]
  int rows = 20;
};

std::ostream& operator<<(std::ostream& out, const BlockRun& run) { return out << run.block; }

class ResumedBlocks : public testing::TestWithParam<BlockRun> {};

TEST_P(ResumedBlocks, RepeatTheRunThatWasNeverStopped) {
  expect_to_go_on([&](int threads, bool saves, const TimeState* from) {
    AnalysisBody body = breaking_block(GetParam().block);
    if (GetParam().block.scatter == 0.0) {  // with elastic supports
      body.network.support_stiffness.assign(body.unknowns.number.size(), 1e-3);
    }
    return run_bonds(body, GetParam().rules, GetParam().rows, threads, saves, from);
  });
}

// Plane blocks of 2209 particles are divided between two threads. An odd number of steps lies
// between rows where 400 / 0.9 steps have 57 rows.
const LatticeCase plane{"plane", Pattern::rectangular, Surface::none};
const LatticeCase space{"space", Pattern::cubic, Surface::none};

INSTANTIATE_TEST_SUITE_P(
    Kinds, ResumedBlocks,
    testing::Values(
        BlockRun{{.lattice = plane, .driven = true, .columns = 46}, {}},
        BlockRun{{.lattice = plane, .columns = 46, .scatter = 0.0}, {.damping_rate = 0.1}, 57},
        BlockRun{{.lattice = plane, .driven = true, .columns = 20, .toothed = true}, {}, 1000},
        BlockRun{{.lattice = space, .driven = true, .columns = 6, .closing = true},
                 {.damping_rate = 0.1}},
        BlockRun{
            {.lattice = plane, .driven = true, .columns = 20, .micropolar = true, .toothed = true},
            {}},
        BlockRun{{.lattice = space, .driven = true, .columns = 5, .micropolar = true}, {}},
        BlockRun{{.lattice = plane, .driven = true, .columns = 20}, {.strain = Strain::green}},
        BlockRun{{.lattice = plane, .driven = true, .bar = true, .columns = 20},
                 {.constant_velocity = true}},
        BlockRun{{.lattice = plane, .driven = true, .bar = true, .columns = 46, .slipping = true},
                 {}}),
    [](const auto& run) { return fmt::format("{}_{}", to_string(run.param.block), run.index); });

/// State-based particles of two materials, displaced at one face.
TEST(ResumedMotion, OfParticlesThatCrack) {
  for (const int dim : {2, 3}) {
    expect_to_go_on([dim](int threads, bool saves, const TimeState* from) {
      AnalysisBody body = free_body(unstructured_particles(dim, dim == 2 ? 46 : 7).network);
      Particles& particles = body.network.particles;
      const auto x = [&](Index i) { return particles.position(i)[0]; };
      for (Index i = 0; i < particles.size(); ++i) {
        if (x(i) == 1.0) body.unknowns.prescribed[slot(body, i, 0)] = 4e-3;
        particles.material[i] = i % 3 == 0 ? 1 : 0;
      }
      number(body, [&](Index i, int) { return x(i) == 0.0 || x(i) == 1.0; });
      body.reference = {true, 4e-3};
      BondRunRules rules;
      rules.states.problem = dim == 2 ? Problem::plane_stress : Problem::three_dimensional;
      for (const double strength : {0.003, 0.005}) {
        rules.states.materials.push_back(
            {soft_solid.youngs_modulus,
             soft_solid.poissons_ratio,
             true,
             {.strength = strength, .knee_opening = 2e-5, .critical_opening = 2e-4}});
      }
      return run_bonds(body, rules, 20, threads, saves, from);
    });
  }
}

Shown relax(const AnalysisBody& body, RelaxationOptions options, int threads, bool saves,
            const TimeState* from) {
  options.threads = threads;
  Saver<BondRunState> saver(saves, look_at);
  const RelaxationResult result = run_dynamic_relaxation(body, options, saver, from);
  EXPECT_NE(result.termination, Termination::failed) << result.reason;
  saver.shown.result =
      fmt::format("{} {} {} {} {} {}", result.reason, result.iterations, result.residual,
                  result.error, result.peak_load, bytes_of(result.displacement)) +
      bytes_of(result.last);
  return saver.shown;
}

std::vector<double> even_factors(int count, double last) {
  std::vector<double> factors;
  for (int k = 1; k <= count; ++k) factors.push_back(last * k / count);
  return factors;
}

TEST(ResumedMotion, OfBlocksThatRelaxAndBreak) {
  for (const bool green : {false, true}) {
    expect_to_go_on([green](int threads, bool saves, const TimeState* from) {
      RelaxationOptions options;
      options.load_factors = green ? even_factors(24, 0.35) : even_factors(12, 0.18);
      options.tolerance = 1e-5;
      options.strain = green ? Strain::green : Strain::small;
      const int columns = green ? 10 : 46;
      return relax(breaking_block({.lattice = plane,
                                   .driven = true,
                                   .columns = columns,
                                   .scatter = 0.5,
                                   .toothed = true}),
                   options, threads, saves, from);
    });
  }
}

/// Two rows of springs break and the run ends as collapsed.
TEST(ResumedMotion, OfChainsThatCollapse) {
  expect_to_go_on(
      [](int threads, bool saves, const TimeState* from) {
        RelaxationOptions options;
        options.load_factors = even_factors(70, 0.07);
        options.tolerance = 1e-8;
        return relax(make_chains(6, 2, true, 10.0, 0.01), options, threads, saves, from);
      },
      false);
}

class ResumedLattices : public testing::TestWithParam<testing_support::LatticeKind> {};

/// Bodies of more than 8000 particles are divided between two threads.
TEST_P(ResumedLattices, RepeatTheRunThatWasNeverStopped) {
  expect_to_go_on([](int threads, bool saves, const TimeState* from) {
    const ExplicitModel model = testing_support::changing_body(GetParam());
    // In one body every step has a row, with the forces of the step before.
    const bool steps = model.lattice.dim == 2 && !GetParam().yields;
    ExplicitOptions options = testing_support::short_run(model, model.lattice.dim == 2 ? 91 : 31);
    options.rows = steps ? 91 : 12;
    options.threads = threads;
    options.reference = 1e-6;
    ExplicitState state(model);
    testing_support::shake_velocities(model, state);
    Saver<ExplicitState> saver(saves, [](const ExplicitState& now) {
      return bytes_of(static_cast<const LatticeState&>(now)) + bytes_of(now.in_tension) +
             bytes_of(now.in_compression) + bytes_of(now.root_compression) +
             bytes_of(now.share_tension) + bytes_of(now.now.stretch) + bytes_of(now.now.sum);
    });
    const ExplicitResult result = run_explicit_analysis(model, state, options, saver, from);
    saver.shown.result = bytes_of(result) + bytes_of(static_cast<const LatticeState&>(state));
    return saver.shown;
  });
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, ResumedLattices,
    testing::Values(
        testing_support::LatticeKind{Problem::plane_stress, LatticeRules::consistent, true, false},
        testing_support::LatticeKind{Problem::plane_strain, LatticeRules::consistent, true, true},
        testing_support::LatticeKind{Problem::three_dimensional, LatticeRules::consistent, true,
                                     true},
        testing_support::LatticeKind{Problem::plane_stress, LatticeRules::mean_2017, true, true},
        testing_support::LatticeKind{Problem::three_dimensional, LatticeRules::mean_2017, true,
                                     false},
        testing_support::LatticeKind{Problem::plane_stress, LatticeRules::least_2018, true, true}));

/// Disk that may be full.
class Disk final : public BondRunObserver {
 public:
  bool wants_checkpoint(const ExplicitRecord& last) override { return last.step > 0; }
  void on_checkpoint(const TimeState& state) override {
    saved = state;
    if (full) throw std::runtime_error("the disk is full");
  }
  bool full = true;
  TimeState saved;
};

TEST(ResumedMotion, RefusesStatesOfOtherRunsAndEndsWhereNoneCanBeWritten) {
  const AnalysisBody body = make_chains(6, 2, true, 10.0, INFINITY);
  const Inertia inertia = lumped_inertia(body.network, std::vector{1.0});
  ExplicitOptions options;
  options.duration = options.ramp = 10.0;
  options.rows = 10;
  Disk disk;
  const ExplicitResult failed = run_explicit_bonds(body, inertia, {}, options, disk);
  EXPECT_EQ(failed.termination, Termination::failed);
  EXPECT_EQ(failed.reason, "the disk is full");
  EXPECT_EQ(disk.saved.loop.result.last, failed.last);
  disk.full = false;
  const TimeState first = disk.saved;
  EXPECT_EQ(run_explicit_bonds(body, inertia, {}, options, disk, &first).termination,
            Termination::completed);
  const AnalysisBody longer = make_chains(7, 2, true, 10.0, INFINITY);
  const Inertia heavier = lumped_inertia(longer.network, std::vector{1.0});
  options.time_step = first.loop.result.time_step;
  EXPECT_THROW(run_explicit_bonds(longer, heavier, {}, options, disk, &first),
               std::invalid_argument);
  options.time_step *= 0.5;
  EXPECT_THROW(run_explicit_bonds(body, inertia, {}, options, disk, &first), std::invalid_argument);
  with_thread_ranks(
      2,
      [](Ranks& ranks) {
        const AnalysisBody plate = make_block({.lattice = plane, .driven = true, .columns = 30});
        ExplicitOptions shared;
        shared.duration = 1.0;
        shared.ranks = &ranks;
        BondRunObserver nobody;
        const TimeState state;
        EXPECT_THROW(run_explicit_bonds(plate, lumped_inertia(plate.network, std::vector{1.0, 1.0}),
                                        {}, shared, nobody, &state),
                     std::invalid_argument);
        dismiss(ranks);
      },
      serve);
}

}  // namespace
}  // namespace perilink

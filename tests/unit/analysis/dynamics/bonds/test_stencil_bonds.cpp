#include "analysis/dynamics/bonds/stencil_bonds.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/dynamics/bonds/runs/bond_analysis.hpp"
#include "support/analysis_bodies.hpp"
#include "support/stencil_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// Round-off of sums of some hundred forces of size one, and of positions over spacings.
constexpr double stencil_round_off = 1e-12;

double largest_of(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

void expect_close(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  const double tolerance = stencil_round_off * largest_of(expected);
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], tolerance) << k;
}

class StencilBodies : public testing::TestWithParam<StencilCase> {
 protected:
  void SetUp() override {
    ASSERT_FALSE(find_stencil(network_).kinds.empty());
    // Motions of the size at which half of the bonds in tension break.
    size_ = 0.2 * network_.critical_stretch[0] * network_.bonds.lengths[0];
  }

  Index count() const { return network_.particles.size(); }

  Network network_ = stencil_network(GetParam());
  double size_ = 0.0;
};

/// Compares with directed bonds stored one by one, while more and more break.
TEST_P(StencilBodies, DoWhatSingleHalvesDo) {
  const auto stencil = make_explicit_bonds(network_), halves = make_explicit_halves(network_);
  Index broken = 0;
  for (const unsigned seed : {3, 5, 7, 9}) {
    const BondMotion motion = random_motion(network_, seed * size_, seed);
    const ForcesOfAll found = forces_of_all(network_, *stencil, motion, 0.1);
    const ForcesOfAll expected = forces_of_all(network_, *halves, motion, 0.1);
    expect_close(found.force, expected.force);
    EXPECT_EQ(found.losses.broken_halves(), expected.losses.broken_halves());
    EXPECT_NEAR(found.losses.fractured, expected.losses.fractured,
                stencil_round_off * std::abs(expected.losses.fractured));
    EXPECT_EQ(stencil->secants(), halves->secants());
    const double stored = halves->stored(0, count(), 0.1, motion);
    EXPECT_NEAR(stencil->stored(0, count(), 0.1, motion), stored,
                stencil_round_off * std::abs(stored));
    broken += found.losses.broken_halves();
  }
  EXPECT_GT(broken, network_.num_elements() / 4);
  EXPECT_LT(broken, 2 * network_.num_elements());
}

/// Which particles are worked on together changes no bit.
TEST_P(StencilBodies, PartsMakeTheWhole) {
  const auto whole = make_explicit_bonds(network_), parts = make_explicit_bonds(network_);
  const BondMotion motion = random_motion(network_, 5.0 * size_, 11);
  const ForcesOfAll expected = forces_of_all(network_, *whole, motion, 0.1);
  std::vector<double> force(expected.force.size(), NAN);
  Index broken = 0;
  for (Index end = count(); end > 0; end -= 13) {  // backwards, and no multiple of a group
    broken += parts->forces(std::max<Index>(0, end - 13), end, 0.1, motion, force).broken_halves();
  }
  EXPECT_EQ(force, expected.force);
  EXPECT_EQ(broken, expected.losses.broken_halves());
  EXPECT_EQ(parts->secants(), whole->secants());
}

/// Results agree also where every bond is at its limit up to the last bits.
TEST_P(StencilBodies, BothHalvesBreakInTheSameStep) {
  const double strain = network_.critical_stretch[0];
  const int dim = network_.dim();
  for (const double part : {1.0 - 4e-16, 1.0, 1.0 + 4e-16}) {
    const auto bonds = make_explicit_bonds(network_);
    const double s = part * strain;
    BondMotion motion = random_motion(network_, 0.0, 1);
    motion.displacement =
        linear_field(network_.particles, {{{s, 0, 0}, {0, s, 0}, {0, 0, dim == 3 ? s : 0.0}}});
    const ForcesOfAll found = forces_of_all(network_, *bonds, motion, 0.1);
    const std::vector<double> secants = bonds->secants();
    const auto broken = static_cast<Index>(std::count(secants.begin(), secants.end(), 0.0));
    EXPECT_GT(broken, 0);
    EXPECT_LT(broken, network_.num_elements());
    EXPECT_EQ(found.losses.broken_halves(), 2 * broken);
    // No particle is pulled by a bond that does not pull its other end.
    Vector3 sum{};
    for (std::size_t slot = 0; slot < found.force.size(); ++slot) {
      sum[slot % dim] += found.force[slot];
    }
    for (const double f : sum) EXPECT_NEAR(f, 0.0, 1e-9 * largest_of(found.force));
  }
}

/// Bonds that can yield or cannot break are kept, whatever their stretch.
TEST_P(StencilBodies, UnbreakableBondsHold) {
  std::fill(network_.critical_stretch.begin(), network_.critical_stretch.end(), INFINITY);
  const auto stencil = make_explicit_bonds(network_), halves = make_explicit_halves(network_);
  const BondMotion motion = random_motion(network_, 1e9, 13);
  const ForcesOfAll found = forces_of_all(network_, *stencil, motion, 0.1);
  expect_close(found.force, forces_of_all(network_, *halves, motion, 0.1).force);
  EXPECT_EQ(found.losses.broken_halves(), 0);
}

INSTANTIATE_TEST_SUITE_P(Bodies, StencilBodies, testing::ValuesIn(stencil_cases()),
                         [](const auto& tested) { return tested.param.name; });

/// Bars and their slip springs are off the stencil, all other bonds on it.
TEST(StencilBonds, WorkBesideBars) {
  const AnalysisBody body =
      make_block({{"plane", Pattern::rectangular, Surface::none}, false, true, 12, 0.0});
  const Network& network = body.network;
  const auto stencil = make_explicit_bonds(network), halves = make_explicit_halves(network);
  ASSERT_FALSE(find_stencil(network).kinds.empty());
  ASSERT_FALSE(find_stencil(network).rest.empty());
  const BondMotion motion = random_motion(network, 0.04, 5);
  const ForcesOfAll found = forces_of_all(network, *stencil, motion, 0.1);
  const ForcesOfAll expected = forces_of_all(network, *halves, motion, 0.1);
  expect_close(found.force, expected.force);
  EXPECT_EQ(found.losses.broken_halves(), expected.losses.broken_halves());
  EXPECT_GT(found.losses.broken_halves(), 0);
  EXPECT_EQ(stencil->secants(), halves->secants());
}

/// Pulls a plate of 2 601 particles apart, enough for two threads.
class PulledPlate : public testing::Test {
 protected:
  class Recorder final : public BondRunObserver {
   public:
    void on_row(const ExplicitRecord& record, const BondRunState& state) override {
      rows.push_back(record);
      displacement = state.motion.displacement;
    }
    std::vector<ExplicitRecord> rows;
    std::vector<double> displacement;
  };

  PulledPlate() : body_(free_body(make_network({"", Pattern::rectangular, Surface::none}, 50))) {
    const double end = 50 * 0.2;
    const auto at = [&](Index i, double x) {
      return std::abs(body_.network.particles.position(i)[0] - x) < 1e-9;
    };
    const double reach = 0.5 * body_.network.critical_stretch[0] * end;
    for (Index i = 0; i < body_.network.particles.size(); ++i) {
      if (at(i, end)) body_.unknowns.prescribed[slot(body_, i, 0)] = reach;
    }
    number(body_, [&](Index i, int axis) { return at(i, 0.0) || (axis == 0 && at(i, end)); });
    body_.reference = {true, reach};
  }

  ExplicitResult run(int threads, Recorder& recorder) const {
    const Inertia inertia = lumped_inertia(body_.network, std::vector{1.0});
    ExplicitOptions options;
    options.duration = 60 * inertia.critical_time_step();
    options.ramp = options.duration / 2;
    options.rows = 20;
    options.threads = threads;
    return run_explicit_bonds(body_, inertia, {}, options, recorder);
  }

  AnalysisBody body_;
};

TEST_F(PulledPlate, EnergyIsAccountedForWhileBondsBreak) {
  Recorder recorder;
  const ExplicitResult result = run(1, recorder);
  EXPECT_EQ(result.termination, Termination::completed) << result.reason;
  EXPECT_GT(result.last.broken_bonds, 100);
  EXPECT_LT(result.largest_surplus, 1e-11);  // some steps with round-off of the energies
}

TEST_F(PulledPlate, ThreadsChangeNothing) {
  Recorder one, two;
  run(1, one);
  run(2, two);
  EXPECT_EQ(one.displacement, two.displacement);
  ASSERT_EQ(one.rows.size(), two.rows.size());
  for (std::size_t r = 0; r < one.rows.size(); ++r) {
    EXPECT_EQ(one.rows[r].energy.surplus(), two.rows[r].energy.surplus());
    EXPECT_EQ(one.rows[r].energy.fractured, two.rows[r].energy.fractured);
    EXPECT_EQ(one.rows[r].broken_bonds, two.rows[r].broken_bonds);
  }
}

TEST_P(StencilBodies, RestoredOnesPullAsTheSavedOnes) {
  const auto bonds = make_explicit_bonds(network_), restored = make_explicit_bonds(network_);
  const BondMotion breaking = random_motion(network_, 5.0 * size_, 21);
  ASSERT_FALSE(forces_of_all(network_, *bonds, breaking, 0.1).losses.broken.empty());
  MovingElements state;
  bonds->save(state);
  restored->restore(state);
  EXPECT_EQ(restored->secants(), bonds->secants());
  const BondMotion motion = random_motion(network_, 5.0 * size_, 22);
  EXPECT_EQ(forces_of_all(network_, *restored, motion, 0.1).force,
            forces_of_all(network_, *bonds, motion, 0.1).force);
  state.intact.pop_back();
  EXPECT_THROW(restored->restore(state), std::invalid_argument);
}

}  // namespace
}  // namespace perilink

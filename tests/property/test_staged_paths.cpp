// Invariants of every path of a damage analysis in stages, for any body and loads.

#include <gtest/gtest.h>

#include "support/staged_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// Balance over the largest work: energies are sums over several hundred events.
constexpr double staged_tolerance = 1e-9;

/// Row with energies and displacements computed from the elements.
struct StagedLook {
  StepRecord row;
  double stored = 0.0;
  double worst = 0.0;  ///< largest stretch over its limit
  double error = 0.0;  ///< difference of displacements from a dense solution
  /// Largest extension of a closed bond, or shortening of an open, damaged bond that can close,
  /// over the largest change of length.
  double wrong_side = 0.0;
};

/// Block under a constant transverse force, then with a force or displacement along x.
class StagedPath : public testing::TestWithParam<BlockCase> {
 protected:
  StagedPath() : body_(make_block(GetParam())) {
    LoadCase across = set_of(body_);
    across.reference = {false, 1.0};
    std::fill(across.unknowns.prescribed.begin(), across.unknowns.prescribed.end(), 0.0);
    std::fill(across.loads.forces.begin(), across.loads.forces.end(), 0.0);
    const Particles& particles = body_.network.particles;
    double total = 0.0;
    for (Index i = 0; i < particles.size(); ++i) {
      if (particles.kind[i] != ParticleKind::solid) continue;
      across.loads.forces[slot(body_, i, 1)] = -particles.volumes[i];
      across.loads.forces[slot(body_, i, 0)] = 0.3 * particles.volumes[i];
      total += particles.volumes[i];
    }
    across.reference.value = total;
    body_.sets = {across, set_of(body_)};
  }

  /// Returns the load factor of the first event of a load case without the others.
  double first_event(std::size_t set) const {
    Recorder recorder({}, 1);
    run(body_, in_stages({{set, {}, {}}}), recorder);
    return recorder.rows.at(0).load_factor;
  }

  void go(const DamageOptions& options, int most_rows = 400) {
    std::vector<double> factors(body_.sets.size(), 0.0);
    Recorder recorder(
        [&](const StepRecord& row, StateSource& source) {
          factors[options.stages[row.stage - 1].set] = row.load_factor;
          look(row, source.state(), factors);
        },
        most_rows);
    result_ = run(body_, options, recorder);
  }

  void look(const StepRecord& row, const StepState& state, const std::vector<double>& factors) {
    StagedLook look{row, stored_energy(state.network, state.secants, state.displacement)};
    for (Index e = 0; e < state.network.num_elements(); ++e) {
      if (state.secants[e] < 1.0 || !state.network.has_limit(e)) continue;
      const double limit =
          state.network.critical_stretch[e] * state.network.law(e).segment(0).limit;
      double ratio = stretch(state.network, state.displacement, e);
      if (state.network.law(e).sense() == Sense::both) ratio = std::abs(ratio);
      look.worst = std::max(look.worst, ratio / limit);
    }
    look.wrong_side = wrong_side(state);
    if (looks_.size() % 40 == 0) {
      AnalysisBody all = body_;
      for (std::size_t slot = 0; slot < all.loads.forces.size(); ++slot) {
        all.loads.forces[slot] = all.unknowns.prescribed[slot] = 0.0;
        for (std::size_t s = 0; s < all.sets.size(); ++s) {
          all.loads.forces[slot] += factors[s] * all.sets[s].loads.forces[slot];
          all.unknowns.prescribed[slot] += factors[s] * all.sets[s].unknowns.prescribed[slot];
        }
      }
      look.error = difference(state.displacement, dense_displacement(all, state.secants));
    }
    looks_.push_back(look);
  }

  static double wrong_side(const StepState& state) {
    double wrong = 0.0, largest = 0.0;
    for (Index e = 0; e < state.network.num_elements(); ++e) {
      const double extension = extension_of(state.network, state.displacement, e);
      largest = std::max(largest, std::abs(extension));
      if (state.secants[e] == 1.0 || !state.network.law(e).closes()) continue;
      const bool closed = state.secants.axial(e) > state.secants[e];
      // Bonds oblique to a crack do not close once they are broken.
      if (!closed && state.secants[e] == 0.0) continue;
      wrong = std::max(wrong, closed ? extension : -extension);
    }
    return wrong / largest;
  }

  void expect_balance() const {
    double largest = 0.0;
    for (const StagedLook& look : looks_) {
      const StepRecord& row = look.row;
      largest = std::max(largest, std::abs(row.external_work));
      EXPECT_NEAR(row.external_work, look.stored + row.dissipated_energy,
                  staged_tolerance * largest)
          << "row " << row.step;
      EXPECT_NEAR(row.strain_energy, look.stored, staged_tolerance * largest) << "row " << row.step;
      EXPECT_LT(look.error, 1e-8) << "row " << row.step;
      EXPECT_LT(look.wrong_side, 1e-10) << "row " << row.step;
      // Before a load factor that every element can carry, bonds beyond their limit may close.
      if (row.at_constant_load == 0 && row.side_change == 0) {
        EXPECT_LT(look.worst, 1.0 + 1e-8) << "row " << row.step;
      }
    }
    EXPECT_LT(result_.energy_error, staged_tolerance) << result_.reason;
  }

  AnalysisBody body_;
  std::vector<StagedLook> looks_;
  DamageResult result_;
};

TEST_P(StagedPath, ConstantLoadThenEvents) {
  go(in_stages({{0, 0.5 * first_event(0), {}}, {1, {}, {}}}), 150);
  EXPECT_GT(looks_.size(), 30u) << result_.reason;
  expect_balance();
}

TEST_P(StagedPath, UnloadsAndComesBackToTheSameEvent) {
  const double constant = 0.5 * first_event(0);
  StopRules some;
  some.broken_bonds = !GetParam().toothed ? 12 : GetParam().closing ? 1 : 2;
  go(in_stages({{0, constant, {}}, {1, {}, some}, {1, 0.0, {}}, {1, {}, {}}}), 1500);
  expect_balance();
  StepRecord stopped, again;
  for (const StagedLook& look : looks_) {
    if (look.row.stage == 2 && look.row.side_change == 0) stopped = look.row;
    const bool fails = look.row.side_change == 0;
    if (look.row.stage == 4 && fails && again.step == 0) again = look.row;
  }
  ASSERT_EQ(result_.stages.size(), 4u) << result_.reason;
  EXPECT_EQ(again.element, stopped.element);
  EXPECT_NEAR(again.load_factor, stopped.load_factor, 1e-9 * std::abs(stopped.load_factor));
  EXPECT_EQ(again.broken_bonds, stopped.broken_bonds);
  EXPECT_NEAR(again.external_work, stopped.external_work, staged_tolerance * stopped.external_work);
}

/// At a reversal of the load no element fails, and damaged bonds depend on the load only.
TEST_P(StagedPath, TurnsRoundAndComesBackToTheSameEvent) {
  const double constant = 0.2 * first_event(0);
  StopRules some;
  some.broken_bonds = !GetParam().toothed ? 12 : GetParam().closing ? 1 : 2;
  go(in_stages({{0, constant, {}}, {1, {}, some}, {1, -0.2 * first_event(1), {}}, {1, {}, {}}}),
     1500);
  expect_balance();
  StepRecord stopped, turned, again;
  Index changes = 0;
  for (const StagedLook& look : looks_) {
    if (look.row.stage == 2 && look.row.side_change == 0) stopped = look.row;
    if (look.row.stage == 3) turned = look.row;
    changes += look.row.stage == 3 && look.row.side_change == 1;
    if (look.row.stage == 4 && look.row.side_change == 0 && again.step == 0) again = look.row;
  }
  EXPECT_NEAR(turned.dissipated_energy, stopped.dissipated_energy,
              staged_tolerance * stopped.external_work);
  EXPECT_EQ(changes > 0, GetParam().closing);
  EXPECT_NEAR(again.load_factor, stopped.load_factor, 1e-9 * std::abs(stopped.load_factor));
  EXPECT_NEAR(again.external_work, stopped.external_work, staged_tolerance * stopped.external_work);
}

TEST_P(StagedPath, AnAvalancheUnderConstantLoadsBalances) {
  go(in_stages({{0, 0.5 * first_event(0), {}}, {1, 3.0 * first_event(1), {}}}), 150);
  expect_balance();
  int events_at_constant_load = 0;
  for (std::size_t k = 1; k < looks_.size(); ++k) {
    if (looks_[k].row.at_constant_load == 0) continue;
    ++events_at_constant_load;
    EXPECT_EQ(looks_[k].row.load_factor, looks_[k - 1].row.load_factor);
    EXPECT_GE(looks_[k].row.dissipated_energy, looks_[k - 1].row.dissipated_energy);
  }
  EXPECT_GT(events_at_constant_load, 3);
}

TEST_P(StagedPath, TwoStagesOfOneLoadAreOne) {
  AnalysisBody alone = body_;
  alone.sets.clear();
  Recorder expected({}, 60);
  run(alone, {}, expected);
  body_.sets = {body_.sets[1], body_.sets[1]};
  const double half = 0.5 * expected.rows[0].load_factor;
  Recorder recorder({}, 61);
  run(body_, in_stages({{0, half, {}}, {1, {}, {}}}), recorder);
  ASSERT_EQ(recorder.rows.size(), expected.rows.size() + 1);
  for (std::size_t k = 0; k < expected.rows.size(); ++k) {
    const StepRecord &row = recorder.rows[k + 1], &other = expected.rows[k];
    if (row.at_constant_load != 0 || row.load_factor + half < 0.5 * half) break;
    ASSERT_EQ(row.element, other.element) << "row " << k;
    ASSERT_NEAR(row.load_factor + half, other.load_factor, 1e-8 * other.load_factor);
    EXPECT_NEAR(row.dissipated_energy, other.dissipated_energy, 1e-8 * other.external_work + 1e-20);
  }
}

std::vector<BlockCase> staged_cases() {
  const LatticeCase hexagonal{"hexagonal", Pattern::hexagonal, Surface::none};
  const LatticeCase cubic{"cubic", Pattern::cubic, Surface::none};
  std::vector<BlockCase> result;
  for (const bool driven : {false, true}) {
    result.push_back({hexagonal, driven, false, 8});
    result.push_back({hexagonal, driven, true, 8, 0.1, false, true});
    result.push_back({hexagonal, driven, false, 8, 0.1, true});
    result.push_back({hexagonal, driven, true, 8, 0.1, true, true});
    result.push_back({cubic, driven, false, 5});
    result.push_back({cubic, driven, true, 5, 0.1, true});
    result.push_back({hexagonal, driven, false, 8, 0.1, false, false, true});
    result.push_back({hexagonal, driven, false, 8, 0.1, true, true, true});
    result.push_back({cubic, driven, false, 5, 0.1, false, true, true});
  }
  return result;
}

INSTANTIATE_TEST_SUITE_P(Blocks, StagedPath, testing::ValuesIn(staged_cases()),
                         [](const auto& block) { return to_string(block.param); });

}  // namespace
}  // namespace perilink

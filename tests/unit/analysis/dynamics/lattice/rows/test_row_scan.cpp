#include "analysis/dynamics/lattice/rows/row_scan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "analysis/dynamics/lattice/rows/row_flow.hpp"
#include "support/lattice_models.hpp"
#include "support/lattice_operator.hpp"

namespace perilink {
namespace {

using namespace testing_support;

ExplicitModel scanned_block(Problem problem, LatticeRules rules) {
  LatticeMaterial material = elastic_concrete(0.3);
  material.breakable = material.yields = true;
  material.boundary_factor = 0.7;
  material.yielding = {2.0e6, 3.0e6, 0.003, 0.0};
  material.crushing_energy = 1e5;
  if (problem != Problem::three_dimensional) {
    return plane_model(rectangle(0.05, 0.05, 0.01, 17.0), material, rules, problem);
  }
  LatticeCut cut = rectangle(0.03, 0.03, 0.01, 17.0, 1.0);
  cut.lower[2] = -0.03;
  cut.upper[2] = 0.03;
  return make_explicit_model(problem, rules, face_centred_rows(cut), material, 1.0);
}

void shake_and_evaluate(const ExplicitModel& model, ExplicitState& state, double size) {
  for (const Index slot : model.lattice.particle_slot) {
    for (int c = 0; c < model.lattice.dim; ++c) {
      state.displacement[model.lattice.at(c, slot)] = size * std::sin(12.9898 * slot + 78.2 * c);
    }
  }
  evaluate(model, state);
}

/// State of a body before it is scanned.
enum class Past { none, flowed, cracked };

void alter(const ExplicitModel& model, ExplicitState& state, Past past) {
  if (past == Past::none) return;
  for (std::size_t k = 0; k < state.flow.stretch.size(); ++k) {
    state.flow.stretch[k] = 3e-5 * std::sin(0.7 * static_cast<double>(k));
  }
  for (std::size_t k = 0; past == Past::cracked && k < state.in_tension.size(); ++k) {
    state.in_tension[k] *= 0.5 + 0.5 * std::sin(0.9 * static_cast<double>(k));
    state.in_compression[k] *= 0.8 + 0.2 * std::cos(1.3 * static_cast<double>(k));
    state.share_tension[k] = 1.0 + 0.5 * std::sin(0.3 * static_cast<double>(k));
  }
  const bool halves = past == Past::cracked && model.rules == LatticeRules::consistent;
  for (std::size_t slot = 0; halves && slot < state.root_tension.size(); ++slot) {
    state.root_tension[slot] = 0.6 + 0.4 * std::sin(1.1 * static_cast<double>(slot));
    state.root_compression[slot] = 0.8 + 0.2 * std::cos(1.7 * static_cast<double>(slot));
  }
  const auto rows = static_cast<Index>(model.lattice.rows.size());
  for (Index r = 0; r < rows; ++r) update_plastic_parts(model, state, r);
  for (Index r = 0; r < rows; ++r) add_plastic_halves(model, state, r);
  if (past == Past::flowed) return;
  for (std::uint8_t& bond_changes : state.bond_changes) bond_changes |= BondChanges::weakened;
}

/// One by one, every particle above a threshold is due; in the plane no other is.
void expect_due_particles(const ExplicitModel& model, Past past) {
  const LatticeParticles particles(model);
  ExplicitState state(model);
  alter(model, state, past);
  shake_and_evaluate(model, state, 1.2e-6);
  DueParticles due;
  int above = 0, below = 0;
  for (std::size_t r = 0; r < model.lattice.rows.size(); ++r) {
    const auto row = static_cast<Index>(r);
    scan_row(model, state, row, due);
    const std::set<Index> cracks(due.damage.begin(), due.damage.end());
    const std::set<Index> flows(due.flow.begin(), due.flow.end());
    const LatticeRow& slots = model.lattice.rows[r];
    for (Index slot = slots.first; slot < slots.first + slots.size; ++slot) {
      if (model.inverse_mass[slot] == 0.0) continue;
      const SymmetricTensor stress =
          particles.stress(state, particles.neighbourhood(state, row, slot));
      const bool cracked = principal_values(stress, model.lattice.dim).first > state.crack_at[slot];
      const bool flowed = mises_stress(stress) > state.flow.look_at[slot];
      (cracked ? above : below) += 1;
      (flowed ? above : below) += 1;
      if (model.lattice.dim == 2) {
        EXPECT_EQ(cracks.contains(slot), cracked);
        EXPECT_EQ(flows.contains(slot), flowed);
      } else {
        EXPECT_TRUE(cracks.contains(slot) || !cracked);
        EXPECT_TRUE(flows.contains(slot) || !flowed);
      }
    }
  }
  EXPECT_GT(above, 10);
  EXPECT_GT(below, 10);
}

TEST(ExplicitScan, FindsTheParticlesAboveTheirThresholds) {
  for (const auto& [problem, rules] :
       {std::pair{Problem::plane_stress, LatticeRules::consistent},
        std::pair{Problem::plane_strain, LatticeRules::consistent},
        std::pair{Problem::plane_stress, LatticeRules::least_2018},
        std::pair{Problem::three_dimensional, LatticeRules::consistent}}) {
    const ExplicitModel model = scanned_block(problem, rules);
    for (const Past past : {Past::none, Past::flowed, Past::cracked}) {
      SCOPED_TRACE(static_cast<int>(past));
      expect_due_particles(model, past);
    }
  }
}

// Meaning of the slack: no particle of the row reaches a threshold before its stretches have
// changed by this amount.
TEST(ExplicitScan, NothingIsDueBeforeTheSlackIsUsedUp) {
  for (const Problem problem : {Problem::plane_stress, Problem::three_dimensional}) {
    const ExplicitModel model = scanned_block(problem, LatticeRules::consistent);
    const LatticeParticles particles(model);
    const auto rows = static_cast<Index>(model.lattice.rows.size());
    DueParticles due;
    int promised = 0;
    for (const double first : {2e-8, 5e-8, 1e-7}) {
      ExplicitState state(model);
      shake_and_evaluate(model, state, first);
      std::vector<double> slack(rows);
      const std::vector<double> before = state.now.stretch;
      for (Index r = 0; r < rows; ++r) {
        scan_row(model, state, r, due);
        slack[r] = state.slack[r];
      }
      for (const double factor : {-3.0, 1.5, 2.0, 4.0, 8.0}) {
        shake_and_evaluate(model, state, factor * first);
        double change = 0.0;
        for (std::size_t k = 0; k < before.size(); ++k) {
          const double part = model.lattice.present[k] * std::abs(state.now.stretch[k] - before[k]);
          change = std::max(change, part);
        }
        for (Index r = 0; r < rows; ++r) {
          if (change >= slack[r]) continue;
          scan_row(model, state, r, due);
          EXPECT_TRUE(due.damage.empty() && due.flow.empty());
          ++promised;
        }
      }
    }
    EXPECT_GT(promised, 10);
  }
}

}  // namespace
}  // namespace perilink

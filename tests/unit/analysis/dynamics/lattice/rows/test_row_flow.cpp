#include "analysis/dynamics/lattice/rows/row_flow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "analysis/dynamics/lattice/lattice_flow.hpp"
#include "support/lattice_models.hpp"
#include "support/lattice_operator.hpp"

namespace perilink {
namespace {

using namespace testing_support;

ExplicitModel yielding_block(Problem problem, double crushing_energy, bool breakable = false) {
  LatticeMaterial material = elastic_concrete();
  material.breakable = breakable;
  material.yields = true;
  material.yielding = {22.98e6, 27.58e6, 0.003, 0.0};
  material.crushing_energy = crushing_energy;
  return plane_model(rectangle(0.05, 0.05, 0.01, 23.0), material, LatticeRules::consistent,
                     problem);
}

// Two ways to the same returns: loops over rows, and one particle after the other. Repeated, so
// that particles go through hardening, softening and what is left after it.
class FlowOfRows : public testing::TestWithParam<bool> {};

TEST_P(FlowOfRows, IsThatOfParticlesOneByOne) {
  const bool weakened = GetParam();
  for (const Problem problem : {Problem::plane_stress, Problem::plane_strain}) {
    for (const double energy : {2e3, std::numeric_limits<double>::infinity()}) {
      const ExplicitModel model = yielding_block(problem, energy, weakened);
      const LatticeRows& lattice = model.lattice;
      const LatticeParticles particles(model);
      const LatticeYielding yielding(model, particles);
      ExplicitState state(model);
      if (weakened) weaken(model, state);
      int flowed = 0;
      for (int step = 1; step <= 12; ++step) {
        for (const Index slot : lattice.particle_slot) {
          for (int c = 0; c < 2; ++c) {
            state.displacement[lattice.at(c, slot)] =
                3e-3 * step * lattice.spacing * std::sin(12.9898 * slot + 78.2 * c);
          }
        }
        evaluate(model, state);
        ExplicitState other = state;
        for (std::size_t r = 0; r < lattice.rows.size(); ++r) {
          const auto row = static_cast<Index>(r);
          bool any = false;
          const LatticeRow& slots = lattice.rows[r];
          for (Index slot = slots.first; slot < slots.first + slots.size; ++slot) {
            if (model.inverse_mass[slot] == 0.0) continue;
            any = yielding.flow(other, row, slot).flowed || any;
          }
          EXPECT_EQ(flow_row(model, state, row), any);
          flowed += any ? 1 : 0;
        }
        for (const Index slot : lattice.particle_slot) {
          // Both end within round-off of the surface; what has softened away flows as far as it is
          // moved.
          const double size = other.flow.equivalent[slot];
          EXPECT_NEAR(state.flow.equivalent[slot], other.flow.equivalent[slot],
                      1e-13 + 1e-11 * size);
          for (int c = 0; c < 6; ++c) {
            const Index at = lattice.at(c, slot);
            EXPECT_NEAR(state.flow.strain[at], other.flow.strain[at], 1e-13 + 1e-11 * size);
          }
          for (int j = 0; j < 6 && lattice.bond_count[slot] == 6; ++j) {
            const Index at = lattice.at(j, slot);
            EXPECT_NEAR(state.flow.stretch[at], other.flow.stretch[at], 1e-13 + 1e-11 * size);
          }
        }
        const auto rows = static_cast<Index>(lattice.rows.size());
        for (Index r = 0; r < rows; ++r) update_plastic_parts(model, state, r);
        for (Index r = 0; r < rows; ++r) add_plastic_halves(model, state, r);
      }
      EXPECT_GT(flowed, 20);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, FlowOfRows, testing::Bool(),
                         [](const auto& rows) { return rows.param ? "Weakened" : "Whole"; });

// In the sum of a particle its own halves count, plastic parts as damaged as they are in tension.
TEST(ExplicitFlowRows, SumsTakeTheParticlesOwnHalvesWithTheirWeights) {
  const ExplicitModel model =
      yielding_block(Problem::plane_stress, std::numeric_limits<double>::infinity(), true);
  const LatticeRows& lattice = model.lattice;
  const LatticeParticles particles(model);
  ExplicitState state(model);
  weaken(model, state);
  for (std::size_t k = 0; k < state.flow.stretch.size(); ++k) {
    state.flow.stretch[k] = 1e-4 * std::sin(0.7 * static_cast<double>(k));
  }
  const auto rows = static_cast<Index>(lattice.rows.size());
  for (Index r = 0; r < rows; ++r) update_plastic_parts(model, state, r);
  for (Index r = 0; r < rows; ++r) add_plastic_halves(model, state, r);
  evaluate(model, state);
  for (Index r = 0; r < rows; ++r) {
    for (Index n = 0; n < lattice.rows[r].size; ++n) {
      const Index slot = lattice.rows[r].first + n;
      if (model.inverse_mass[slot] == 0.0) continue;
      const auto neighbourhood = particles.neighbourhood(state, r, slot);
      double expected = 0.0;
      for (int j = 0; j < neighbourhood.bonds; ++j) {
        if (!neighbourhood.has(j)) continue;
        const Index at = neighbourhood.at[j];
        const double stretch = state.now.stretch[neighbourhood.now_at[j]],
                     side = neighbourhood.side(j);
        const auto weight = [&](bool tension) {
          const double share = (tension ? state.share_tension : state.share_compression)[at];
          return (side > 0.0 ? share : 2.0 - share) *
                 (tension ? state.root_tension : state.root_compression)[slot];
        };
        expected += weight(stretch >= 0.0) * stretch + weight(true) * side * state.flow.half[at];
      }
      EXPECT_NEAR(state.now.sum[neighbourhood.now], expected, 1e-17);
      EXPECT_GT(std::abs(expected), 1e-15);
    }
  }
}

// Equal stresses soften steepest against what the return takes back: a yield stress that falls
// nearly as fast as that, and one that would fall faster.
TEST(ExplicitFlowRows, EqualStressesEndOnASteeplyFallingSurface) {
  EXPECT_THROW(yielding_block(Problem::plane_stress, 230.0), std::invalid_argument);
  const ExplicitModel model = yielding_block(Problem::plane_stress, 255.0);
  const LatticeRows& lattice = model.lattice;
  const LatticeParticles particles(model);
  ExplicitState state(model);
  for (const Index slot : lattice.particle_slot) {
    for (int c = 0; c < 2; ++c) {
      const Index at = lattice.at(c, slot);
      state.displacement[at] = -5e-3 * lattice.positions[at];
    }
  }
  evaluate(model, state);
  const auto rows = static_cast<Index>(lattice.rows.size());
  for (Index r = 0; r < rows; ++r) EXPECT_TRUE(flow_row(model, state, r));
  for (Index r = 0; r < rows; ++r) update_plastic_parts(model, state, r);
  for (Index r = 0; r < rows; ++r) add_plastic_halves(model, state, r);
  evaluate(model, state);
  int interior = 0;
  for (Index r = 0; r < rows; ++r) {
    const LatticeRow& row = lattice.rows[r];
    for (Index slot = row.first; slot < row.first + row.size; ++slot) {
      if (lattice.bond_count[slot] < 6) continue;
      ++interior;
      const double mises =
          mises_stress(particles.stress(state, particles.neighbourhood(state, r, slot)));
      EXPECT_NEAR(mises, state.flow.yield[slot], 1e-9 * model.material.yielding.yield);
    }
  }
  EXPECT_GT(interior, 20);
}

}  // namespace
}  // namespace perilink

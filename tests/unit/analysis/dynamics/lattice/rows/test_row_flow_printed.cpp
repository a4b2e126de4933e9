#include "analysis/dynamics/lattice/rows/row_flow_printed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/yielding_blocks.hpp"

namespace perilink {
namespace {

using namespace testing_support;
using Family = LatticeParticles::Family;
using Halves = LatticeParticles::Halves;

void flow_everywhere(const ExplicitModel& model, const LatticeParticles& particles,
                     ExplicitState& state) {
  const LatticeRows& lattice = model.lattice;
  for (Index r = 0; r < static_cast<Index>(lattice.rows.size()); ++r) {
    std::vector<Index> due;
    for (const Index slot : lattice.particle_slot) {
      const Index i = slot - lattice.rows[r].first;
      if (0 <= i && i < lattice.rows[r].size) due.push_back(slot);
    }
    flow_row_as_printed(model, particles, state, r, due);
  }
}

TEST(PrintedFlow, StepsAlongTheDeviatorOfTheBondForces) {
  const ExplicitModel model = block(Problem::plane_stress, LatticeRules::least_2018);
  const LatticeRows& lattice = model.lattice;
  const LatticeParticles particles(model);
  ExplicitState state(model);
  const double yield = 22.98e6, e = 25e9, excess = 1.01;
  const double strain = -excess * yield / e;  // uniaxial stress along y
  strain_body(model, state, -0.2 * strain, strain, 0.0);
  flow_everywhere(model, particles, state);
  int deep = 0;  // whole neighbours: the bond forces are those of the uniform strain
  for_each_particle(lattice, [&](Index row, Index slot) {
    const Family family = particles.family(state, row, slot);
    if (particles.is_near_face(slot)) return;
    ++deep;
    double square = 0.0, sum = 0.0;
    for (int j = 0; j < family.bonds; ++j) {
      const double flow = state.flow.stretch[lattice.at(j, slot)];
      sum += flow;
      square += flow * flow;
    }
    // Eqs. 28 and 29: a step of this length without a mean; stretches are linear up to squares.
    EXPECT_NEAR(std::sqrt(square), yield / e * (excess * excess - 1.0), 2e-2 * yield / e * 0.02);
    EXPECT_NEAR(sum, 0.0, 1e-15);
  });
  EXPECT_GT(deep, 10);
}

/// What the printed rules say, one particle at a time.
struct Printed {
  Halves step{};
  double yield = 0.0, visit = 0.0;
};

/// The smaller one of the two force states where they agree in sign, else their mean (Eq. 5).
Halves bond_forces(const ExplicitModel& model, const ExplicitState& state, const Family& family,
                   const Halves& own) {
  Halves bond{};
  for (int j = 0; j < family.bonds; ++j) {
    if (!family.has(j)) continue;
    const double half =
        state.now.stretch[family.now_at[j]] - family.side(j) * state.flow.half[family.at[j]];
    const double factor = LatticeParticles::factor(state, family, j);
    const double other =
        model.moduli.own * factor * half + model.moduli.sum * state.now.sum[family.now_partner[j]];
    const double smaller = std::abs(own[j]) < std::abs(other) ? own[j] : other;
    bond[j] = own[j] * other > 0.0 ? smaller : 0.5 * (own[j] + other);
  }
  return bond;
}

Printed printed_step(const ExplicitModel& model, const LatticeParticles& particles,
                     const ExplicitState& state, Index row, Index slot) {
  const YieldCurve& curve = model.material.yielding;
  const Family family = particles.family(state, row, slot);
  const double strain = printed_plastic_strain(model, particles, state, row, slot);
  const double before = state.flow.yield[slot];
  const bool beyond = strain >= curve.ultimate_strain;
  Printed printed;
  const double slope = (curve.ultimate - curve.yield) / curve.ultimate_strain;
  printed.yield = beyond ? 0.99 * before : std::max(before, curve.yield + slope * strain);
  printed.visit = beyond ? -1.0 : printed.yield;
  const Halves own = particles.forces(state, family);
  const double mises = mises_stress(particles.stress(state, family, own));
  if (mises <= before) return printed;
  const Halves force = bond_forces(model, state, family, own);
  double sum = 0.0, square = 0.0;
  int count = 0;
  for (int j = 0; j < family.bonds; ++j) {
    sum += force[j];
    count += family.has(j) ? 1 : 0;
  }
  for (int j = 0; j < family.bonds; ++j) {
    if (family.has(j)) printed.step[j] = force[j] - sum / count;
    square += printed.step[j] * printed.step[j];
  }
  const double ratio = mises / before;
  const double amount =
      std::min(curve.yield / model.material.youngs_modulus * (ratio * ratio - 1.0), 0.01);
  for (double& entry : printed.step) entry *= square > 0.0 ? amount / std::sqrt(square) : 0.0;
  return printed;
}

// Cracked particles and faces included, from hardening into softening. The loops may fuse products
// and sums: differences of round-off only.
TEST(PrintedFlow, IsThatOfOneParticleAtATime) {
  for (const Problem problem : {Problem::plane_stress, Problem::plane_strain}) {
    LatticeMaterial material = yielding_concrete();
    material.breakable = true;
    const ExplicitModel model =
        plane_model(rectangle(0.05, 0.05, 0.01, 23.0), material, LatticeRules::least_2018, problem);
    const LatticeRows& lattice = model.lattice;
    const LatticeParticles particles(model);
    const LatticeChanges changes(model);
    ExplicitState state(model);
    int flowed = 0, softened = 0;
    for (int step = 1; step <= 60; ++step) {
      strain_body(model, state, 1.2e-3 * step / 10.0, -4e-3 * step / 10.0, 2e-4 * step);
      for (const Index slot : lattice.particle_slot) {
        state.displacement[slot] += 1e-6 * std::sin(12.9898 * slot + step);
      }
      evaluate(model, state);
      ExplicitState rows = state;
      flow_everywhere(model, particles, rows);
      for_each_particle(lattice, [&](Index row, Index slot) {
        const Printed printed = printed_step(model, particles, state, row, slot);
        EXPECT_NEAR(rows.flow.yield[slot], printed.yield, 1e-12 * printed.yield);
        EXPECT_NEAR(rows.flow.visit[slot], printed.visit, 1e-12 * std::abs(printed.visit));
        softened += printed.visit < 0.0 ? 1 : 0;
        for (int j = 0; j < 6; ++j) {
          const Index at = lattice.at(j, slot);
          const double change = rows.flow.stretch[at] - state.flow.stretch[at];
          flowed += change != 0.0 ? 1 : 0;
          EXPECT_NEAR(change, printed.step[j], 1e-14);  // round-off; stretches are up to 0.02
        }
      });
      change(model, changes, state);  // damage and flow of this step
    }
    EXPECT_GT(flowed, 1000);
    EXPECT_GT(softened, 100);
    EXPECT_TRUE(std::any_of(state.damage.begin(), state.damage.end(),
                            [](double damage) { return damage > 0.0; }));
  }
}

TEST(PrintedFlow, LeavesParticlesThatAreNotDueAlone) {
  const ExplicitModel model = block(Problem::plane_stress, LatticeRules::least_2018);
  const LatticeParticles particles(model);
  ExplicitState state(model);
  strain_body(model, state, 4e-4, -2e-3, 0.0);
  flow_everywhere(model, particles, state);  // some plastic strain, which hardens the next time
  const Index row = static_cast<Index>(model.lattice.rows.size()) / 2;
  const Index slot = model.lattice.rows[row].first + model.lattice.rows[row].size / 2;
  const ExplicitState before = state;
  EXPECT_TRUE(flow_row_as_printed(model, particles, state, row, {slot}));
  for (const Index other : model.lattice.particle_slot) {
    EXPECT_EQ(state.flow.yield[other] != before.flow.yield[other], other == slot);
    EXPECT_EQ(state.flow.visit[other] != before.flow.visit[other], other == slot);
    for (int j = 0; j < 6; ++j) {
      const Index at = model.lattice.at(j, other);
      EXPECT_EQ(state.flow.stretch[at] != before.flow.stretch[at], other == slot) << j;
    }
  }
}

}  // namespace
}  // namespace perilink

#include "analysis/dynamics/lattice/lattice_flow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/lattice_models.hpp"
#include "support/lattice_operator.hpp"
#include "support/yielding_blocks.hpp"

namespace perilink {
namespace {

using namespace testing_support;

double total(const ExplicitState& state, double RowSums::*part) {
  double sum = 0.0;
  for (const RowSums& row : state.sums) sum += row.*part;
  return sum;
}

TEST(LatticeYielding, ReturnsInteriorParticlesToTheYieldSurface) {
  for (const Problem problem :
       {Problem::plane_stress, Problem::plane_strain, Problem::three_dimensional}) {
    const ExplicitModel model = block(problem);
    const LatticeChanges changes(model);
    const LatticeParticles particles(model);
    ExplicitState state(model);
    // Twice: the second time from a plastic strain in another direction.
    for (const double sign : {-1.0, 1.0}) {
      strain_body(model, state, sign * 4e-4, sign * -2e-3, 3e-4);
      change(model, changes, state);
      int interior = 0;
      for_each_particle(model.lattice, [&](Index row, Index slot) {
        const LatticeParticles::Neighbourhood neighbourhood =
            particles.neighbourhood(state, row, slot);
        if (!particles.is_whole(neighbourhood)) return;
        ++interior;
        const double yield = yield_stress(model.material.yielding, state.flow.equivalent[slot]);
        EXPECT_GT(yield, 22.98e6);
        EXPECT_NEAR(state.flow.yield[slot], yield, 1e-15 * yield);
        // Bonds stretch by their true lengths, squares of 2e-3, which plastic strains do not have;
        // a whole neighbourhood's fit of them is the strain that the return saw.
        EXPECT_NEAR(mises_stress(particles.stress(state, neighbourhood)), yield, 1e-9 * yield);
      });
      EXPECT_GT(interior, 20);
    }
  }
}

TEST(LatticeYielding, StoredEnergyThatIsLostIsPlastic) {
  for (const Problem problem :
       {Problem::plane_stress, Problem::plane_strain, Problem::three_dimensional}) {
    const ExplicitModel model = block(problem);
    const LatticeChanges changes(model);
    ExplicitState state(model);
    strain_body(model, state, 4e-4, -2e-3, 3e-4);
    const double before = stored_energy(state);
    change(model, changes, state);
    const double plastic = total(state, &RowSums::plastic);
    EXPECT_GT(plastic, 0.01 * before);
    EXPECT_NEAR(plastic, before - stored_energy(state), 1e-12 * before);
    const double updated = stored_energy(state);
    evaluate(model, state);
    EXPECT_NEAR(stored_energy(state), updated, 1e-12 * before);
  }
}

// Also in a breakable body: no energy counts as fractured.
TEST(LatticeYielding, WorkOfTheForcesAgainstTheFlowIsTheEnergyLost) {
  LatticeMaterial material = yielding_concrete();
  material.breakable = true;
  const ExplicitModel model = plane_model(rectangle(0.05, 0.05, 0.01, 23.0), material);
  const LatticeChanges changes(model);
  ExplicitState state(model);
  strain_body(model, state, -1.5e-3, -2.5e-3, 1e-4);  // no tension: no cracks
  const double before = stored_energy(state);
  change(model, changes, state);
  for (const double damage : state.damage) EXPECT_EQ(damage, 0.0);
  const double plastic = total(state, &RowSums::plastic);
  EXPECT_GT(plastic, 0.01 * before);
  EXPECT_NEAR(plastic, before - stored_energy(state), 1e-12 * before);
  EXPECT_NEAR(total(state, &RowSums::fractured), 0.0, 1e-12 * before);
}

TEST(LatticeYielding, ForcesStayTheDerivativeOfTheStoredEnergy) {
  for (const Problem problem :
       {Problem::plane_stress, Problem::plane_strain, Problem::three_dimensional}) {
    const ExplicitModel model = block(problem);
    const LatticeRows& lattice = model.lattice;
    const LatticeChanges changes(model);
    ExplicitState state(model);
    for (const Index slot : lattice.particle_slot) {
      for (int c = 0; c < lattice.dim; ++c) {
        state.displacement[lattice.at(c, slot)] =
            0.01 * lattice.spacing * std::sin(12.9898 * slot + 78.2 * c);
      }
    }
    evaluate(model, state);
    change(model, changes, state);  // every particle flows by its own
    EXPECT_GT(total(state, &RowSums::plastic), 0.0);
    evaluate(model, state);
    const std::vector<double> force = resultants(model, state);
    double largest = 0.0;
    for (const double f : force) largest = std::max(largest, std::abs(f));
    const double h = 1e-6 * lattice.spacing;
    for (std::size_t n = 0; n < lattice.particle_slot.size(); n += 5) {
      const Index at = lattice.at(static_cast<Index>(n) % lattice.dim, lattice.particle_slot[n]);
      const double middle = state.displacement[at];
      double energy[2];
      for (const int side : {0, 1}) {
        state.displacement[at] = middle + (2 * side - 1) * h;
        evaluate(model, state);
        energy[side] = stored_energy(state);
      }
      state.displacement[at] = middle;
      // Central differences: h^2 of curvature and round-off of the energy over h.
      EXPECT_NEAR(force[at], -(energy[1] - energy[0]) / (2.0 * h), 1e-6 * largest);
    }
  }
}

TEST(LatticeYielding, RulesOf2018StepAlongTheDeviatorOfTheBondForces) {
  const ExplicitModel model = block(Problem::plane_stress, LatticeRules::least_2018);
  const LatticeRows& lattice = model.lattice;
  const LatticeParticles particles(model);
  ExplicitState state(model);
  const double yield = 22.98e6, e = 25e9, excess = 1.01;
  const double strain = -excess * yield / e;  // uniaxial stress along y
  strain_body(model, state, -0.2 * strain, strain, 0.0);
  const LatticeYielding yielding(model, particles);
  for_each_particle(lattice, [&](Index row, Index slot) { yielding.flow(state, row, slot); });
  int deep = 0;  // whole neighbours: the bond forces are those of the uniform strain
  for_each_particle(lattice, [&](Index row, Index slot) {
    const LatticeParticles::Neighbourhood neighbourhood = particles.neighbourhood(state, row, slot);
    if (particles.is_near_face(slot)) return;
    ++deep;
    double square = 0.0, sum = 0.0;
    for (int j = 0; j < neighbourhood.bonds; ++j) {
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

TEST(LatticeYielding, RulesOf2018SoftenByAStepAndThoseOf2017Crush) {
  for (const LatticeRules rules : {LatticeRules::least_2018, LatticeRules::mean_2017}) {
    const ExplicitModel model = block(Problem::plane_stress, rules);
    const LatticeChanges changes(model);
    ExplicitState state(model);
    double lowest = 1e300;
    for (int step = 1; step <= 400; ++step) {
      const double strain = -0.004 * step / 400.0;
      strain_body(model, state, -0.2 * strain, strain, 0.0);
      change(model, changes, state);
    }
    int crushed = 0;
    for_each_particle(model.lattice, [&](Index /*row*/, Index slot) {
      lowest = std::min(lowest, state.flow.yield[slot]);
      crushed += state.flow.crushed[slot];
    });
    if (rules == LatticeRules::least_2018) {
      EXPECT_LT(lowest, 22.98e6) << "beyond 0.003 the yield stress falls";
      EXPECT_EQ(crushed, 0);
    } else {
      EXPECT_GE(lowest, 22.98e6);
      EXPECT_GT(crushed, 20);
    }
  }
}

}  // namespace
}  // namespace perilink

#include "analysis/dynamics/lattice/body/lattice_loads.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "analysis/dynamics/lattice/body/lattice_statics.hpp"
#include "analysis/dynamics/lattice/lattice_analysis.hpp"
#include "analysis/quasistatic/elastic_analysis.hpp"
#include "support/lattice_models.hpp"

namespace perilink {
namespace {

using namespace testing_support;

/// A block of particles, each pushed by its share of a force.
ExplicitModel pushed_block(double force, bool held, double external_damping) {
  LatticeMaterial material = elastic_concrete();
  material.external_damping = external_damping;
  material.fundamental_period = 1e-4;
  ExplicitModel model = plane_model(rectangle(0.05, 0.05, 0.01, 0.0), material);
  const LatticeRows& lattice = model.lattice;
  if (held) {
    std::vector<PrescribedMotion> motions;
    for (const Index slot : lattice.particle_slot) {
      if (lattice.positions[lattice.at(1, slot)] > -0.035) continue;
      motions.push_back({slot, 0, 0.0});
      motions.push_back({slot, 1, 0.0});
    }
    prescribe(model, motions);
  }
  double mass = 0.0;
  for (const Index slot : lattice.particle_slot) mass += model.mass[slot];
  std::vector<AppliedForce> forces;
  for (const Index slot : lattice.particle_slot) {
    forces.push_back({slot, 1, force * model.mass[slot] / mass});
  }
  apply_forces(model, forces);
  return model;
}

ExplicitOptions slowly(double duration, double ramp) {
  ExplicitOptions options;
  options.duration = duration;
  options.ramp = ramp;
  options.driven = false;
  options.reference = 100.0;
  return options;
}

TEST(ExplicitLoads, AccelerateAFreeBody) {
  const ExplicitModel model = pushed_block(100.0, false, 0.0);
  EXPECT_EQ(model.load_component, 1);
  double mass = 0.0;
  for (const Index slot : model.lattice.particle_slot) mass += model.mass[slot];
  ExplicitState state(model);
  ExplicitOptions options = slowly(1e-4, 1e-4);
  ExplicitObserver nobody;
  const ExplicitResult result = run_explicit_analysis(model, state, options, nobody);
  // Forces in proportion to the masses move the body as a whole, by their impulse.
  double impulse = 0.0;
  for (Index step = 0; step <= result.steps; ++step) {
    impulse += 100.0 * result.time_step * ramped_load_factor(step * result.time_step, 1e-4);
  }
  for (const Index slot : model.lattice.particle_slot) {
    EXPECT_NEAR(state.velocity[model.lattice.at(1, slot)], impulse / mass, 1e-9 * impulse / mass);
  }
  EXPECT_GT(result.last.energy.external_work, 0.0);
  EXPECT_NEAR(result.last.load, 100.0, 0.1) << "of the step before";
  EXPECT_LT(result.largest_surplus, 1e-9);
}

TEST(ExplicitLoads, ComeToTheElasticAnswer) {
  const ExplicitModel model = pushed_block(100.0, true, 0.3);
  ExplicitState state(model);
  ExplicitObserver nobody;
  const ExplicitResult moving = run_explicit_analysis(model, state, slowly(4e-3, 2e-3), nobody);
  const LatticeNetwork body = lattice_network(model);
  ASSERT_EQ(body.left_out, 0);
  std::vector<std::uint8_t> held;
  Loads loads;
  for (const Index slot : body.slots) {
    const bool low = model.lattice.positions[model.lattice.at(1, slot)] <= -0.035;
    held.insert(held.end(), {low, low});
    loads.forces.insert(loads.forces.end(), {0.0, 0.0});
  }
  for (const auto& row : model.applied) {
    for (const AppliedForce& force : row) {
      const auto at = std::lower_bound(body.slots.begin(), body.slots.end(), force.slot);
      loads.forces[2 * (at - body.slots.begin()) + force.component] = force.value;
    }
  }
  const Unknowns unknowns = number_unknowns(2, held, std::vector<double>(held.size(), 0.0));
  const ElasticResult still = run_elastic_analysis({body.network, unknowns, loads, {}});
  double largest = 0.0, apart = 0.0;
  for (std::size_t k = 0; k < still.displacement.size(); ++k) {
    const Index slot = body.slots[k / 2];
    const double u = state.displacement[model.lattice.at(static_cast<Index>(k % 2), slot)];
    largest = std::max(largest, std::abs(still.displacement[k]));
    apart = std::max(apart, std::abs(u - still.displacement[k]));
  }
  EXPECT_LT(apart, 1e-4 * largest);  // strains of 1e-6, and what still moves
  // Twice the energy over the load; supports carry what is not on themselves.
  EXPECT_NEAR(moving.last.displacement, 2.0 * still.strain_energy / 100.0,
              1e-3 * moving.last.displacement);
  EXPECT_NEAR(moving.last.support_reaction, -100.0, 0.1);
  EXPECT_LT(moving.largest_surplus, 1e-5);  // true lengths, at strains of 1e-6
}

}  // namespace
}  // namespace perilink

#include "analysis/dynamics/lattice/rows/row_kernels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "analysis/dynamics/lattice/rows/row_flow.hpp"
#include "support/lattice_models.hpp"
#include "support/lattice_operator.hpp"

namespace perilink {
namespace {

using namespace testing_support;

constexpr double finite_strain = 0.05;  // large enough that geometry matters

/// Displacements without any pattern.
void shake(const ExplicitModel& model, ExplicitState& state, double size) {
  for (const Index slot : model.lattice.particle_slot) {
    for (int c = 0; c < model.lattice.dim; ++c) {
      state.displacement[model.lattice.at(c, slot)] = size * std::sin(12.9898 * slot + 78.2 * c);
    }
  }
}

ExplicitModel kernel_block(Problem problem, LatticeRules rules, bool breakable = false) {
  LatticeMaterial material = elastic_concrete();
  material.breakable = breakable;
  if (problem != Problem::three_dimensional) {
    return plane_model(rectangle(0.03, 0.03, 0.01, 17.0), material, rules, problem);
  }
  LatticeCut cut = rectangle(0.02, 0.02, 0.01, 17.0, 1.0);
  cut.lower[2] = -0.02;
  cut.upper[2] = 0.02;
  return make_explicit_model(problem, rules, face_centred_rows(cut), material, 1.0);
}

TEST(ExplicitKernels, ForcesAreTheDerivativeOfTheStoredEnergy) {
  for (const Problem problem :
       {Problem::plane_stress, Problem::plane_strain, Problem::three_dimensional}) {
    const ExplicitModel model = kernel_block(problem, LatticeRules::consistent, true);
    const LatticeRows& lattice = model.lattice;
    ExplicitState state(model);
    weaken(model, state);
    shake(model, state, finite_strain * lattice.spacing);
    evaluate(model, state);
    const std::vector<double> force = resultants(model, state);
    double largest = 0.0;
    for (const double f : force) largest = std::max(largest, std::abs(f));
    const double h = 1e-6 * lattice.spacing;
    for (std::size_t n = 0; n < lattice.particle_slot.size(); n += 3) {
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

TEST(ExplicitKernels, RigidMotionCostsNothing) {
  for (const Problem problem : {Problem::plane_stress, Problem::three_dimensional}) {
    const ExplicitModel model = kernel_block(problem, LatticeRules::consistent);
    const LatticeRows& lattice = model.lattice;
    ExplicitState state(model);
    const double angle = 1.1;
    for (const Index slot : lattice.particle_slot) {
      const double x = lattice.positions[slot], y = lattice.positions[lattice.at(1, slot)];
      state.displacement[slot] = std::cos(angle) * x - std::sin(angle) * y - x + 0.3;
      state.displacement[lattice.at(1, slot)] = std::sin(angle) * x + std::cos(angle) * y - y;
    }
    evaluate(model, state);
    for (const Index slot : lattice.particle_slot) {
      for (int k = 0; k < lattice.own_bonds(); ++k) {
        if (lattice.present[lattice.at(k, slot)] == 0.0) continue;
        // Round-off of displacements of 0.3 over a spacing of 0.01.
        EXPECT_NEAR(state.now.effective[lattice.at(k, slot)], 0.0, 1e-13);
      }
    }
  }
}

TEST(ExplicitKernels, RulesAgreeInAUniformStrainFarFromEdges) {
  std::vector<double> reference;
  for (const LatticeRules rules :
       {LatticeRules::consistent, LatticeRules::mean_2017, LatticeRules::least_2018}) {
    const ExplicitModel model = kernel_block(Problem::plane_stress, rules);
    const LatticeRows& lattice = model.lattice;
    ExplicitState state(model);
    for (const Index slot : lattice.particle_slot) {
      const double x = lattice.positions[slot], y = lattice.positions[lattice.at(1, slot)];
      state.displacement[slot] = 1e-6 * x + 4e-7 * y;
      state.displacement[lattice.at(1, slot)] = -3e-7 * y;
    }
    evaluate(model, state);
    Index middle = 0;
    for (const Index slot : lattice.particle_slot) {
      if (std::hypot(lattice.positions[slot], lattice.positions[lattice.at(1, slot)]) < 1e-9) {
        middle = slot;
      }
    }
    for (int part = 0; part < 6; ++part) {
      const double force = state.now.force[lattice.at(part, middle)];
      if (rules == LatticeRules::consistent) {
        reference.push_back(force);
      } else {
        EXPECT_NEAR(force, reference[part], 1e-9 * std::abs(reference[0]));
      }
    }
  }
}

TEST(ExplicitKernels, SmallerForceStateActsWhereTheyAgreeInSign) {
  const ExplicitModel least = kernel_block(Problem::plane_stress, LatticeRules::least_2018);
  const ExplicitModel mean = kernel_block(Problem::plane_stress, LatticeRules::mean_2017);
  ExplicitState a(least), b(mean);
  shake(least, a, 1e-6);
  shake(mean, b, 1e-6);
  evaluate(least, a);
  evaluate(mean, b);
  const LatticeRows& lattice = least.lattice;
  for (std::size_t r = 0; r < lattice.rows.size(); ++r) {
    for (int k = 0; k < 3; ++k) {
      for (Index i = 0; i < lattice.rows[r].size; ++i) {
        const Index slot = lattice.rows[r].first + i, at = lattice.at(k, slot);
        if (lattice.present[at] == 0.0) continue;
        const Index partner = slot + lattice.shift_out[r * 3 + k];
        const double mine =
            least.moduli.own * a.now.effective[at] + least.moduli.sum * a.now.sum[slot];
        const double other =
            least.moduli.own * a.now.effective[at] + least.moduli.sum * a.now.sum[partner];
        double expected = 0.5 * (mine + other);
        const double length = std::hypot(b.now.force[lattice.at(2 * k, slot)],
                                         b.now.force[lattice.at(2 * k + 1, slot)]);
        EXPECT_NEAR(length, std::abs(expected), 1e-9 * std::abs(mine) + 1e-9 * std::abs(other));
        if (mine * other > 0.0) expected = std::abs(mine) < std::abs(other) ? mine : other;
        EXPECT_NEAR(std::hypot(a.now.force[lattice.at(2 * k, slot)],
                               a.now.force[lattice.at(2 * k + 1, slot)]),
                    std::abs(expected), 1e-9 * std::abs(mine) + 1e-9 * std::abs(other));
      }
    }
  }
}

/// Plastic stretches of a body that has flowed but not cracked.
void flow_at_random(const ExplicitModel& model, ExplicitState& state) {
  for (std::size_t k = 0; k < state.flow.stretch.size(); ++k) {
    state.flow.stretch[k] = 1e-4 * std::sin(0.7 * static_cast<double>(k));
  }
  const auto rows = static_cast<Index>(model.lattice.rows.size());
  for (Index r = 0; r < rows; ++r) update_plastic_parts(model, state, r);
  for (Index r = 0; r < rows; ++r) add_plastic_halves(model, state, r);
}

struct StepResult {
  std::vector<double> force;
  double stored = 0.0, damped = 0.0;
};

/// Two steps: the second counts the drag of the first.
StepResult two_steps(const ExplicitModel& model, ExplicitState& state, double dt) {
  const auto rows = static_cast<Index>(model.lattice.rows.size());
  StepResult result;
  for (int step = 0; step < 2; ++step) {
    for (Index r = 0; r < rows; ++r) measure_bonds(model, state, r, dt);
    for (Index r = 0; r < rows; ++r) sum_stretches(model, state, r);
    for (Index r = 0; r < rows; ++r) bond_forces(model, state, r);
  }
  for (Index r = 0; r < rows; ++r) {
    result.stored += half_step_energy(model, state, r, dt);
    result.damped += state.sums[r].internal_damping;
  }
  result.force = resultants(model, state);
  return result;
}

/// Uncracked rows do not read factors; with factors of one, the result is equal.
TEST(ExplicitKernels, FactorsOfOneChangeNothing) {
  for (const LatticeRules rules :
       {LatticeRules::consistent, LatticeRules::mean_2017, LatticeRules::least_2018}) {
    for (const bool flowed : {false, true}) {
      LatticeMaterial material = elastic_concrete();
      material.breakable = true;
      material.yields = true;
      material.yielding = {22.98e6, 27.58e6, 0.003, 0.0};
      material.crushing_energy = 1e5;
      material.internal_damping = 0.2;
      const ExplicitModel model =
          plane_model(rectangle(0.05, 0.05, 0.01, 17.0), material, rules, Problem::plane_stress);
      StepResult result[2];
      for (const bool factors : {false, true}) {
        ExplicitState state(model);
        if (flowed) flow_at_random(model, state);
        shake(model, state, 1e-4 * model.lattice.spacing);
        state.velocity = state.displacement;
        for (double& v : state.velocity) v *= 1e4;
        for (std::uint8_t& bond_changes : state.bond_changes) {
          if (factors) bond_changes |= BondChanges::altered | BondChanges::weakened;
        }
        result[factors ? 1 : 0] = two_steps(model, state, 1e-7);
      }
      // Round-off of the same sums.
      EXPECT_NEAR(result[0].stored, result[1].stored, 1e-12 * std::abs(result[0].stored));
      EXPECT_NEAR(result[0].damped, result[1].damped, 1e-12 * result[0].damped);
      EXPECT_GT(result[0].damped, 0.0);
      double largest = 0.0;
      for (const double f : result[0].force) largest = std::max(largest, std::abs(f));
      ASSERT_GT(largest, 0.0);
      for (std::size_t k = 0; k < result[0].force.size(); ++k) {
        ASSERT_NEAR(result[0].force[k], result[1].force[k], 1e-12 * largest);
      }
    }
  }
}

/// Bonds that are weaker and whose halves have flowed differently: each half has its own force.
TEST(ExplicitKernels, HalvesThatFlowedWeighWithTheFactorOfTheirBond) {
  LatticeMaterial material = elastic_concrete();
  material.breakable = material.yields = true;
  material.yielding = {22.98e6, 27.58e6, 0.003, 0.0};
  const ExplicitModel model = plane_model(rectangle(0.05, 0.05, 0.01, 17.0), material,
                                          LatticeRules::least_2018, Problem::plane_stress);
  const LatticeRows& lattice = model.lattice;
  ExplicitState state(model);
  weaken(model, state);
  flow_at_random(model, state);
  shake(model, state, 1e-4 * lattice.spacing);
  evaluate(model, state);
  int weaker = 0;
  for (std::size_t r = 0; r < lattice.rows.size(); ++r) {
    for (Index n = 0; n < 3 * lattice.rows[r].size; ++n) {
      const int k = n % 3;
      const Index slot = lattice.rows[r].first + n / 3, at = lattice.at(k, slot);
      if (lattice.present[at] == 0.0) continue;
      const Index partner = slot + lattice.shift_out[3 * r + k];
      const double stretch = state.now.stretch[at], half = state.flow.half[at];
      const double factor = stretch >= 0.0 ? state.in_tension[at] : state.in_compression[at];
      const double own = model.moduli.own * factor, shared = model.moduli.sum;
      const double mine = own * (stretch + half) + shared * state.now.sum[slot];
      const double other = own * (stretch - half) + shared * state.now.sum[partner];
      const double smaller = std::abs(mine) < std::abs(other) ? mine : other;
      const double expected = mine * other > 0.0 ? smaller : 0.5 * (mine + other);
      EXPECT_NEAR(std::hypot(state.now.force[lattice.at(2 * k, slot)],
                             state.now.force[lattice.at(2 * k + 1, slot)]),
                  std::abs(expected), 1e-9 * (std::abs(mine) + std::abs(other)));
      weaker += factor < 0.9 && std::abs(half) > 1e-6 ? 1 : 0;
    }
  }
  EXPECT_GT(weaker, 50);
}

TEST(ExplicitKernels, PrescribedMotionsAreMetExactly) {
  ExplicitModel model = plane_model(rectangle(0.05, 0.05, 0.01, 0.0), elastic_concrete());
  clamped_ends(model, 0.005, 1e-5);
  ExplicitState state(model);
  const auto rows = static_cast<Index>(model.lattice.rows.size());
  evaluate(model, state);
  for (Index r = 0; r < rows; ++r) advance(model, state, r, 1e-7, 0.0, 0.25);
  for (const auto& row : model.prescribed) {
    for (const PrescribedMotion& motion : row) {
      const double u = state.displacement[model.lattice.at(motion.component, motion.slot)];
      EXPECT_NEAR(u, 0.25 * motion.amplitude, 1e-20);
    }
  }
}

}  // namespace
}  // namespace perilink

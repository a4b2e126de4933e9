#include "analysis/dynamics/lattice/body/lattice_particles.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/lattice_models.hpp"
#include "support/lattice_operator.hpp"

namespace perilink {
namespace {

using namespace testing_support;

ExplicitModel small_block(Problem problem) {
  if (problem != Problem::three_dimensional) {
    return plane_model(rectangle(0.05, 0.05, 0.01, 23.0), elastic_concrete(),
                       LatticeRules::consistent, problem);
  }
  LatticeCut cut = rectangle(0.03, 0.03, 0.01, 23.0, 1.0);
  cut.lower[2] = -0.03;
  cut.upper[2] = 0.03;
  return make_explicit_model(problem, LatticeRules::consistent, face_centred_rows(cut),
                             elastic_concrete(), 1.0);
}

Index row_of(const LatticeRows& lattice, Index slot) {
  Index row = 0;
  while (slot >= lattice.rows[row].first + lattice.rows[row].size) ++row;
  return row;
}

TEST(LatticeParticles, StressOfInteriorParticlesIsHookesAndTheFitTheStrain) {
  for (const Problem problem :
       {Problem::plane_stress, Problem::plane_strain, Problem::three_dimensional}) {
    const ExplicitModel model = small_block(problem);
    const LatticeRows& lattice = model.lattice;
    const LatticeParticles particles(model);
    ExplicitState state(model);
    SymmetricTensor strain{2e-6, -7e-7, 0.0, 5e-7, 0.0, 0.0};
    if (lattice.dim == 3) strain = {2e-6, -7e-7, 4e-7, 5e-7, -3e-7, 6e-7};
    constexpr int entry[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    for (const Index slot : lattice.particle_slot) {
      for (int a = 0; a < lattice.dim; ++a) {
        for (int b = 0; b < lattice.dim; ++b) {
          state.displacement[lattice.at(a, slot)] +=
              strain[entry[a][b]] * lattice.positions[lattice.at(b, slot)];
        }
      }
    }
    evaluate(model, state);
    const HookeConstants hooke = hooke_constants(problem, 25e9, 0.2);
    const double trace = strain[0] + strain[1] + strain[2];
    int interior = 0;
    for (const Index slot : lattice.particle_slot) {
      const LatticeParticles::Neighbourhood neighbourhood =
          particles.neighbourhood(state, row_of(lattice, slot), slot);
      EXPECT_EQ(particles.is_whole(neighbourhood),
                lattice.bond_count[slot] == 2 * lattice.own_bonds());
      if (!particles.is_whole(neighbourhood)) continue;
      ++interior;
      const SymmetricTensor fit =
          particles.fit(particles.elastic(state, neighbourhood), neighbourhood);
      const SymmetricTensor stress = particles.stress(state, neighbourhood);
      const LatticeParticles::Halves stretch = particles.project(strain, neighbourhood);
      for (int j = 0; j < neighbourhood.bonds; ++j) {
        EXPECT_NEAR(stretch[j], state.now.effective[neighbourhood.at[j]],
                    1e-11);  // squares of the strain
      }
      for (int c = 0; c < 6; ++c) {
        const bool plane = lattice.dim == 2 && (c == 2 || c > 3);
        if (plane) continue;
        EXPECT_NEAR(fit[c], strain[c], 1e-11);
        const double expected = 2.0 * hooke.mu * strain[c] + (c < 3 ? hooke.lambda * trace : 0.0);
        EXPECT_NEAR(stress[c], expected, 1.0);  // the same squares times 25e9 and two
      }
      if (problem == Problem::plane_strain) {
        EXPECT_NEAR(stress[2], hooke.lambda * trace, 1.0);
      }
    }
    EXPECT_GT(interior, 20);
  }
}

}  // namespace
}  // namespace perilink

#include "analysis/dynamics/lattice/body/lattice_state.hpp"

#include <gtest/gtest.h>

#include "support/lattice_models.hpp"
#include "support/lattice_operator.hpp"

namespace perilink {
namespace {

using namespace testing_support;

TEST(ExplicitState, BeginsAtRestIntactAndUnloaded) {
  LatticeMaterial material = paper_concrete();
  material.breakable = true;
  const ExplicitModel model = plane_model(rectangle(0.05, 0.05, 0.01, 20.0), material);
  ExplicitState state(model);
  EXPECT_EQ(state.in_tension, model.lattice.present);
  evaluate(model, state);
  EXPECT_EQ(stored_energy(state), 0.0);
  for (const double force : resultants(model, state)) EXPECT_EQ(force, 0.0);
}

}  // namespace
}  // namespace perilink

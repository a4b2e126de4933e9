#include "network/cells/linear_elements.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace perilink {
namespace {

/// A right triangle with legs 2 and 1, 3 thick.
TEST(LinearElements, KnowTheirGeometryAndModuli) {
  Simplices cells;
  cells.vertices = {0, 1, 2};
  cells.material = {0};
  const std::vector<double> positions = {0, 0, 2, 0, 0, 1};
  const std::vector<IsotropicMaterial> materials = {{1.0, 0.0}};
  const LinearElements elements =
      make_linear_elements(cells, positions, 3.0, Problem::plane_stress, materials);
  EXPECT_EQ(elements.num_particles, 3);
  EXPECT_DOUBLE_EQ(elements.volumes[0], 3.0);
  EXPECT_EQ(elements.gradients, (std::vector<double>{-0.5, -1.0, 0.5, 0.0, 0.0, 1.0}));
  EXPECT_DOUBLE_EQ(elements.lambda[0], 0.0);
  EXPECT_DOUBLE_EQ(elements.mu[0], 0.5);
}

TEST(LinearElements, ACellInsideOutIsRefused) {
  Simplices cells;
  cells.vertices = {0, 2, 1};
  cells.material = {0};
  const std::vector<double> positions = {0, 0, 2, 0, 0, 1};
  const std::vector<IsotropicMaterial> materials = {{1.0, 0.0}};
  EXPECT_THROW(make_linear_elements(cells, positions, 1.0, Problem::plane_stress, materials),
               std::invalid_argument);
}

}  // namespace
}  // namespace perilink

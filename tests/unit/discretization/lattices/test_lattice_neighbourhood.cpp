#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "discretization/lattices/lattice.hpp"

namespace perilink {
namespace {

Lattice unit_lattice(Pattern pattern) {
  Lattice lattice;
  lattice.pattern = pattern;
  lattice.dim = 2;
  lattice.spacing = 1.0;
  lattice.step = {1.0, pattern == Pattern::hexagonal ? 0.5 * std::numbers::sqrt3 : 1.0, 0.0};
  return lattice;
}

// Gerstle, Sau & Silling 2005, Fig. 5: particles enclosed, the centre included.
TEST(HorizonLevel, EnclosesTheParticlesOfFigure5) {
  constexpr std::array<int, 9> rectangular = {1, 5, 9, 13, 21, 25, 29, 37, 45};
  constexpr std::array<int, 9> hexagonal = {1, 7, 13, 19, 31, 37, 43, 55, 61};
  for (int level = 0; level <= 8; ++level) {
    for (const Pattern pattern : {Pattern::rectangular, Pattern::hexagonal}) {
      const auto neighbourhood =
          interior_neighbourhood(unit_lattice(pattern), horizon_of_level(pattern, level));
      const auto enclosed = static_cast<int>(neighbourhood.offsets.size()) + 1;
      EXPECT_EQ(enclosed, pattern == Pattern::rectangular ? rectangular[level] : hexagonal[level])
          << "level " << level;
    }
  }
}

TEST(HorizonLevel, RefusesOtherLevelsAndPatterns) {
  EXPECT_THROW(horizon_of_level(Pattern::rectangular, -1), std::invalid_argument);
  EXPECT_THROW(horizon_of_level(Pattern::hexagonal, 9), std::invalid_argument);
  EXPECT_THROW(horizon_of_level(Pattern::cubic, 1), std::invalid_argument);
}

TEST(InteriorNeighbourhood, IsSymmetricAndWithinTheHorizon) {
  for (const Pattern pattern : {Pattern::rectangular, Pattern::hexagonal}) {
    const auto neighbourhood = interior_neighbourhood(unit_lattice(pattern), 3.0);
    const std::size_t size = neighbourhood.offsets.size();
    for (std::size_t n = 0; n < size; ++n) {
      const Vector3& offset = neighbourhood.offsets[n];
      const Vector3& opposite = neighbourhood.offsets[size - 1 - n];
      for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(offset[axis], -opposite[axis]);
      EXPECT_LE(std::hypot(offset[0], offset[1]), 3.0 + 1e-8);
    }
  }
}

TEST(InteriorNeighbourhood, FaceCentredHasTwelveNearestAndSixNextNeighbours) {
  Lattice lattice;
  lattice.pattern = Pattern::face_centred;
  lattice.dim = 3;
  lattice.spacing = std::numbers::sqrt2;
  lattice.step = {1.0, 1.0, 1.0};
  EXPECT_EQ(interior_neighbourhood(lattice, std::numbers::sqrt2).offsets.size(), 12U);
  EXPECT_EQ(interior_neighbourhood(lattice, 2.0).offsets.size(), 18U);
  lattice.pattern = Pattern::cubic;
  EXPECT_EQ(interior_neighbourhood(lattice, 1.0).offsets.size(), 6U);
  EXPECT_EQ(interior_neighbourhood(lattice, std::sqrt(3.0)).offsets.size(), 26U);
}

}  // namespace
}  // namespace perilink

#include "assembly/results/neighbor_gradients.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numeric>

#include "discretization/bonds.hpp"
#include "support/small_networks.hpp"

namespace perilink {
namespace {

using namespace test;

int fits = 0;  ///< so far

/// Linear least squares, counted and multiplied with the first mark.
bool fit(std::span<const double> offsets, std::span<const double> marks,
         std::span<double> weights) {
  ++fits;
  const double factor = marks.empty() ? 1.0 : marks[0];
  Eigen::Matrix2d shape = Eigen::Matrix2d::Zero();
  for (std::size_t k = 0; k < offsets.size(); k += 2) {
    const Eigen::Vector2d xi(offsets[k], offsets[k + 1]);
    shape += xi * xi.transpose();
  }
  if (!(std::abs(shape.determinant()) > 1e-10 * std::pow(shape.trace(), 2))) return false;
  for (std::size_t k = 0; k < offsets.size(); k += 2) {
    Eigen::Map<Eigen::Vector2d>(weights.data() + k) =
        factor * (shape.inverse() * Eigen::Vector2d(offsets[k], offsets[k + 1]));
  }
  return true;
}

/// Weights 1, 2, ... in the order of their shape.
bool count_weights(std::span<const double> /*offsets*/, std::span<const double> /*marks*/,
                   std::span<double> weights) {
  std::iota(weights.begin(), weights.end(), 1.0);
  return true;
}

/// A square lattice whose particles have the neighbours within 2.5 spacings.
struct Square {
  Network network = make_network(rectangular, 12);
  Csr neighbourhoods = bonds_of_particles(network.bonds, network.particles.size());
  std::vector<double> motion = random_vector(network.particles.positions.size(), 7);

  std::vector<Index> neighbors(Index i) const {
    std::vector<Index> found;
    for (const Index e : neighbourhoods.row(i)) found.push_back(network.bonds.other_end(e, i));
    return found;
  }
  NeighborGradients<2> gradients() const { return {network.particles, motion, 2, fit}; }

  /// Fits for all particles, whose gradients are those that each has by itself.
  int fits_of_all(double tolerance) const {
    NeighborGradients<2> shared = gradients();
    int count = 0;
    for (Index i = 0; i < network.particles.size(); ++i) {
      NeighborGradients<2>::Gradient found, own;
      fits = 0;
      EXPECT_TRUE(shared.find(i, neighbors(i), found));
      count += fits;
      EXPECT_TRUE(gradients().find(i, neighbors(i), own));
      EXPECT_LE((found - own).norm(), tolerance * own.norm());
    }
    return count;
  }
};

/// Two rows at either side have fewer neighbours than those between: five kinds in each direction.
/// Weights share the round-off of positions, which a width of 12 spacings makes a few digits.
TEST(NeighborGradients, AreFoundOnceForAllThatLieAlike) {
  EXPECT_EQ(Square().fits_of_all(1e-13), 25);
}

/// What is moved by more than round-off has weights of its own, to the last digit.
TEST(NeighborGradients, OfOtherPlacesAreFoundForEach) {
  Square moved;
  const std::vector<double> noise = random_vector(moved.motion.size(), 3);
  for (std::size_t k = 0; k < noise.size(); ++k) {
    moved.network.particles.positions[k] += 1e-9 * noise[k];
  }
  EXPECT_EQ(moved.fits_of_all(0.0), moved.network.particles.size());
}

TEST(NeighborGradients, OfALineAreNotSettled) {
  const Square square;
  NeighborGradients<2> gradients = square.gradients();
  NeighborGradients<2>::Gradient gradient = NeighborGradients<2>::Gradient::Constant(3.0);
  const std::vector<Index> row = {1, 2};
  for (int again = 0; again < 2; ++again) {
    EXPECT_FALSE(gradients.find(0, row, gradient));
    EXPECT_FALSE(gradients.find(0, {}, gradient));
    EXPECT_EQ(gradient, (NeighborGradients<2>::Gradient::Constant(3.0)));
  }
}

TEST(NeighborGradients, DependOnMarks) {
  const Square square;
  NeighborGradients<2> gradients = square.gradients();
  NeighborGradients<2>::Gradient one, two, again;
  const std::vector<double> mark = {2.0};
  ASSERT_TRUE(gradients.find(30, square.neighbors(30), one));
  ASSERT_TRUE(gradients.find(30, square.neighbors(30), two, mark));
  ASSERT_TRUE(gradients.find(30, square.neighbors(30), again));
  EXPECT_LE((two - 2.0 * one).norm(), 1e-14 * two.norm());
  EXPECT_EQ(one, again);
}

TEST(NeighborGradients, TakeAllComponentsIfCoupled) {
  const Square square;
  NeighborGradients<2> gradients(square.network.particles, square.motion, 2, count_weights, true);
  NeighborGradients<2>::Gradient gradient;
  const std::vector<Index> neighbor = {1};
  ASSERT_TRUE(gradients.find(0, neighbor, gradient));
  const double u = square.motion[2] - square.motion[0], v = square.motion[3] - square.motion[1];
  const NeighborGradients<2>::Gradient exact{{u + 5.0 * v, 2.0 * u + 6.0 * v},
                                             {3.0 * u + 7.0 * v, 4.0 * u + 8.0 * v}};
  EXPECT_LE((gradient - exact).norm(), 1e-14 * exact.norm());
}

}  // namespace
}  // namespace perilink

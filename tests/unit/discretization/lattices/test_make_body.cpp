#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "discretization/lattices/lattice.hpp"
#include "discretization/lattices/make_body.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;

LatticeInput box_input(Pattern pattern, double spacing, Vector3 size) {
  LatticeInput input;
  input.pattern = pattern;
  input.spacing = spacing;
  input.thickness = 2.0;
  input.solid = {{{-1.0, 3.0, 0.5}, {-1.0 + size[0], 3.0 + size[1], 0.5 + size[2]}}};
  input.material = {0};
  return input;
}

/// The L-shaped panel: a square with one quarter cut out, ten steps across (12 rows if hexagonal).
LatticeInput panel_input(Pattern pattern) {
  LatticeInput input;
  input.pattern = pattern;
  input.spacing = pattern == Pattern::face_centred ? 0.2 * std::numbers::sqrt2 : 0.2;
  input.solid = {{{0.0, 0.0, 0.0}, {2.0, 1.0, 2.0}}, {{0.0, 0.0, 0.0}, {1.0, 2.0, 2.0}}};
  input.material = {0, 1};
  return input;
}

double sum_of_volumes(const Body& body) {
  return std::accumulate(body.particles.volumes.begin(), body.particles.volumes.end(), 0.0);
}

/// First moments sum V x: exact for shape functions that are linear on every cell.
Vector3 first_moments(const Particles& particles) {
  Vector3 sum{};
  for (Index i = 0; i < particles.size(); ++i) {
    for (int axis = 0; axis < particles.dim; ++axis) {
      sum[axis] += particles.volumes[i] * particles.position(i)[axis];
    }
  }
  return sum;
}

class ConformingLattice : public testing::TestWithParam<Pattern> {};

TEST_P(ConformingLattice, FillsABoxToRoundOffAndReachesItsFaces) {
  const LatticeInput input = box_input(GetParam(), 0.31, {4.0, 3.3, 2.1});
  const Body body = make_body(input);
  const int dim = body.particles.dim;
  const double exact = 4.0 * 3.3 * (dim == 2 ? input.thickness : 2.1);
  EXPECT_NEAR(sum_of_volumes(body), exact, 1e-13 * exact);
  Vector3 lowest = {1e9, 1e9, 1e9};
  Vector3 highest = {-1e9, -1e9, -1e9};
  for (Index i = 0; i < body.particles.size(); ++i) {
    EXPECT_GT(body.particles.volumes[i], 0.0);
    EXPECT_LT(body.particles.volumes[i], body.lattice.cell_volume * (1.0 + 1e-12));
    for (int axis = 0; axis < dim; ++axis) {
      lowest[axis] = std::min(lowest[axis], body.particles.position(i)[axis]);
      highest[axis] = std::max(highest[axis], body.particles.position(i)[axis]);
    }
  }
  for (int axis = 0; axis < dim; ++axis) {
    EXPECT_EQ(lowest[axis], input.solid[0].lower[axis]);
    EXPECT_EQ(highest[axis], input.solid[0].upper[axis]);
  }
}

TEST_P(ConformingLattice, InteriorParticlesHaveTheCellVolume) {
  const Body body = make_body(box_input(GetParam(), 0.5, {4.0, 4.0, 4.0}));
  int interior = 0;
  for (Index i = 0; i < body.particles.size(); ++i) {
    const auto x = body.particles.position(i);
    const Box inner = {{-0.4, 3.6, 1.1}, {2.4, 6.4, 3.9}};
    if (!inner.contains(x, 0.0)) continue;
    ++interior;
    EXPECT_NEAR(body.particles.volumes[i], body.lattice.cell_volume,
                1e-13 * body.lattice.cell_volume);
  }
  EXPECT_GT(interior, 10);
}

TEST_P(ConformingLattice, SortsByRows) {
  const Body body = make_body(box_input(GetParam(), 0.5, {2.0, 2.0, 2.0}));
  const int dim = body.particles.dim;
  for (Index i = 1; i < body.particles.size(); ++i) {
    const auto before = body.particles.position(i - 1);
    const auto here = body.particles.position(i);
    EXPECT_TRUE(
        std::lexicographical_compare(before.rbegin(), before.rend(), here.rbegin(), here.rend()))
        << "particle " << i << " of dimension " << dim;
  }
}

TEST_P(ConformingLattice, FillsAPanelWithAReentrantCorner) {
  const Body body = make_body(panel_input(GetParam()));
  const double exact = body.particles.dim == 2 ? 3.0 : 6.0;
  EXPECT_NEAR(sum_of_volumes(body), exact, 1e-13 * exact);
  for (Index i = 0; i < body.particles.size(); ++i) {
    const auto x = body.particles.position(i);
    EXPECT_FALSE(x[0] > 1.0 + 1e-9 && x[1] > 1.0 + 1e-9);
    EXPECT_EQ(body.particles.material[i], x[0] < 1.0 + 1e-9 ? 1 : 0);
  }
}

INSTANTIATE_TEST_SUITE_P(AllPatterns, ConformingLattice,
                         testing::Values(Pattern::rectangular, Pattern::hexagonal, Pattern::cubic,
                                         Pattern::face_centred));

TEST(Lattice, ShapeFunctionVolumesHaveExactFirstMoments) {
  for (const Pattern pattern : {Pattern::rectangular, Pattern::hexagonal, Pattern::cubic}) {
    const Body body = make_body(panel_input(pattern));
    const double depth = body.particles.dim == 2 ? 1.0 : 2.0;
    const Vector3 moments = first_moments(body.particles);
    // Square of side 2 less the quarter of side 1 about (1.5, 1.5).
    EXPECT_NEAR(moments[0], (4.0 * 1.0 - 1.5) * depth, 1e-12);
    EXPECT_NEAR(moments[1], (4.0 * 1.0 - 1.5) * depth, 1e-12);
  }
}

TEST(Lattice, AdaptsTheSpacingOfEachAxis) {
  const Body rectangular = make_body(box_input(Pattern::rectangular, 0.3, {1.0, 2.0, 0.0}));
  EXPECT_DOUBLE_EQ(rectangular.lattice.spacing, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(rectangular.lattice.step[1], 2.0 / 7.0);
  EXPECT_EQ(rectangular.particles.size(), 4 * 8);
  EXPECT_DOUBLE_EQ(rectangular.lattice.cell_volume, 2.0 / 21.0 * 2.0);

  const Body hexagonal = make_body(box_input(Pattern::hexagonal, 0.25, {1.0, 1.0, 0.0}));
  EXPECT_DOUBLE_EQ(hexagonal.lattice.step[1], 0.2);  // 1 / round(1 / 0.2165)
  // Rows of 5 and of 4 with both ends completed.
  EXPECT_EQ(hexagonal.particles.size(), 3 * 5 + 3 * 6);

  const Body face_centred = make_body(box_input(Pattern::face_centred, 1.0, {2.0, 2.0, 3.0}));
  EXPECT_DOUBLE_EQ(face_centred.lattice.step[0], 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(face_centred.lattice.step[2], 3.0 / 4.0);
  EXPECT_DOUBLE_EQ(face_centred.lattice.spacing, 2.0 / 3.0 * std::numbers::sqrt2);
}

TEST(Lattice, RefusesAnOutlineBetweenItsPlanesAndNamesSpacingsThatFit) {
  LatticeInput input = panel_input(Pattern::rectangular);
  input.spacing = 0.25;
  input.solid[1].upper[0] = 0.8;  // the square is 5 or a multiple of 5 steps wide
  input.solid[0].upper[1] = 0.8;
  try {
    make_body(input);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("face at x = 0.8"));
    EXPECT_THAT(error.what(), HasSubstr("0.2 or 0.4"));
  }
  input.spacing = 0.2;
  EXPECT_NEAR(sum_of_volumes(make_body(input)), 4.0 - 1.2 * 1.2, 1e-13);
}

TEST(Lattice, RefusesWhatIsNoBody) {
  LatticeInput input = box_input(Pattern::rectangular, 0.5, {1.0, 1.0, 1.0});
  input.spacing = 0.0;
  EXPECT_THROW(make_body(input), std::invalid_argument);
  input.spacing = 0.5;
  input.thickness = -1.0;
  EXPECT_THROW(make_body(input), std::invalid_argument);
  input.thickness = 1.0;
  input.material.clear();
  EXPECT_THROW(make_body(input), std::invalid_argument);
  input.solid.clear();
  EXPECT_THROW(make_body(input), std::invalid_argument);
}

TEST(Lattice, OnePairOfColumnsIsTheLeast) {
  const Body body = make_body(box_input(Pattern::rectangular, 10.0, {1.0, 1.0, 0.0}));
  EXPECT_EQ(body.particles.size(), 4);
}

}  // namespace
}  // namespace perilink

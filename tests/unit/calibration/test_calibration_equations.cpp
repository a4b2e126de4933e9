#include "calibration/calibration_equations.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

#include "calibration/bounded_least_squares/equations/variable_parts.hpp"
#include "discretization/lattices/lattice.hpp"
#include "discretization/lattices/make_body.hpp"
#include "support/calibration_problem.hpp"

namespace perilink {
namespace {

/// A square of micropolar bonds with arbitrary stiffnesses, all of them free.
struct Square {
  Body body;
  Bonds bonds;
  BondStiffness stiffness;
  CalibrationInput input() const { return {body.particles, bonds, {{0.8, 1.3}}, {}}; }
};

Square make_square() {
  Square square;
  LatticeInput input;
  input.spacing = 0.25;
  input.surface = Surface::calibrated;
  input.solid = {{{0, 0, 0}, {1, 1, 0}}};
  input.material = {0};
  square.body = make_body(input);
  square.bonds = make_bonds(square.body.particles, 0.51);
  for (Index b = 0; b < square.bonds.size(); ++b) {
    square.stiffness.axial.push_back(1.0 + 0.1 * (b % 7));
    square.stiffness.bending.push_back(0.3 + 0.05 * (b % 5));
    square.stiffness.inflection.push_back(0.4 + 0.05 * (b % 4));
  }
  return square;
}

/// What weights leave of the equations, scaled.
std::vector<double> rest_of(const PointEquations& equations, const std::vector<double>& weights) {
  std::vector<double> rest = equations.right;
  const std::size_t rows = static_cast<std::size_t>(equations.rows);
  for (Index v = 0; v < equations.num_variables(); ++v) {
    for_each_part(equations, v, [&](Index p, int from, int to, double sign) {
      for (int r = from; r < to; ++r) {
        rest[p * rows + r] -= sign * equations.coefficients[v * rows + r] * weights[v];
      }
    });
  }
  for (std::size_t k = 0; k < rest.size(); ++k) rest[k] *= equations.scale[k];
  return rest;
}

double largest(const std::vector<double>& values) {
  double result = 0.0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

/// The equations are linear in the weights, and the stiffnesses, inflections and shares that
/// apply() makes of them leave what the equations said that they would leave.
TEST(CalibrationEquations, PredictWhatTheirWeightsLeave) {
  const Square square = make_square();
  const CalibrationInput input = square.input();
  CalibrationEquations equations(input, 0.02, square.body.facets, square.stiffness);
  const PointEquations before = equations.balance();
  EXPECT_EQ(before.rows, 8);
  EXPECT_EQ(before.one_ended, square.bonds.size());
  EXPECT_EQ(before.num_variables(), 3 * square.bonds.size() + square.body.facets.size());
  std::vector<double> weights;
  for (Index v = 0; v < before.num_variables(); ++v) weights.push_back(1.0 + 0.02 * (v % 11));
  const std::vector<double> expected = rest_of(before, weights);
  ASSERT_GT(largest(expected), 0.1);
  equations.apply(weights);
  const PointEquations after = equations.balance();
  const std::vector<double> ones(weights.size(), 1.0);
  const std::vector<double> found = rest_of(after, ones);
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-13);
}

/// Where both couples of a bond are zero it does not bend, and has no inflection but that of the
/// middle; the next step finds its couples in the equations and may bring them back.
TEST(CalibrationEquations, OfABondWithoutCouplesPutTheInflectionInTheMiddle) {
  const Square square = make_square();
  const CalibrationInput input = square.input();
  CalibrationEquations equations(input, 0.02, square.body.facets, square.stiffness);
  const std::size_t num_bonds = square.stiffness.axial.size();
  std::vector<double> weights(static_cast<std::size_t>(equations.balance().num_variables()), 1.0);
  const std::size_t zero = 5, round_off = 6;
  for (const double end : {0, 1}) {
    weights[num_bonds + 2 * zero + static_cast<std::size_t>(end)] = 0.0;
    weights[num_bonds + 2 * round_off + static_cast<std::size_t>(end)] = 1e-15 * (end - 0.6);
  }
  equations.apply(weights);
  const auto gone = equations.save().stiffness;
  for (const std::size_t bond : {zero, round_off}) {
    EXPECT_EQ(gone.bending[bond], 0.0);
    EXPECT_EQ(gone.inflection[bond], 0.5);
    EXPECT_EQ(gone.axial[bond], square.stiffness.axial[bond]);
  }
  EXPECT_EQ(gone.bending[4], square.stiffness.bending[4]);
  ASSERT_EQ(equations.balance().num_variables(), static_cast<Index>(weights.size()));
  equations.apply(std::vector<double>(weights.size(), 2.0));
  const auto back = equations.save().stiffness;
  for (const std::size_t bond : {zero, round_off}) {
    EXPECT_GT(back.bending[bond], 0.0);
    EXPECT_NEAR(back.inflection[bond], square.stiffness.inflection[bond], 1e-14);
  }
}

TEST(CalibrationEquations, KeepTheSumOfTheSharesAndTheirBounds) {
  const Square square = make_square();
  const CalibrationInput input = square.input();
  CalibrationEquations equations(input, 0.02, square.body.facets, square.stiffness);
  const PointEquations present = equations.balance();
  equations.apply(present.lower);
  const auto state = equations.save();
  for (Index f = 0; f < square.body.facets.size(); ++f) {
    const Index c = square.body.facets.corners.offsets[f];
    EXPECT_NEAR(state.shares[c] + state.shares[c + 1], 1.0, 1e-14);
    EXPECT_NEAR(std::min(state.shares[c], state.shares[c + 1]), 0.05, 1e-14);
  }
  for (std::size_t b = 0; b < state.stiffness.axial.size(); ++b) {
    EXPECT_NEAR(state.stiffness.axial[b], 0.02 * square.stiffness.axial[b], 1e-15);
    EXPECT_GE(state.stiffness.bending[b], 0.0);
  }
}

/// A lattice's own bonds inside stay as they are, and so do the shares.
TEST(CalibrationEquations, OfSomeBondsLeaveTheOthersAndTheShares) {
  const Square square = make_square();
  CalibrationInput input = square.input();
  input.free.assign(square.stiffness.axial.size(), 0);
  for (std::size_t b = 0; b < input.free.size(); b += 3) input.free[b] = 1;
  CalibrationEquations equations(input, 0.02, square.body.facets, square.stiffness);
  const PointEquations present = equations.balance();
  equations.apply(std::vector<double>(static_cast<std::size_t>(present.num_variables()), 1.5));
  const auto state = equations.save();
  for (std::size_t b = 0; b < input.free.size(); ++b) {
    EXPECT_DOUBLE_EQ(state.stiffness.axial[b],
                     (input.free[b] ? 1.5 : 1.0) * square.stiffness.axial[b]);
    EXPECT_NEAR(state.stiffness.bending[b],
                (input.free[b] ? 1.5 : 1.0) * square.stiffness.bending[b], 1e-15);
    EXPECT_NEAR(state.stiffness.inflection[b], square.stiffness.inflection[b], 1e-15);
  }
  EXPECT_EQ(state.shares, square.body.facets.shares);
}

/// The energies of dilatation of all columns and particles, with what they ought to be.
TEST(CalibrationEquations, AskForTheEnergyOfTheBody) {
  const Square square = make_square();
  const CalibrationInput input = square.input();
  const CalibrationEquations equations(input, 0.02, square.body.facets, square.stiffness);
  const PointEquations settling = equations.settling();
  ASSERT_EQ(settling.rows, 9);
  double wanted = 0.0;
  for (Index p = 0; p < settling.num_points(); ++p) wanted += settling.right[p * 9 + 8];
  // V (4 lambda + 4 mu) of the unit square.
  EXPECT_NEAR(wanted, 4.0 * (0.8 + 1.3), 1e-12);
}

TEST(CalibrationEquations, DropWhatMayVanishAndTakeItBack) {
  const Square square = make_square();
  const CalibrationInput input = square.input();
  CalibrationEquations equations(input, 0.02, square.body.facets, square.stiffness);
  EXPECT_FALSE(equations.allow_zero(1e9));
  EXPECT_TRUE(equations.allow_zero(1e-12));
  const PointEquations present = equations.balance();
  std::vector<double> weights(static_cast<std::size_t>(present.num_variables()), 1.0);
  weights[3] = 0.0;
  equations.apply(weights);
  equations.drop_zero_weights();
  EXPECT_EQ(equations.balance().num_variables(), present.num_variables() - 3);
  equations.start_over();
  EXPECT_EQ(equations.save().stiffness.axial[3], 0.0);
  EXPECT_EQ(equations.save().stiffness.bending[3], 0.0);
  EXPECT_FALSE(equations.underconstrained());
  equations.take_all_back();
  EXPECT_EQ(equations.balance().num_variables(), present.num_variables());
  EXPECT_EQ(equations.save().stiffness.axial, square.stiffness.axial);
}

/// Meshes number their nodes at random: the ends of a bond are a third of all points apart then.
TEST(CalibrationEquations, OfCloudsInSpaceComeInTheOrderOfTheirPlaces) {
  test::Problem problem =
      test::make_problem(test::box(Pattern::cubic, 0.1, {1, 1, 1}), 2.0, 0.3, false);
  Particles& particles = problem.body.particles;
  std::vector<Index> order(static_cast<std::size_t>(particles.size()));
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  const std::vector<double> positions = particles.positions;
  for (std::size_t i = 0; i < order.size(); ++i) {
    std::copy_n(positions.begin() + 3 * order[i], 3, particles.positions.begin() + 3 * i);
  }
  const Bonds bonds = make_bonds(particles, 0.2);
  BondStiffness stiffness;
  stiffness.axial.assign(static_cast<std::size_t>(bonds.size()), 1.0);
  const CalibrationInput input{particles, bonds, {{1.0, 1.0}}, {}};
  const PointEquations equations = CalibrationEquations(input, 0.02, {}, stiffness).balance();
  ASSERT_EQ(equations.num_points(), particles.size());
  std::vector<std::pair<Index, Index>> ends;
  double apart = 0.0;
  for (std::size_t v = 0; v < equations.first.size(); ++v) {
    ends.push_back(std::minmax(equations.first[v], equations.second[v]));
    apart += ends.back().second - ends.back().first;
  }
  EXPECT_TRUE(std::ranges::is_sorted(ends));
  EXPECT_LT(apart / static_cast<double>(ends.size()), 0.15 * particles.size());
}

}  // namespace
}  // namespace perilink

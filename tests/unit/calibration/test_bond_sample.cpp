#include "calibration/bond_sample.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <vector>

#include "calibration/calibration.hpp"
#include "calibration/calibration_equations.hpp"
#include "support/calibration_problem.hpp"

namespace perilink {
namespace {

using namespace test;

/// A square of 61 by 61 particles and the bonds of those that lack neighbours.
struct SampledSquare {
  Problem problem;
  std::vector<std::uint8_t> lack, free;

  explicit SampledSquare(bool bending)
      : problem(make_problem(box(Pattern::rectangular, 1.0 / 60.0, {1, 1, 0}), 3.0, 0.0, bending)) {
    const Particles& particles = problem.body.particles;
    for (std::size_t b = 0; b < problem.stiffness.bending.size(); ++b) {
      problem.stiffness.inflection.push_back(0.3 + 1e-4 * static_cast<double>(b % 1000));
    }
    const Csr bonds = bonds_of_particles(problem.bonds, particles.size());
    make_inside_right(bonds.row(particles.size() / 2), particles.size() / 2);
    Index most = 0;
    for (Index i = 0; i < particles.size(); ++i) {
      most = std::max(most, static_cast<Index>(bonds.row(i).size()));
    }
    for (Index i = 0; i < particles.size(); ++i) {
      lack.push_back(static_cast<Index>(bonds.row(i).size()) < most);
    }
    for (Index b = 0; b < problem.bonds.size(); ++b) {
      free.push_back(lack[problem.bonds.first[b]] || lack[problem.bonds.second[b]]);
    }
  }

  /// Bonds of one length are as stiff as around the middle, which is isotropic.
  void make_inside_right(std::span<const Index> around, Index middle) {
    const Particles& particles = problem.body.particles;
    std::vector<Vector3> offsets;
    NeighbourhoodStiffness neighbourhood;
    for (const Index b : around) {
      const auto to = particles.position(problem.bonds.other_end(b, middle));
      const auto from = particles.position(middle);
      offsets.push_back({to[0] - from[0], to[1] - from[1], 0.0});
      neighbourhood.axial.push_back(problem.stiffness.axial[b]);
    }
    make_isotropic(2, offsets, particles.volumes[middle], {1.0, 1.0}, neighbourhood);
    std::map<long, double> of_length;
    const auto rounded = [&](Index b) { return std::lround(1e6 * problem.bonds.length(b)); };
    for (std::size_t k = 0; k < around.size(); ++k)
      of_length[rounded(around[k])] = neighbourhood.axial[k];
    for (Index b = 0; b < problem.bonds.size(); ++b) {
      problem.stiffness.axial[b] = of_length.at(rounded(b));
    }
  }
};

TEST(BondSample, HoldsTheBondsOfMarkedParticles) {
  const SampledSquare square(true);
  const Bonds& bonds = square.problem.bonds;
  std::vector<std::uint8_t> marked(square.lack.size(), 0);
  marked[40] = marked[500] = 1;
  const BondSample sample = sample_bonds(marked, bonds, square.free, square.problem.stiffness);
  std::vector<Index> expected;
  for (Index b = 0; b < bonds.size(); ++b) {
    if (marked[bonds.first[b]] || marked[bonds.second[b]]) expected.push_back(b);
  }
  ASSERT_EQ(sample.numbers, expected);
  for (Index s = 0; s < sample.bonds.size(); ++s) {
    const Index b = sample.numbers[s];
    EXPECT_EQ(sample.bonds.first[s], bonds.first[b]);
    EXPECT_EQ(sample.bonds.second[s], bonds.second[b]);
    EXPECT_EQ(sample.bonds.length(s), bonds.length(b));
    EXPECT_TRUE(std::ranges::equal(sample.bonds.direction(s), bonds.direction(b)));
    EXPECT_EQ(sample.free[s], square.free[b]);
    EXPECT_EQ(sample.stiffness.axial[s], square.problem.stiffness.axial[b]);
    EXPECT_EQ(sample.stiffness.bending[s], square.problem.stiffness.bending[b]);
    EXPECT_EQ(sample.stiffness.inflection[s], square.problem.stiffness.inflection[b]);
  }
}

TEST(BondSample, PutsBackWhatWasFoundAndNothingElse) {
  const SampledSquare square(true);
  std::vector<std::uint8_t> marked(square.lack.size(), 0);
  marked[0] = 1;
  const BondStiffness& before = square.problem.stiffness;
  const BondSample sample = sample_bonds(marked, square.problem.bonds, square.free, before);
  BondStiffness found = sample.stiffness, after = before;
  for (double& k : found.axial) k = -1.0;
  for (double& k : found.bending) k = -2.0;
  for (double& part : found.inflection) part = -3.0;
  sample.put_back(found, after);
  for (std::size_t b = 0; b < before.axial.size(); ++b) {
    const bool in = std::ranges::binary_search(sample.numbers, static_cast<Index>(b));
    EXPECT_EQ(after.axial[b], in ? -1.0 : before.axial[b]);
    EXPECT_EQ(after.bending[b], in ? -2.0 : before.bending[b]);
    EXPECT_EQ(after.inflection[b], in ? -3.0 : before.inflection[b]);
  }
}

/// What single bonds are calibrated with where few may change: all digits of the equations of the
/// whole body.
TEST(BondSample, OfFreeBondsIsAllThatTheEquationsAskFor) {
  for (const bool bending : {false, true}) {
    const SampledSquare square(bending);
    const Problem& problem = square.problem;
    const Particles& particles = problem.body.particles;
    const CalibrationInput whole{particles, problem.bonds, {{1.0, 1.3}}, square.free};
    const BondSample sample = sample_bonds(mark_ends(problem.bonds, square.free, particles.size()),
                                           problem.bonds, square.free, problem.stiffness);
    const CalibrationInput part{particles, sample.bonds, whole.materials, sample.free};
    const Facets& facets = problem.body.facets;
    const PointEquations of_all =
        CalibrationEquations(whole, 0.02, facets, problem.stiffness).balance();
    const PointEquations of_few =
        CalibrationEquations(part, 0.02, facets, sample.stiffness).balance();
    EXPECT_EQ(of_few.first, of_all.first);
    EXPECT_EQ(of_few.second, of_all.second);
    EXPECT_EQ(of_few.right, of_all.right);
    EXPECT_EQ(of_few.scale, of_all.scale);
    EXPECT_EQ(of_few.coefficients, of_all.coefficients);
    EXPECT_EQ(of_few.lower, of_all.lower);
    EXPECT_EQ(of_few.upper, of_all.upper);
    EXPECT_EQ(of_few.positions, of_all.positions);
  }
}

/// 1e-10: a hundred times the tolerance of the solver.
TEST(BondSample, OfFreeBondsBringsTheWholeBodyIntoBalance) {
  SampledSquare square(false);
  Problem& problem = square.problem;
  const CalibrationInput whole{problem.body.particles, problem.bonds, {{1.0, 1.0}}, square.free};
  const BondStiffness before = problem.stiffness;
  const CalibrationReport report =
      calibrate_bonds(whole, {}, problem.body.facets, problem.stiffness);
  EXPECT_GT(report.residual_before, 0.1);
  CalibrationReport measured;
  CalibrationEquations(whole, 0.02, problem.body.facets, problem.stiffness)
      .report_balance(measured);
  EXPECT_LT(measured.residual_after, 1e-10);
  for (std::size_t b = 0; b < before.axial.size(); ++b) {
    if (square.free[b]) continue;
    EXPECT_EQ(problem.stiffness.axial[b], before.axial[b]);
  }
}

}  // namespace
}  // namespace perilink

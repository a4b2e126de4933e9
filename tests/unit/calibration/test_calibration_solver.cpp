#include "calibration/calibration_solver.hpp"

#include <gtest/gtest.h>

#include "support/calibration_problem.hpp"

namespace perilink {
namespace {

using namespace test;

struct Searched {
  CalibrationReport report;
  int searches = 0;
  bool presolves = false;
};

/// Bonds of a lattice, every one by itself.
Searched search(const Problem& problem, bool presolves) {
  const CalibrationInput input{problem.body.particles,
                               problem.bonds,
                               {{1.0, 1.0}},
                               std::vector<std::uint8_t>(problem.bonds.lengths.size(), 1)};
  Searched result;
  CalibrationOptions options;
  options.on_search = [&](int number, double) { result.searches = number; };
  CalibrationSolver search(input, options, problem.body.facets, problem.stiffness, nullptr,
                           presolves);
  result.report = search.run();
  result.presolves = search.presolves();
  return result;
}

/// Without the bonds that must vanish at the corners of a cube nothing has to be found out: no
/// search for contradictions and none for zeros.
TEST(CalibrationSolver, DropsFirstWhatMustVanish) {
  const Problem problem = make_problem(box(Pattern::cubic, 0.2, {1, 1, 1}), 3.0, 0.0, false);
  const Searched first = search(problem, true), later = search(problem, false);
  EXPECT_EQ(first.searches, 2);  // a coarse one, and the rest
  EXPECT_EQ(later.searches, 3);
  EXPECT_TRUE(first.presolves);
  EXPECT_FALSE(later.presolves);
  for (const Searched* each : {&first, &later}) {
    EXPECT_LT(each->report.residual_after, 1e-10);
    EXPECT_EQ(each->report.dropped, 56);
  }
}

/// Bonds with moments can do without an axial stiffness: what they carry across need not vanish.
TEST(CalibrationSolver, DropsNothingFirstThatCarriesMoments) {
  Problem problem = make_problem(box(Pattern::cubic, 0.25, {1, 1, 1}), 2.0, 0.0, true);
  problem.stiffness.inflection.assign(problem.stiffness.bending.size(), 0.5);
  EXPECT_FALSE(search(problem, true).presolves);
}

/// A face-centred plate of two cells has no solution of bonds without moments: what is left must
/// not depend on what was tried first, and later searches need not try it.
TEST(CalibrationSolver, TakesAllBondsBackWhereTheContradictionIsElsewhere) {
  const Problem problem =
      make_problem(box(Pattern::face_centred, 0.5, {3, 3, 0.5}), 2.0, 0.0, false);
  const Searched first = search(problem, true), later = search(problem, false);
  EXPECT_GT(later.report.unmet, 0);
  EXPECT_EQ(first.searches, later.searches + 1);
  EXPECT_FALSE(first.presolves);
  EXPECT_EQ(first.report.residual_after, later.report.residual_after);
  EXPECT_EQ(first.report.dropped, later.report.dropped);
}

}  // namespace
}  // namespace perilink

#include "calibration/bounded_least_squares/coarse_space.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "calibration/calibration_equations.hpp"
#include "support/calibration_problem.hpp"
#include "support/point_equations.hpp"

namespace perilink {
namespace {

using namespace test;

/// A prism with a notch one step wide.
LatticeInput notched_box(double length, double width) {
  LatticeInput input = box(Pattern::cubic, 1.0, {length, width, width});
  const double left = std::floor(length / 2);
  input.solid = {{{0, 0, 0}, {left, width, width}},
                 {{left + 1, 0, 0}, {length, width, width}},
                 {{left, width / 2, 0}, {left + 1, width, width}}};
  input.material = {0, 0, 0};
  return input;
}

/// The same with the equations of its forces.
struct Notched {
  explicit Notched(double length) {
    problem = make_problem(notched_box(length, 4), 2.5, 0.0, false);
    const CalibrationInput given{problem.body.particles,
                                 problem.bonds,
                                 {{1.0, 1.0}},
                                 std::vector<std::uint8_t>(problem.bonds.lengths.size(), 1)};
    equations = CalibrationEquations(given, 0.02, problem.body.facets, problem.stiffness).balance();
  }
  Problem problem;
  PointEquations equations;
};

/// Every seventh variable at a bound, the others with parts from 0.1 to 1.
std::vector<double> active_everywhere(const PointEquations& equations) {
  std::mt19937 random(3);
  std::vector<double> active;
  for (Index v = 0; v < equations.num_variables(); ++v) {
    active.push_back(v % 7 == 0 ? 0.0 : 0.1 + 0.9 * static_cast<double>(random()) / 4294967296.0);
  }
  return active;
}

/// Columns of the matrix, and the identity where no variable acts. The diagonal of a block is
/// raised by 1e-11 of its trace.
TEST(CoarseSpace, BlocksOfThePointsAreThoseOfTheMatrix) {
  Notched body(8);
  PointEquations& equations = body.equations;
  for (std::size_t r = 0; r < 10; ++r) equations.scale[r] = 0.0;
  const std::vector<double> active = active_everywhere(equations);
  constexpr double diagonal = 0.1;
  const std::vector<double> blocks =
      point_blocks(equations, active, std::vector<double>(equations.right.size(), diagonal));
  EXPECT_EQ(Eigen::Map<const Eigen::MatrixXd>(blocks.data(), 10, 10),
            Eigen::MatrixXd::Identity(10, 10));
  for (const Index p : {1, 17, 100}) {
    for (Index c = 0; c < 10; ++c) {
      const Eigen::VectorXd column =
          apply_system(equations, active, diagonal,
                       Eigen::VectorXd::Unit(equations.num_points() * 10, 10 * p + c));
      for (Index r = 0; r < 10; ++r) {
        EXPECT_NEAR(blocks[static_cast<std::size_t>(100 * p + 10 * c + r)], column[10 * p + r],
                    1e-9);
      }
    }
  }
}

/// Pair forces do no work on the third power of a rotation g, the symmetric tensor g g g: g.n is
/// the same at both ends of a bond. Such fields are in the space, whatever the weights, so that its
/// correction finds them again. 1e-6: round-off over the diagonal of 1e-8, which is all that
/// resists them.
TEST(CoarseSpace, HoldsTensorsOnWhichPairForcesDoNoWork) {
  const Notched body(16);
  const PointEquations& equations = body.equations;
  constexpr double diagonal = 1e-8;
  Eigen::VectorXd field(equations.num_points() * 10);
  for (Index p = 0; p < equations.num_points(); ++p) {
    const double* x = equations.positions.data() + 3 * p;
    const std::array<double, 3> g = {-(x[1] - 2.0) / 8.0, (x[0] - 8.0) / 8.0, 0.3};
    Index k = p * 10;
    for (int a = 0; a < 3; ++a) {
      for (int b = a; b < 3; ++b) {
        for (int c = b; c < 3; ++c, ++k) {
          const double times = a == c ? 1.0 : a == b || b == c ? 3.0 : 6.0;  // among all indices
          field[k] = times * g[a] * g[b] * g[c] / equations.scale[k];
        }
      }
    }
  }
  for (const auto& [weighted, kind] :
       {std::pair(false, CoarseModes::soft), std::pair(true, CoarseModes::soft),
        std::pair(true, CoarseModes::killing)}) {
    const std::vector<double> active =
        weighted ? active_everywhere(equations)
                 : std::vector<double>(static_cast<std::size_t>(equations.num_variables()), 1.0);
    const CoarseSpace space(equations, active,
                            std::vector<double>(equations.right.size(), diagonal), kind);
    EXPECT_LT(space.num_fields(), equations.num_points() * 10 / 2);
    const Eigen::VectorXd right = apply_system(equations, active, diagonal, field);
    ASSERT_LT(right.norm(), 2.0 * diagonal * field.norm());
    Eigen::VectorXd found = Eigen::VectorXd::Zero(field.size());
    space.add_correction(right.data(), found.data());
    EXPECT_LT((found - field).norm(), 1e-6 * field.norm());
  }
}

/// Galerkin's correction removes all that its fields see: applied to the new residual it finds
/// nothing, also where the weights are no longer those that the fields were found for.
void expect_no_soft_residual(CoarseModes kind) {
  const Notched body(12);
  const PointEquations& equations = body.equations;
  const std::vector<double> ones(static_cast<std::size_t>(equations.num_variables()), 1.0);
  const std::vector<double> active = active_everywhere(equations);
  constexpr double shift = 1e-6;
  const std::vector<double> diagonal(equations.right.size(), shift);
  CoarseSpace space(equations, ones, diagonal, kind);
  space.refactorize(equations, active, diagonal);
  std::mt19937 random(5);
  const Eigen::VectorXd right = Eigen::VectorXd::NullaryExpr(
      equations.num_points() * 10, [&] { return static_cast<double>(random()) / 4294967296.0; });
  Eigen::VectorXd once = Eigen::VectorXd::Zero(right.size()), twice = once;
  space.add_correction(right.data(), once.data());
  const Eigen::VectorXd rest = right - apply_system(equations, active, shift, once);
  space.add_correction(rest.data(), twice.data());
  EXPECT_GT(once.norm(), 0.0);
  EXPECT_LT(twice.norm(), 1e-7 * once.norm());  // round-off over the shift
}

TEST(CoarseSpace, LeavesNoSoftResidual) {
  expect_no_soft_residual(CoarseModes::soft);
  expect_no_soft_residual(CoarseModes::killing);
}

/// What conjugate gradients take to 1e-8 with all variables, from a right side at random.
int iterations(double length, std::optional<CoarseModes> kind) {
  const Notched body(length);
  const PointEquations& equations = body.equations;
  const std::vector<double> ones(static_cast<std::size_t>(equations.num_variables()), 1.0);
  const std::vector<double> diagonal(equations.right.size(), 1e-10);
  const std::vector<double> blocks = point_blocks(equations, ones, diagonal);
  std::optional<CoarseSpace> space;
  if (kind) space.emplace(equations, ones, diagonal, *kind);
  std::mt19937 random(5);
  Eigen::VectorXd r = Eigen::VectorXd::NullaryExpr(
      equations.num_points() * 10, [&] { return static_cast<double>(random()) / 4294967296.0; });
  r = apply_system(equations, ones, 0.0, r);
  Eigen::VectorXd z(r.size()), p = Eigen::VectorXd::Zero(r.size());
  const double target = 1e-8 * r.norm();
  double last = 1.0;
  int count = 0;
  for (; r.norm() > target; ++count) {
    for (Index k = 0; k < equations.num_points(); ++k) {
      z.segment<10>(k * 10) =
          Eigen::Map<const Eigen::Matrix<double, 10, 10>>(blocks.data() + k * 100)
              .llt()
              .solve(r.segment<10>(k * 10));
    }
    if (space) space->add_correction(r.data(), z.data());
    const double rz = r.dot(z);
    p = z + rz / last * p;
    last = rz;
    const Eigen::VectorXd q = apply_system(equations, ones, 1e-10, p);
    r -= rz / p.dot(q) * q;
  }
  return count;
}

/// A body four times as long takes as many; blocks of single points take many more. Fields above
/// 0.003 of their blocks are left to conjugate gradients, whose bound is ln(2e8) / (2 sqrt(0.003)).
TEST(CoarseSpace, KeepsIterationsFromGrowing) {
  const int alone = iterations(10, {});
  for (const CoarseModes kind : {CoarseModes::soft, CoarseModes::killing}) {
    const int small = iterations(10, kind);
    if (kind == CoarseModes::soft) {
      EXPECT_LT(small, 100);
    }
    EXPECT_LT(iterations(40, kind), 1.3 * small);
    EXPECT_GT(alone, 4 * small);
  }
}

/// From the start to exact balance, where blocks of points alone take 10900 iterations. Boxes from
/// the first step on took less than 2000, but more time: their fields cost more than they save.
TEST(CoarseSpace, BalancesANotchedPrismInFewIterations) {
  Problem problem = make_problem(notched_box(15, 6), 3.0, 0.0, false);
  const CalibrationInput given{problem.body.particles,
                               problem.bonds,
                               {{1.0, 1.0}},
                               std::vector<std::uint8_t>(problem.bonds.lengths.size(), 1)};
  const CalibrationReport report =
      calibrate_bonds(given, {}, problem.body.facets, problem.stiffness);
  EXPECT_GT(report.residual_before, 0.1);
  EXPECT_LT(report.residual_after, 1e-10);
  EXPECT_EQ(report.unmet, 0);
  EXPECT_LT(report.iterations, 10900 / 4);
}

}  // namespace
}  // namespace perilink
